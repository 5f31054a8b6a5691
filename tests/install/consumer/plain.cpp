// SPDX-License-Identifier: Apache-2.0
#include <iostream>

#include "nef/nef.h"

int main() {
  const nef::Polyhedron corner = nef::make_halfspace(1, 1, 1, -3, /*closed=*/false);
  std::cout << *nef::volume(nef::intersect(nef::make_box({0, 0, 0}, {2, 2, 2}), corner)) << '\n';  // 4
}
