#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Make a system of its own in a folder by debootstrap, from where this machine's apt takes its
# packages. Usage: tools/bare_root.sh FOLDER SUITE PACKAGE...
# One that is there with the same packages stays. Needs root.
set -eu
folder=$1 suite=$2
shift 2
wanted="$suite $*"
[ "$(cat "$folder/made-of" 2>/dev/null)" != "$wanted" ] || exit 0

[ "$(id -u)" = 0 ] || { echo "Bare systems are made and entered as root only." >&2; exit 1; }
if ! command -v debootstrap >/dev/null; then
    apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends debootstrap >/dev/null
fi
# Several sources may be named; the first that has the suite is taken.
# shellcheck disable=SC2016  # apt's names, not the shell's
for mirror in $(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' | sort -u); do
    case $mirror in *security*) continue ;; esac
    rm -rf "$folder"
    mkdir -p "$folder"
    # Debian's and Ubuntu's packages of Python are in "main" and "universe".
    components=main
    grep -qi '^ID=ubuntu' /etc/os-release && components=main,universe
    echo "Making a bare $suite"
    if debootstrap --variant=minbase --components="$components" --include="$(echo "$@" | tr ' ' ',')" \
        "$suite" "$folder" "$mirror" >"$folder.log" 2>&1; then
        echo "$wanted" >"$folder/made-of"
        exit 0
    fi
done
echo "debootstrap made no $suite: see $folder.log" >&2
exit 1
