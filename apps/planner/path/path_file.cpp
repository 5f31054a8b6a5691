// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/path/path_file.h"

#include "nef/io/number_text.h"

namespace nef::planner {

std::string path_text(const ExactPath& path) {
  std::string out;
  for (const Rational3& p : path.points) {
    for (const Rational& x : p) {
      append_number(out, nearest_double(x));
      out += &x == &p.back() ? '\n' : ' ';
    }
  }
  return out;
}

std::string path_matrix(const ExactPath& path, bool se3) {
  std::string out;
  for (const Rational3& p : path.points) {
    for (const Rational& x : p) {
      append_number(out, nearest_double(x));
      out += ' ';
    }
    out += se3 ? "0 0 0 1 \n" : "\n";
  }
  return out + '\n';
}

}  // namespace nef::planner
