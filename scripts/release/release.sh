#!/usr/bin/env bash
# Makes a release: builds and tests a clean clone, packs sources, Debian packages and a wheel, and writes notes and checksums
# into release/VERSION. Publishes nothing; the last line says which tag to set.
#
# Usage: scripts/release/release.sh [--untested [TREE]]: --untested skips the tests, to try the packing; TREE is a build folder of this
# checkout, built already, whose programs are packed instead of those of the clone, to try it in two minutes.
set -euo pipefail
cd "$(dirname "$0")/../.."
root=$PWD
if [ $# -gt 2 ] || { [ $# -ge 1 ] && [ "$1" != --untested ]; }; then
  echo "usage: scripts/release/release.sh [--untested [TREE]]" >&2
  exit 2
fi
tree=
if [ $# -eq 2 ]; then tree=$(realpath -e "$2"); fi
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
notes=$(python3 scripts/release/release_notes.py "$version" ${1:+--or-unreleased})

source scripts/setup.sh
install_missing "${nef_packages[@]}" python3-pip python3-wheel dpkg-dev
out=$root/release/$version
rm -rf "$out" # of an earlier try
mkdir -p "$out"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
git clone -q . "$work/nef"
cd "$work/nef"
python3 scripts/checks/check_sources.py
python3 scripts/checks/check_recipes.py
if [ "${1:-}" != --untested ]; then bash scripts/test.sh; fi

if [ -z "$tree" ]; then
  tree=$PWD/build/release
  cmake --preset release -DNEF_COMPILE_TOGETHER=ON -DNEF_BUILD_TESTS=OFF -DNEF_BUILD_BENCH=OFF >/dev/null
  cmake --build --preset release
fi
cpack -G DEB --config "$tree/CPackConfig.cmake" -B "$work/packages" >/dev/null
cp "$work"/packages/*.deb "$out"
# The interpreter that the package is built for, whichever comes first on the PATH.
python=$(sed -n 's/^NEF_PYTHON_EXECUTABLE:INTERNAL=//p' "$tree/CMakeCache.txt")
NEF_BUILD_TREE=$tree "$python" -m pip wheel -q --no-build-isolation --no-deps -w "$out" .

# What was packed works where it is unpacked: the tutorials run with it, and its pages link to what is there.
for package in "$out"/*.deb; do dpkg-deb -x "$package" "$work/unpacked"; done
"$work/unpacked/usr/bin/nef" eval 'box(0,0,0, 2,2,2) - box(1,1,1, 3,3,3)' --json >/dev/null
NEF_PREFIX=$work/unpacked/usr python3 tests/docs/run_commands.py "$PWD" "$work/unpacked/usr/bin" "$work/tutorials" \
  "$PWD"/docs/tutorials/*.md | tail -20
for folder in nef-programs libnef-dev; do python3 scripts/checks/check_sources.py "$work/unpacked/usr/share/doc/$folder"; done
"$python" -m pip install -q --no-deps --no-index --target "$work/installed" "$out"/*.whl
(cd "$work" && PYTHONPATH=$work/installed "$python" -c 'import nef; print("wheel:", nef.__version__, nef.box((0, 0, 0), (1, 1, 1)).volume())')

git archive --prefix="nef-$version/" HEAD | gzip -9 -n >"$out/nef-$version.tar.gz"
printf '%s\n' "$notes" >"$out/NOTES.md"
cd "$out"
files=(*.deb *.whl *.tar.gz NOTES.md)
sha256sum "${files[@]}" >SHA256SUMS
sha256sum --quiet -c SHA256SUMS
ls -l
echo "scripts/release/try_packages.sh release/$version tries them in a bare Debian 12 (as root)"
echo "release/$version is made of $(git -C "$root" rev-parse --short HEAD); tag it: git tag -a v$version -F release/$version/NOTES.md"
