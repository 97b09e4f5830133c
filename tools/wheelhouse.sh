#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Wheels of packages for another Python than the one here, by the index that pip is set to.
# Usage: tools/wheelhouse.sh FOLDER 3.13 REQUIREMENT...
set -eu
folder=$1 version=$2
shift 2
machine=$(uname -m)
platforms=
for each in $(seq 5 39); do platforms="$platforms --platform manylinux_2_${each}_$machine"; done
for each in 2014 2010 1; do platforms="$platforms --platform manylinux${each}_$machine"; done
# shellcheck disable=SC2086  # the platforms are words
"${PYTHON:-python3}" -m pip download --quiet --disable-pip-version-check --only-binary=:all: --dest "$folder" \
    --python-version "$version" --implementation cp --abi "cp$(echo "$version" | tr -d .)" --abi abi3 --abi none \
    $platforms "$@"
