#!/usr/bin/env bash
# Sets up, builds and runs all tests. From a bare Debian 12: bash scripts/test.sh
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/setup.sh
preset=${NEF_PRESET:-test}
install_missing "${nef_packages[@]}" "${nef_test_packages[@]}" "${nef_docs_packages[@]}"
install_missing "${nef_optional_packages[@]}" || echo "not installed: ${nef_optional_packages[*]}"
[ "$preset" = test ] || install_missing "${nef_oracle_packages[@]}"
# With ccache, a clone elsewhere finds what this one has compiled.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
cmake --preset "$preset" -DNEF_COMPILE_TOGETHER=ON >/dev/null
cmake --build --preset "$preset"
# Two more than there are cores, since browsers and package tools wait now and then.
ctest --preset "$preset" --parallel "$(($(nproc) + 2))"
