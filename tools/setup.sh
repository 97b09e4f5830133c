#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Install what Flexact needs into .venv, and from the system's packages what a
# virtual environment cannot hold. Usage: tools/setup.sh run|test|docs
# NUMPY="numpy==1.26.*" asks for another numpy than the newest.
set -eu
cd "$(dirname "$0")/.."
purpose=${1:-run}
python=${PYTHON:-python3}

fail() {
    printf '%s\n' "$@" >&2
    exit 1
}

has_command() { command -v "$1" >/dev/null 2>&1; }

has_lapack() {
    for library in openblas lapack; do
        if printf 'external dgesdd\ncall dgesdd()\nend\n' |
            gfortran -x f95 - -o /dev/null -l"$library" >/dev/null 2>&1; then
            return 0
        fi
    done
    return 1
}

# Optional in the build, for orders of elimination of large models in space; here it is always wanted.
has_metis() {
    printf '#include <metis.h>\nint main(void) { idx_t n = 0; return METIS_NodeND(&n, 0, 0, 0, 0, 0, 0); }\n' |
        cc -x c - -o /dev/null -lmetis >/dev/null 2>&1
}

# For tests and benchmarks, which compare our factorisation with it.
has_cholmod() {
    printf '#include <cholmod.h>\nint main(void) { cholmod_common c; return !cholmod_start(&c); }\n' |
        cc -x c - -I/usr/include/suitesparse -o /dev/null -lcholmod >/dev/null 2>&1
}

has_python_headers() {
    "$python" - <<'PYTHON'
import os, sys, sysconfig
sys.exit(not os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h")))
PYTHON
}

# Only tests of pages need it; they are skipped without it, but in CI they fail.
has_browser() {
    for browser in chromium chromium-browser; do
        # Ubuntu's is a stub that asks for a snap.
        if "$browser" --version >/dev/null 2>&1; then
            chromedriver --version >/dev/null 2>&1
            return
        fi
    done
    return 1
}

# What is missing of the system, as names of Debian's packages.
missing_packages() {
    has_command gfortran || echo gfortran libc6-dev
    has_command cc || echo gcc libc6-dev
    { has_command gfortran && has_lapack; } || echo libopenblas-dev
    { has_command cc && has_metis; } || echo libmetis-dev
    [ "$purpose" != test ] || { has_command cc && has_cholmod; } || echo libsuitesparse-dev
    "$python" -c 'import venv, ensurepip' >/dev/null 2>&1 || echo python3-venv
    has_python_headers || echo python3-dev
}

install_packages() {
    advice="Install these system packages (names as in Debian and Ubuntu), then try again: $*"
    has_command apt-get || fail "apt-get is not here, so nothing was installed." "$advice"
    if [ "$(id -u)" = 0 ]; then
        as_root=
    elif has_command sudo; then
        as_root=sudo
    else
        fail "Neither root nor sudo is at hand, so nothing was installed." "$advice"
    fi
    echo "Installing system packages: $*"
    $as_root env DEBIAN_FRONTEND=noninteractive sh -c \
        'apt-get update -qq && apt-get install -y -qq --no-install-recommends "$@" >/dev/null' sh "$@" ||
        fail "The system packages could not be installed." "$advice"
}

has_command "$python" || fail "Python was not found. Install Python 3.10 or newer, or say where it is: make PYTHON=..."
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 10))' ||
    fail "Flexact needs Python 3.10 or newer; $python is $("$python" -V 2>&1)." "Say where a newer one is: make PYTHON=..."

packages=$(missing_packages | tr ' ' '\n' | sort -u | tr '\n' ' ')
# shellcheck disable=SC2086  # the names are words
[ -z "$packages" ] || install_packages $packages
still=$(missing_packages | tr '\n' ' ')
[ -z "$still" ] || fail "Still missing after the installation: $still" \
    "Headers and venv must belong to $python ($("$python" -V 2>&1))."

if [ "$purpose" = test ] && ! has_browser; then
    # In a shell of its own, which may fail.
    (install_packages chromium chromium-driver) || true
    has_browser || echo "There is no working Chromium with chromedriver: tests of pages in a browser are skipped, or fail in CI." >&2
fi

# Completion is tested in the shells themselves; tests of one that is missing are skipped, or fail in CI.
if [ "$purpose" = test ] && ! { has_command bash && has_command zsh && has_command fish; }; then
    (install_packages bash zsh fish) || true
fi

# spacarlight.m is tested in Octave; its tests are skipped without it, or fail in CI.
if [ "$purpose" = test ] && ! has_command octave-cli; then
    (install_packages octave) || true
fi

[ -x .venv/bin/python ] || "$python" -m venv .venv
requirements="pip>=23.1 meson-python>=0.17 meson ninja ${NUMPY:-numpy} meshio tqdm threadpoolctl matplotlib pillow"
[ "$purpose" != docs ] || requirements="$requirements mkdocs>=1.6,<2 mkdocs-material>=9.5 mkdocstrings[python]>=0.26"
[ "$purpose" != test ] || requirements="$requirements distributed pandas pytest pytest-xdist hypothesis imageio-ffmpeg jsonschema check-jsonschema pre-commit pysarif scipy trove-classifiers mpmath selenium vtk pyarrow openpyxl cadquery-ocp-novtk>=8.0;python_version>=\"3.11\" lib3mf trimesh pypdfium2 PyYAML pygls>=2 ruff mypy fprettify"
echo "Preparing .venv"
# shellcheck disable=SC2086
.venv/bin/python -m pip install --quiet --disable-pip-version-check $requirements ||
    fail "The Python packages could not be installed: $requirements" "A package index must be within reach of pip."
# Options whose kind has changed cannot be told to a folder that knows the old ones.
[ ! meson.options -nt build/python/build.ninja ] || rm -rf build/python
echo "Building Flexact"
PATH="$PWD/.venv/bin:$PATH" .venv/bin/python -m pip install --quiet --disable-pip-version-check \
    --no-build-isolation --no-deps -Cbuild-dir=build/python . || fail "The build failed: see above."
touch ".venv/ready-to-$purpose"
