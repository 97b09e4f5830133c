#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Build the package with CHOLMOD in place of our factor into build/cholmod/package, beside the one
# in use, and the unit test that holds both factors beside each other into build/patterns.
set -eu
cd "$(dirname "$0")/../.."
# The sources, with flexact_factor.f90 of this folder in place of ours.
source=build/cholmod/source
mkdir -p $source
tar -cf - LICENSE README.md licenses meson.build meson.options pyproject.toml fortran python | tar -xf - -C $source
cp -p tests/second_opinion/flexact_cholmod.* tests/second_opinion/flexact_factor.f90 $source/fortran/linalg/
sed -i "s|'linalg/flexact_factor.f90'|'linalg/flexact_cholmod.f90', 'linalg/flexact_cholmod.c', &|" $source/fortran/meson.build
python -m pip install --quiet --disable-pip-version-check --no-build-isolation --no-deps --upgrade \
    --target build/cholmod/package -Cbuild-dir=build/cholmod/build -Csetup-args=-Dc_args=-I/usr/include/suitesparse \
    -Csetup-args=-Dfortran_link_args=-lcholmod -Csetup-args=-Dc_link_args=-lcholmod -Csetup-args=-Db_asneeded=false \
    $source || { echo "Is libsuitesparse-dev there?" >&2; exit 1; }
[ -f build/patterns/build.ninja ] ||
    meson setup build/patterns --buildtype=release -Dpython_package=false -Dcore_tests=true -Dmatrices_only=true
ninja -C build/patterns tests/second_opinion/test_second_opinion
