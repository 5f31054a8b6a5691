#!/usr/bin/env bash
# Installs what is missing of the Debian packages that the suite needs. Sourced by demo.sh and
# test.sh; does nothing, and needs no rights, where everything is there.
set -euo pipefail

nef_packages=(
  g++ cmake ninja-build ccache pkg-config python3 help2man
  libgmp-dev libeigen3-dev libopenmesh-dev libopencv-dev libompl-dev libboost-dev
  libassimp-dev libcli11-dev nlohmann-json3-dev libfmt-dev libmatio-dev libtbb-dev libpng-dev zlib1g-dev libxxhash-dev libjemalloc-dev
  libzip-dev libexpat1-dev libcpp-httplib-dev
  pybind11-dev python3-dev python3-numpy
)
nef_test_packages=(catch2 librapidcheck-dev chromium npm libopenmpi-dev openmpi-bin
  python3-pytest python3-meshio python3-matplotlib python3-pip python3-wheel)
# The peer that results are compared with where it is there, which takes minutes to compile: CI wants it.
nef_oracle_packages=(libcgal-dev)
# What the suite can do without: robots from URDF files, and a peer of bench/planner/certify_ompl.
nef_optional_packages=(liburdfdom-dev libfcl-dev)
# Programs that read what the suite writes; CI asks those that it can install.
nef_foreign_packages=(admesh assimp-utils openscad prusa-slicer)
# The site of the documentation (scripts/docs.sh).
nef_docs_packages=(mkdocs mkdocs-material doxygen python3-sphinx)
# The runtimes of clang's sanitizers are only recommended by clang.
nef_lint_packages=(clang libclang-rt-dev clang-format clang-tidy)

install_missing() {
  local wanted=() package
  for package in "$@"; do
    # Node.js may have come from elsewhere, with an npm of its own.
    if [ "$package" = npm ] && command -v npm >/dev/null; then continue; fi
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || wanted+=("$package")
  done
  [ ${#wanted[@]} -eq 0 ] && return 0
  local run=()
  if [ "$(id -u)" -ne 0 ]; then run=(sudo); fi
  echo "Installing ${wanted[*]}"
  "${run[@]}" apt-get update -qq
  DEBIAN_FRONTEND=noninteractive "${run[@]}" apt-get install -y -qq --no-install-recommends "${wanted[@]}" >/dev/null
}
