# SPDX-License-Identifier: Apache-2.0
#
# brew install --HEAD packaging/homebrew/nef-suite.rb, from a checkout of the suite.
class NefSuite < Formula
  desc "Exact solid geometry: Booleans, Minkowski sums, visual hulls, motion planning"
  homepage "https://nef-suite.example"
  license "Apache-2.0"
  head "file://#{File.expand_path("../..", __dir__)}", using: :git, branch: "main"

  depends_on "cmake" => :build
  depends_on "cli11" => :build
  depends_on "ninja" => :build
  depends_on "nlohmann-json" => :build
  depends_on "pkgconf" => :build
  depends_on "xxhash" => :build
  depends_on "assimp"
  depends_on "boost"
  depends_on "eigen"
  depends_on "expat"
  depends_on "fmt"
  depends_on "gmp"
  depends_on "libmatio"
  depends_on "libpng"
  depends_on "libzip"
  depends_on :linux
  depends_on "ompl"
  depends_on "open-mesh"
  depends_on "opencv"
  depends_on "tbb"
  depends_on "zlib"

  def install
    args = %w[-DNEF_BUILD_TESTS=OFF -DNEF_BUILD_BENCH=OFF -DNEF_BUILD_PYTHON=OFF -DNEF_COMPILE_TOGETHER=ON]
    system "cmake", "-S", ".", "-B", "build/brew", "-G", "Ninja", *args, *std_cmake_args
    system "cmake", "--build", "build/brew"
    system "cmake", "--install", "build/brew"
  end

  test do
    assert_match "14 vertices", shell_output("#{bin}/nef eval 'box(0,0,0, 2,2,2) - box(1,1,1, 3,3,3)'")
  end
end
