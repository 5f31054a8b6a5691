#!/usr/bin/env bash
# Installs the packages of a release in a bare Debian 12 and does there what their users do: all tutorials, from the packages'
# own documents, with the library, the programs and the Python package; then the wheel in a virtual environment of its own.
# Makes that system in a temporary folder (debootstrap), so it needs to be root and to reach Debian's packages.
#
# Usage: scripts/release/try_packages.sh FOLDER     FOLDER: with *.deb and *.whl, as scripts/release/release.sh leaves it
set -euo pipefail
if [ $# -ne 1 ]; then
  echo "usage: scripts/release/try_packages.sh FOLDER" >&2
  exit 2
fi
packages=$(realpath -e "$1")
if ! ls "$packages"/*.deb "$packages"/*.whl >/dev/null; then
  echo "try_packages.sh: $1: *.deb and *.whl are needed; scripts/release/release.sh makes them" >&2
  exit 2
fi
cd "$(dirname "$0")/../.."
source scripts/setup.sh
install_missing debootstrap
bare=$(mktemp -d)
# The devices in there are debootstrap's own, not those of this machine; --one-file-system spares what could not be unmounted.
trap 'umount "$bare/proc" 2>/dev/null || true; rm -rf --one-file-system "$bare"' EXIT
debootstrap --variant=minbase bookworm "$bare" >/dev/null
mount -t proc proc "$bare/proc"
cp /etc/resolv.conf "$bare/etc/resolv.conf"
cp "$packages"/*.deb "$packages"/*.whl tests/docs/run_commands.py "$bare/tmp"

chroot "$bare" env DEBIAN_FRONTEND=noninteractive bash -euo pipefail <<'INSIDE'
apt-get update -q >/dev/null
apt-get install -y -q /tmp/*.deb >/tmp/apt.log || { tail -20 /tmp/apt.log; exit 1; }
nef --version
# What the tutorials build with, and what reads the proofs.
apt-get install -y -q --no-install-recommends build-essential cmake pkg-config libompl-dev python3-venv >/tmp/apt.log || { tail -20 /tmp/apt.log; exit 1; }
cd /usr/share/doc/nef-programs
NEF_PREFIX=/usr python3 /tmp/run_commands.py "$PWD" /usr/bin /tmp/tutorials docs/tutorials/*.md | tail -20
apt-get remove -y -q python3-nef >/dev/null
python3 -m venv --system-site-packages /tmp/venv
/tmp/venv/bin/pip install -q --no-deps --no-index /tmp/*.whl
cd /tmp
/tmp/venv/bin/python -c 'import nef; print("wheel:", nef.__version__, nef.minkowski.sum(nef.box((0, 0, 0), (1, 1, 1)), nef.box((0, 0, 0), (1, 1, 1))).volume())'
INSIDE
echo "the packages of $packages work in a bare Debian 12"
