#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Build the package with CHOLMOD in place of our factor into build/cholmod/package, beside the one
# in use, and the unit test that holds both factors beside each other into build/patterns.
set -eu
cd "$(dirname "$0")/../.."
python -m pip install --quiet --disable-pip-version-check --no-build-isolation --no-deps --upgrade \
    --target build/cholmod/package -Cbuild-dir=build/cholmod/build -Csetup-args=-Dsparse=cholmod . ||
    { echo "Is libsuitesparse-dev there?" >&2; exit 1; }
[ -f build/patterns/build.ninja ] ||
    meson setup build/patterns --buildtype=release -Dpython_package=false -Dcore_tests=true -Dmatrices_only=true
ninja -C build/patterns tests/second_opinion/test_second_opinion
