// SPDX-License-Identifier: Apache-2.0
//
// Seen from one part, another one moves along the difference of their vectors, so a question about a pair is one about
// a ray (blocking.h). Doubles choose vectors, which are made simple rationals before they are checked.
#include "apps/planner/assembly/simultaneous.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/rigid_search/linear_program.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"
#include "nef/number/simplest_between.h"

namespace nef::planner {
namespace {

using Vectors = std::vector<Rational3>;

class SimultaneousSearch {
 public:
  SimultaneousSearch(Blocking& blocking, const PartSet& parts, const Monitor& monitor)
      : blocking_(blocking), parts_(parts), monitor_(monitor) {}

  std::optional<Vectors> run() {
    const Vectors centres = this->centres();
    // Coarse vectors are tried first, because they are short.
    for (const double grain : {1.0 / 4, 1.0 / 64, 1e-9}) {
      Vectors away = seen_from_largest(centres);
      const double size = size_of(away);
      for (Rational3& v : away) v = simple(to_vector(v) / size, grain);
      if (is_free(away)) return away;
    }
    Vectors opening = seen_from_largest(opening_contacts(centres));
    if (is_free(opening)) return opening;
    return std::nullopt;
  }

 private:
  // The mean vertex of each part: inside it if it is convex.
  [[nodiscard]] Vectors centres() const {
    Vectors result;
    for (const std::size_t part : parts_) {
      const Complex& complex = blocking_.interior(part).complex();
      Vectors vertices;
      for (const VertexId v : complex.vertex_ids()) vertices.push_back(complex.points.rational(point_of(v)));
      result.push_back(mean_of(std::span<const Rational3>(vertices)));
    }
    return result;
  }

  [[nodiscard]] Vectors seen_from_largest(const Vectors& vectors) const {
    std::size_t largest = 0;
    Rational most = -1;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const std::array<Rational3, 2>& box = blocking_.box(parts_[i]);
      const Rational3 size = minus(box[1], box[0]);
      const Rational volume = size[0] * size[1] * size[2];
      if (volume <= most) continue;
      most = volume;
      largest = i;
    }
    Vectors result;
    for (const Rational3& v : vectors) result.push_back(minus(v, vectors[largest]));
    return result;
  }

  [[nodiscard]] static double size_of(const Vectors& vectors) {
    double size = 1e-300;
    for (const Rational3& v : vectors) size = std::max(size, to_vector(v).lpNorm<Eigen::Infinity>());
    return size;
  }

  static Rational3 simple(const Vector3d& v, double grain) {
    Rational3 result;
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = v[static_cast<Eigen::Index>(k)];
      result[k] = simplest_between(exact_rational(x - grain / 2), exact_rational(x + grain / 2));
    }
    return result;
  }

  // No two parts are in each other's way, and not all move as one.
  bool is_free(const Vectors& vectors) {
    bool any = false;
    for (const bool whole_way : {false, true}) {
      for (std::size_t i = 0; i < parts_.size(); ++i) {
        monitor_.check_interruption();
        for (std::size_t j = 0; j < i; ++j) {
          const Rational3 d = minus(vectors[i], vectors[j]);
          if (is_zero(d)) continue;
          any = true;
          if (whole_way ? blocking_.blocks(parts_[i], parts_[j], d) : blocking_.blocks_at_once(parts_[i], parts_[j], d))
            return false;
        }
      }
    }
    return any;
  }

  // Vectors in the cube from -1 to 1 that open contacts: the sum of what they open is as large as possible, where no
  // contact counts more than 1. Of a cone of several normals that one is kept open that moving away from each other
  // opens most.
  Vectors opening_contacts(const Vectors& centres) {
    struct Row {
      std::size_t a;
      std::size_t b;
      Vector3d normal;
    };
    std::vector<Row> rows;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (!blocking_.blocks_some_beginning(parts_[i], parts_[j])) continue;
        const Vector3d away = to_vector(minus(centres[i], centres[j]));
        for (const OpenCone& cone : blocking_.blocked_cones(parts_[i], parts_[j])) {
          std::optional<Vector3d> best;
          for (const Integer3& n : cone) {
            const Vector3d whole = to_vector(to_rational(n));
            const Vector3d normal = whole / whole.lpNorm<Eigen::Infinity>();  // rational, as the solution should be
            if (!best || normal.dot(away) > best->dot(away)) best = normal;
          }
          if (best) rows.push_back({i, j, *best});
        }
      }
    }
    const auto index = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
    const std::size_t moves = 3 * parts_.size();
    // Variables: 1 + each coordinate, and what each contact opens.
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(index(moves + 2 * rows.size()), index(moves + rows.size()));
    Eigen::VectorXd b = Eigen::VectorXd::Zero(a.rows());
    Eigen::VectorXd c = Eigen::VectorXd::Zero(a.cols());
    for (std::size_t i = 0; i < moves; ++i) {
      a(index(i), index(i)) = 1;
      b[index(i)] = 2;
    }
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const Eigen::Index opens = index(moves + r);
      const Eigen::Index least = index(moves + 2 * r);
      for (Eigen::Index k = 0; k < 3; ++k) {
        a(least, index(3 * rows[r].a) + k) = -rows[r].normal[k];
        a(least, index(3 * rows[r].b) + k) = rows[r].normal[k];
      }
      a(least, opens) = 1;
      a(least + 1, opens) = 1;
      b[least + 1] = 1;
      c[opens] = 1;
    }
    const Eigen::VectorXd x = maximize(a, b, c);
    Vectors result;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      result.push_back(simple(x.segment<3>(index(3 * i)) - Vector3d::Ones(), 1e-9));
    }
    return result;
  }

  Blocking& blocking_;
  const PartSet& parts_;
  const Monitor& monitor_;
};

}  // namespace

std::optional<std::vector<Rational3>> simultaneous_motions(Blocking& blocking, const PartSet& parts,
                                                           const Monitor& monitor) {
  return SimultaneousSearch(blocking, parts, monitor).run();
}

Rational simultaneous_end(const Blocking& blocking, const PartSet& parts, const std::vector<Rational3>& vectors) {
  Rational result = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Rational3 d = minus(vectors[i], vectors[j]);
      const std::array<Rational3, 2>& mine = blocking.box(parts[i]);
      const std::array<Rational3, 2>& theirs = blocking.box(parts[j]);
      std::optional<Rational> least;
      for (std::size_t k = 0; k < 3; ++k) {
        if (d[k] == 0) continue;
        const Rational way = d[k] > 0 ? Rational(theirs[1][k] - mine[0][k]) : Rational(theirs[0][k] - mine[1][k]);
        const Rational t = way / d[k];
        if (!least || t < *least) least = t;
      }
      if (least) result = std::max(result, *least);
    }
  }
  return result;
}

}  // namespace nef::planner
