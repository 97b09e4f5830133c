#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Build the core with run-time checks and sanitizers and run its unit tests: those of
# matrices where no mechanics is compiled, then the others, with which the program is
# built that takes fuzzed decks through the core (tests/fuzz).
# Usage: tools/test_core.sh [--build-only]
set -eu
cd "$(dirname "$0")/.."

# gfortran computes with bounds and addresses of arrays before it knows that they are not
# allocated, so that overflows are reported which are none. Memory that lives until the
# program ends is no leak.
sanitizers="-Db_sanitize=address,undefined -Db_lundef=false -Dfortran_args=-fno-sanitize=signed-integer-overflow,pointer-overflow"
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
echo end | gfortran -x f95 - -fsanitize=address,undefined -o /dev/null 2>/dev/null || {
    echo "The compiler has no sanitizers: the core is built with run-time checks alone." >&2
    sanitizers=
}

for part in matrices mechanics; do
    only=$([ $part = matrices ] && echo true || echo false)
    fuzzing=$([ $part = mechanics ] && echo true || echo false)
    options="--buildtype=debug -Dpython_package=false -Dcore_tests=true -Dcore_checks=true
        -Dmatrices_only=$only -Dcore_fuzzing=$fuzzing $sanitizers"
    if [ ! -f build/$part/build.ninja ] || [ meson.options -nt build/$part/build.ninja ] || [ "$(cat build/$part/options 2>/dev/null)" != "$options" ]; then
        rm -rf build/$part
        # shellcheck disable=SC2086  # the options are words
        meson setup build/$part $options
        echo "$options" >build/$part/options
    fi
    meson compile -C build/$part
    [ "${1:-}" = --build-only ] || meson test -C build/$part --print-errorlogs
done
