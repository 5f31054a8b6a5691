#!/usr/bin/env bash
# Sets up, builds, and runs the main jobs on data/. Leaves demo/index.html with all results.
# From a bare Debian 12: bash scripts/demo.sh
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/setup.sh
install_missing "${nef_packages[@]}" npm
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
cmake --preset release -DNEF_COMPILE_TOGETHER=ON -DNEF_BUILD_TESTS=OFF -DNEF_BUILD_BENCH=OFF -DNEF_BUILD_PYTHON=OFF >/dev/null
cmake --build --preset release
exec python3 scripts/demo.py build/release/bin demo
