#!/bin/sh
# Build the core with run-time checks and run its unit tests.
set -eu
cd "$(dirname "$0")/.."
[ -f build/debug/build.ninja ] || meson setup build/debug --buildtype=debug \
    -Dpython_package=false -Dcore_tests=true -Dcore_checks=true
meson compile -C build/debug
meson test -C build/debug --print-errorlogs
