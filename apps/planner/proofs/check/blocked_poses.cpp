// SPDX-License-Identifier: Apache-2.0
//
// A question is brought to integers: positions and points times one number, quaternions times another one. Then the
// same lines decide it in words, if nothing can overflow there, or in long integers.
#include "apps/planner/proofs/check/blocked_poses.h"

#include <algorithm>

#include "apps/planner/orientation/raised_form.h"
#include "nef/base/fast_path.h"
#include "nef/construct/convex_hull.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"
#include "nef/number/int128.h"

namespace nef::planner {
namespace {

constexpr std::size_t kWordBits = 62;

template <std::size_t N>
void take_bits(const std::array<Integer, N>& numbers, std::size_t& bits) {
  for (const Integer& x : numbers) bits = std::max(bits, mpz_sizeinbase(x.get_mpz_t(), 2));
}

template <std::size_t N>
std::array<Int128, N> words_of(const std::array<Integer, N>& numbers) {
  std::array<Int128, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = numbers[i].get_si();
  return result;
}

template <class Number>
Number product(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

Integer3 scaled_product(const ScaledMatrix<Integer>& m, const Integer3& v) {
  return {dot(m.rows[0], v), dot(m.rows[1], v), dot(m.rows[2], v)};
}

template <class Number>
struct BlockedPoses::Question {
  QuaternionBox<Number> orientations;
  std::vector<std::array<Number, 3>> positions;
  std::vector<std::array<Number, 3>> points;
  std::vector<std::array<Number, 3>> drift;
  Number unit;
};

template <class Number>
std::optional<std::string> BlockedPoses::complaint(const std::vector<Face<Number>>& robot,
                                                   const std::vector<Face<Number>>& obstacle,
                                                   const Question<Number>& question) {
  for (const Face<Number>& face : obstacle) {
    Number most = face.offset * question.unit;
    for (const std::array<Number, 3>& drift : question.drift) {
      const Number way = product(face.normal, drift);
      most -= way < 0 ? Number(-way) : way;
    }
    for (const std::array<Number, 3>& point : question.points) {
      if (product(face.normal, point) > most) return "a point of both pieces is not in the obstacle";
    }
  }
  std::vector<std::array<Number, 3>> seen = question.points;  // from its position
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) seen[i][k] -= question.positions[i][k];
  }
  const QuaternionBox<Number>& box = question.orientations;
  const std::vector<ScaledMatrix<Number>> matrices = mixed_rotations(box.origin, box.directions, box.low, box.high);
  if (matrices.empty()) return "what is blocked has too many orientations";
  if (!question.drift.empty()) {
    if (drifts_inside(robot, matrices, seen, question)) return std::nullopt;
    return "a point of both pieces is not inside the robot";
  }
  for (const Face<Number>& face : robot) {
    for (const ScaledMatrix<Number>& m : matrices) {
      const std::array<Number, 3> normal{product(m.rows[0], face.normal), product(m.rows[1], face.normal),
                                         product(m.rows[2], face.normal)};
      const Number most = face.offset * m.scale * question.unit;
      for (const std::array<Number, 3>& point : seen) {
        if (product(normal, point) >= most) return "a point of both pieces is not inside the robot";
      }
    }
  }
  return std::nullopt;
}

// For a face n v <= c and a point u, seen from its position, that drifts by d_k: all coefficients of
// R(q) n (u + sum s_k d_k) - c, multiplied by the square of q, are below zero.
template <class Number>
bool BlockedPoses::drifts_inside(const std::vector<Face<Number>>& robot,
                                 const std::vector<ScaledMatrix<Number>>& matrices,
                                 const std::vector<std::array<Number, 3>>& seen, const Question<Number>& question) {
  constexpr std::size_t kNone = 3;
  for (const Face<Number>& face : robot) {
    std::vector<std::array<Number, 3>> normals;
    for (const ScaledMatrix<Number>& m : matrices) {
      normals.push_back(
          {product(m.rows[0], face.normal), product(m.rows[1], face.normal), product(m.rows[2], face.normal)});
    }
    CubicForm<Number> drifting{};
    for (std::size_t k = 0; k < 3; ++k) {
      QuadraticForm<Number> form{};
      for (std::size_t i = 0; i < form.size(); ++i) form[i] = product(normals[i], question.drift[k]);
      const CubicForm<Number> along = raised(form, k);
      for (std::size_t i = 0; i < along.size(); ++i) drifting[i] += along[i];
    }
    for (const std::array<Number, 3>& point : seen) {
      QuadraticForm<Number> form{};
      for (std::size_t i = 0; i < form.size(); ++i) {
        form[i] = product(normals[i], point) - face.offset * matrices[i].scale * question.unit;
      }
      const CubicForm<Number> still = raised(form, kNone);
      for (std::size_t i = 0; i < still.size(); ++i) {
        if (still[i] + drifting[i] >= 0) return false;
      }
    }
  }
  return true;
}

BlockedPoses::Faces BlockedPoses::faces_of(const std::vector<Rational3>& vertices, const Rational3& seen_from) {
  std::vector<Rational3> shifted;
  for (const Rational3& v : vertices) shifted.push_back(minus(v, seen_from));
  const Hull hull = hull_of(shifted);
  Faces result;
  if (hull.dimension < 3) return result;
  for (const HalfSpace& face : half_spaces_of(hull.mesh)) {
    const Integer scale = lcm(common_denominator(face.normal), face.offset.get_den());
    result.exact.push_back({times(face.normal, scale), Integer(scale / face.offset.get_den() * face.offset.get_num())});
    take_bits(result.exact.back().normal, result.bits);
    take_bits(std::array{result.exact.back().offset}, result.bits);
  }
  if (result.bits > kWordBits) return result;
  for (const Face<Integer>& face : result.exact) {
    result.words.push_back({words_of(face.normal), Int128{face.offset.get_si()}});
  }
  return result;
}

BlockedPoses::BlockedPoses(const PathProof::Claim& claim, const Orientations& orientations, const Rational3& reference)
    : orientations_(orientations) {
  for (const std::vector<Rational3>& piece : claim.robot) robot_.push_back(faces_of(piece, reference));
  for (const std::vector<Rational3>& piece : claim.obstacles) obstacles_.push_back(faces_of(piece, {0, 0, 0}));
}

std::optional<std::string> BlockedPoses::complaint(const OrientationBox<Rational>& box,
                                                   std::span<const Rational3> positions, std::uint32_t robot,
                                                   std::uint32_t obstacle, std::span<const Rational3> common,
                                                   std::span<const Rational3> drift) const {
  if (robot >= robot_.size() || obstacle >= obstacles_.size())
    return "what is blocked names a piece that does not exist";
  const Faces& piece = robot_[robot];
  const Faces& other = obstacles_[obstacle];
  if (piece.exact.empty() || other.exact.empty()) return "a flat piece blocks nothing";
  if (common.size() != positions.size()) return "what is blocked has a point of both pieces for each corner";
  if (!drift.empty() && (drift.size() != 3 || orientations_.dimension() != 3)) {
    return "points of both pieces drift with each of three parameters, or not at all";
  }
  Question<Integer> question{in_integers(orientations_, box), {}, {}, {}, 1};
  for (const std::span<const Rational3> points : {positions, common, drift}) {
    for (const Rational3& point : points) question.unit = lcm(question.unit, common_denominator(point));
  }
  for (const Rational3& position : positions) question.positions.push_back(times(position, question.unit));
  for (const Rational3& point : common) question.points.push_back(times(point, question.unit));
  for (const Rational3& way : drift) question.drift.push_back(times(way, question.unit));
  if (kFastPaths) {
    const auto words = in_words(question, std::max(piece.bits, other.bits));
    if (words) return complaint(piece.words, other.words, *words);
  }
  return complaint(piece.exact, other.exact, question);
}

// The same question, if nothing that is computed for it has more bits than two words: by far most have not. The one in
// Integer is its twin. With q bits for a quaternion's components, four products make an entry of a matrix: 2 q + 2
// bits, and 2 for the middle ones, which are differences. Three of these times a face's numbers, f bits, are 2 more;
// and so for the points, p bits and one for the difference.
std::optional<BlockedPoses::Question<Int128>> BlockedPoses::in_words(const Question<Integer>& question,
                                                                     std::size_t face_bits) {
  const QuaternionBox<Integer>& box = question.orientations;
  std::size_t parameter_bits = 0;
  std::size_t direction_bits = 0;
  std::size_t quaternion_bits = 0;
  std::size_t point_bits = 0;
  take_bits(box.low, parameter_bits);
  take_bits(box.high, parameter_bits);
  for (const std::array<Integer, 4>& direction : box.directions) take_bits(direction, direction_bits);
  take_bits(box.origin, quaternion_bits);
  // The origin and three multiples of directions, or half of an edge, which is no longer.
  quaternion_bits = std::max(quaternion_bits, parameter_bits + direction_bits + 1) + 2;
  take_bits(std::array{question.unit}, point_bits);
  for (const Integer3& v : question.positions) take_bits(v, point_bits);
  for (const Integer3& v : question.points) take_bits(v, point_bits);
  for (const Integer3& v : question.drift) take_bits(v, point_bits);
  // Coefficients of products with the parameters are sums of up to 27 times these, and four of them are added.
  const std::size_t kMostBits = question.drift.empty() ? 126 : 118;
  if (std::max({quaternion_bits, point_bits, face_bits}) > kWordBits) return std::nullopt;
  if ((2 * quaternion_bits + 4) + (face_bits + 2) + (point_bits + 3) > kMostBits) return std::nullopt;
  Question<Int128> result{
      {words_of(box.origin), {}, words_of(box.low), words_of(box.high)}, {}, {}, {}, Int128{question.unit.get_si()}};
  for (const std::array<Integer, 4>& direction : box.directions) {
    result.orientations.directions.push_back(words_of(direction));
  }
  for (const Integer3& v : question.positions) result.positions.push_back(words_of(v));
  for (const Integer3& v : question.points) result.points.push_back(words_of(v));
  for (const Integer3& v : question.drift) result.drift.push_back(words_of(v));
  return result;
}

}  // namespace nef::planner
