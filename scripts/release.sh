#!/usr/bin/env bash
# Makes a release: builds and tests a clean clone, packs sources, Debian packages and a wheel, and writes notes and checksums
# into release/VERSION. Publishes nothing; the last line says which tag to set.
#
# Usage: scripts/release.sh [--untested]: the second skips the tests, to try the packing.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
version=$(sed -n 's/^#define NEF_VERSION "\(.*\)"$/\1/p' nef/version.h)

if [ -n "$(git status --porcelain)" ]; then
  echo "release.sh: there are changes that are not committed; commit or stash them" >&2
  exit 1
fi
if git rev-parse -q --verify "refs/tags/v$version" >/dev/null; then
  echo "release.sh: version $version is tagged already; set the next one in nef/version.h" >&2
  exit 1
fi
# What is new since the last release: the section of this version, or what is unreleased while packing is tried.
notes=$(python3 scripts/release_notes.py "$version" ${1:+--or-unreleased})

source scripts/setup.sh
install_missing "${nef_packages[@]}" python3-pip python3-wheel dpkg-dev
out=$root/release/$version
mkdir -p "$out"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
git clone -q . "$work/nef"
cd "$work/nef"
python3 scripts/check_sources.py
if [ "${1:-}" != --untested ]; then bash scripts/test.sh; fi

cmake --preset release -DNEF_COMPILE_TOGETHER=ON -DNEF_BUILD_TESTS=OFF -DNEF_BUILD_BENCH=OFF >/dev/null
cmake --build --preset release
cpack -G DEB --config build/release/CPackConfig.cmake -B "$work/packages" >/dev/null
cp "$work"/packages/*.deb "$out"
NEF_BUILD_TREE=$PWD/build/release pip wheel -q --no-build-isolation --no-deps -w "$out" .
git archive --prefix="nef-$version/" HEAD | gzip -9 -n >"$out/nef-$version.tar.gz"
printf '%s\n' "$notes" >"$out/NOTES.md"
cd "$out"
files=(*.deb *.whl *.tar.gz NOTES.md)
sha256sum "${files[@]}" >SHA256SUMS
ls -l
echo "release/$version is made of $(git -C "$root" rev-parse --short HEAD); tag it: git tag -a v$version -F release/$version/NOTES.md"
