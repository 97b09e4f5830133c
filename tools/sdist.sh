#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The sources as they are committed, in dist/; then, in an environment of their own, they are
# built as pip does, and their tests of the paper's mechanisms run against what was built.
set -eu
cd "$(dirname "$0")/.."
work=$PWD/build/sdist
rm -rf "$work" dist/*.tar.gz
mkdir -p "$work" dist
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check build
"$work/venv/bin/python" -m build --sdist --outdir dist . >"$work/sdist.log" 2>&1 || { cat "$work/sdist.log" >&2; exit 1; }
tar -xzf dist/flexact-*.tar.gz -C "$work"
source=$(echo "$work"/flexact-*)
for needed in LICENSE licenses README.md docs input_decks tests meson.build fortran python; do
    [ -e "$source/$needed" ] || { echo "The sources lack $needed" >&2; exit 1; }
done
"$work/venv/bin/pip" install --quiet --disable-pip-version-check dist/flexact-*.tar.gz pytest
(cd "$source" && OPENBLAS_NUM_THREADS=1 "$work/venv/bin/python" -m pytest -q tests/python/test_paper.py tests/python/test_analysis.py)
ls -l dist/*.tar.gz
