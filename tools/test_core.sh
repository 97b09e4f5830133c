#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Build the core with run-time checks and sanitizers and run its unit tests: those of
# matrices where no mechanics is compiled, then the others, with which the program is
# built that takes fuzzed decks through the core (tests/fuzz). What is worked on side by
# side is run once more with the sanitizer of threads.
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

# Set up build/$1 with the options that follow, unless it is so already.
configure() {
    folder=build/$1
    shift
    options="--buildtype=debug -Dpython_package=false -Dcore_tests=true $*"
    if [ ! -f "$folder/build.ninja" ] || [ meson.options -nt "$folder/build.ninja" ] || [ "$(cat "$folder/options" 2>/dev/null)" != "$options" ]; then
        rm -rf "$folder"
        # shellcheck disable=SC2086  # the options are words
        meson setup "$folder" $options
        echo "$options" >"$folder/options"
    fi
}

for part in matrices mechanics; do
    only=$([ $part = matrices ] && echo true || echo false)
    fuzzing=$([ $part = mechanics ] && echo true || echo false)
    configure $part -Dcore_checks=true -Dmatrices_only="$only" -Dcore_fuzzing="$fuzzing" "$sanitizers"
    meson compile -C build/$part
    [ "${1:-}" = --build-only ] || meson test -C build/$part --print-errorlogs
done
[ "${1:-}" = --build-only ] && exit

# Compilers before 14 have one that does not run on every kernel.
mkdir -p build/threads
if ! { echo end | gfortran -x f95 - -fsanitize=thread -o build/threads/probe && build/threads/probe; } >/dev/null 2>&1; then
    echo "The sanitizer of threads does not run here: data races are not looked for." >&2
    exit
fi
configure threads -Dmatrices_only=true -Db_sanitize=thread -Db_lundef=false
meson compile -C build/threads tests/fortran/test_cholesky tests/fortran/test_pinned
# It takes ten times as long, and others may be at work besides.
# Locks are those of the compiler's library; BLAS, which is not compiled for this, has no threads of its own.
TSAN_OPTIONS=allocator_may_return_null=1:detect_deadlocks=0:halt_on_error=1 OPENBLAS_NUM_THREADS=1 \
    meson test -C build/threads --no-rebuild --print-errorlogs --timeout-multiplier 10 cholesky pinned
