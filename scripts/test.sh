#!/usr/bin/env bash
# Sets up, builds and runs all tests. From a bare Debian 12: bash scripts/test.sh
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/setup.sh
preset=${NEF_PRESET:-release}
install_missing "${nef_packages[@]}" "${nef_test_packages[@]}"
[ "$preset" = release ] || install_missing "${nef_oracle_packages[@]}"
# With ccache, a clone elsewhere finds what this one has compiled.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
# What the demo leaves out, and (in CI's preset) the benchmarks.
benchmarks=$([ "$preset" = release ] && echo OFF || echo ON)
cmake --preset "$preset" -DNEF_COMPILE_TOGETHER=ON -DNEF_BUILD_TESTS=ON -DNEF_BUILD_BENCH="$benchmarks" \
  -DNEF_BUILD_PYTHON=ON >/dev/null
cmake --build --preset "$preset"
# One more than there are cores, since browsers and package tools wait now and then.
ctest --preset "$preset" --parallel "$(($(nproc) + 1))"
