#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Build the core with run-time checks and run its unit tests: those of matrices where
# no mechanics is compiled, then the others.
set -eu
cd "$(dirname "$0")/.."
for part in matrices mechanics; do
    only=$([ $part = matrices ] && echo true || echo false)
    [ -f build/$part/build.ninja ] || meson setup build/$part --buildtype=debug \
        -Dpython_package=false -Dcore_tests=true -Dcore_checks=true -Dmatrices_only=$only
    meson compile -C build/$part
    meson test -C build/$part --print-errorlogs
done
