#!/usr/bin/env bash
# Sets up, builds and runs all tests. From a bare Debian 12: bash scripts/test.sh
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/setup.sh
install_missing "${nef_packages[@]}" "${nef_test_packages[@]}"
# With ccache, a clone elsewhere finds what this one has compiled.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
preset=${NEF_PRESET:-release}
# The demo leaves them out.
cmake --preset "$preset" -DNEF_BUILD_TESTS=ON -DNEF_BUILD_BENCH=ON -DNEF_BUILD_PYTHON=ON >/dev/null
cmake --build --preset "$preset"
ctest --preset "$preset" --parallel "$(nproc)"
