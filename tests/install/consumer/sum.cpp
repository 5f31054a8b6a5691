// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include "apps/minkowski/minkowski.h"
#include "nef/polyhedron.h"
int main() {
  const nef::Polyhedron a = nef::make_box({0, 0, 0}, {2, 2, 2});
  const nef::Polyhedron b = nef::make_box({0, 0, 0}, {1, 1, 1});
  std::cout << *nef::volume(nef::minkowski::minkowski_sum(a, b)) << '\n';  // 27
}
