#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Install the wheels of dist/ in systems that have Python and nothing else, made by debootstrap, and
# let them work there without a network: tests/wheel/bare.py. What they need of other packages is
# fetched beforehand. Needs root.
set -eu
cd "$(dirname "$0")/.."
if grep -qi '^ID=ubuntu' /etc/os-release 2>/dev/null; then
    suites=${SUITES:-jammy noble}
else
    suites=${SUITES:-bookworm trixie}
fi

test_with() { # root, version of Python, requirement of numpy
    echo "== Python $2 in a bare $(cut -d' ' -f1 "$1/made-of"), $3"
    tag=cp$(echo "$2" | tr -d .)
    wheel=$(ls dist/*-"$tag"-"$tag"-*.whl)
    rm -rf "$1/trial" && mkdir -p "$1/trial/wheelhouse"
    tools/wheelhouse.sh "$1/trial/wheelhouse" "$2" "$wheel[pictures]" "$3"
    cp -r input_decks tests/reference/known_answers.json tests/wheel/bare.py "$1/trial"
    # Without a network, where that can be had.
    alone=
    ! unshare --net true 2>/dev/null || alone="unshare --net"
    $alone chroot "$1" env -i PATH=/usr/bin:/bin HOME=/root LC_ALL=C.UTF-8 sh -euc '
        for program in cc gcc gfortran clang; do ! command -v $program || exit 1; done
        found=$(find /usr/lib /lib -name "lib*blas*" -o -name "liblapack*" -o -name "libcholmod*" \
            -o -name "libmetis*" -o -name "libgfortran*")
        [ -z "$found" ] || { echo "This system is not bare: $found"; exit 1; }
        cd /trial
        python3 -m venv venv
        venv/bin/pip install --quiet --no-index --find-links wheelhouse "flexact[pictures]" "$1"
        venv/bin/python bare.py input_decks known_answers.json
    ' sh "$3"
}

for suite in $suites; do
    root=$PWD/build/roots/$suite-bare
    tools/bare_root.sh "$root" "$suite" python3 python3-venv
    version=$(chroot "$root" python3 -c 'import sys; print("%d.%d" % sys.version_info[:2])')
    # numpy 1.26 was made for Python up to 3.12.
    case $version in 3.1[012]) test_with "$root" "$version" "numpy==1.26.*" ;; esac
    test_with "$root" "$version" "numpy>=2"
done
