// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"
int main() {
  const nef::Polyhedron a = nef::make_box({0, 0, 0}, {2, 2, 2});
  const nef::Polyhedron b = nef::make_halfspace(1, 1, 1, -3, /*closed=*/false);
  std::cout << *nef::volume(nef::intersect(a, b)) << '\n';  // 4
}
