#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Build the core as it is shipped, and take random sparse matrices through the Cholesky factor
# on all processors; the first that offends is printed.
# Usage: tests/patterns/run.sh [small [larger [seed]]]: how many of each.
set -eu
cd "$(dirname "$0")/../.."
small=${1:-10000000}
larger=${2:-10000}
seed=${3:-2024}
workers=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)
export OPENBLAS_NUM_THREADS=1

[ -f build/patterns/build.ninja ] ||
    meson setup build/patterns --buildtype=release -Dpython_package=false -Dcore_tests=true -Dmatrices_only=true
ninja -C build/patterns tests/patterns/patterns
program=build/patterns/tests/patterns/patterns

running=
worker=1
while [ "$worker" -le "$workers" ]; do
    { "$program" small "$worker" "$small" "$workers" "$seed" &&
        "$program" larger "$worker" "$larger" "$workers" "$seed"; } &
    running="$running $!"
    worker=$((worker + 1))
done
failed=0
for process in $running; do
    wait "$process" || failed=1
done
[ $failed = 0 ] && echo "$small matrices of up to 12 columns and $larger larger ones, seed $seed: all right."
exit $failed
