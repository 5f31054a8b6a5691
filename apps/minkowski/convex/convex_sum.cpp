// SPDX-License-Identifier: Apache-2.0
//
// The Minkowski sum of two convex cells [Fogel, Halperin 2007]. For solids P, Q the facets of P + Q are (a) a facet of
// P and what of Q is extreme along its normal, (b) a facet of Q likewise, (c) an edge of P and an edge of Q whose arcs
// cross in the overlay of the normal diagrams. For (c) the arc of an edge of P is walked through the diagram of Q, from
// region to region. Every vertex of the sum is the sum of one pair of vertices, so the sum is put together from pairs
// of indices: no coordinate is ever compared.
#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "apps/minkowski/convex/convex_cell.h"
#include "apps/minkowski/convex/flat_sum.h"
#include "apps/minkowski/convex/normal_diagram.h"
#include "nef/base/error.h"
#include "nef/base/id.h"
#include "nef/geometry/vectors.h"

namespace nef::minkowski {
namespace {

using VertexPair = std::array<std::uint32_t, 2>;

// A cyclic chain of corners of one cell: a face, or an edge there and back.
using Loop = std::vector<std::uint32_t>;

Loop face_loop(const NormalDiagram& d, std::uint32_t corner) {
  Loop loop;
  std::uint32_t c = corner;
  do {
    loop.push_back(c);
    c = d.next(c);
  } while (c != corner);
  return loop;
}

Loop extreme_loop(const NormalDiagram& d, const NormalDiagram::Extreme& e) {
  return e.dimension == 2 ? face_loop(d, e.corner) : Loop{e.corner, d.twin(e.corner)};
}

class SolidSum {
 public:
  SolidSum(const NormalDiagram& p, const NormalDiagram& q, const Monitor& monitor) : p_(p), q_(q), monitor_(monitor) {}
  ConvexCell run();

 private:
  void facets_of_p();
  void facets_of_q();
  void edges_of_p();
  // The edges of q at one of its vertices that rise as a direction turns from n1 to n2.
  struct Turn {
    std::uint32_t level = kNone;  // level at n1 already: the vertex is not the last one that is extreme there
    std::uint32_t next = kNone;   // the first to become level after n1
    bool at_facet = false;        // another edge is level then, too: the direction is the normal of a facet
  };
  [[nodiscard]] Turn next_turn(std::uint32_t v, const Direction& n1, const Direction& n2) const;
  void walk(std::uint32_t corner);
  void add_parallelogram(std::uint32_t of_p, std::uint32_t of_q);
  void merge(const Direction& normal, const Loop& p, const Loop& q);
  void add_corner(std::uint32_t i, std::uint32_t j);
  void end_face(bool marked, const Integer3& normal);
  [[nodiscard]] Integer3 normal_of_edges(std::uint32_t of_p, std::uint32_t of_q) const;
  void set_marks();

  const NormalDiagram& p_;
  const NormalDiagram& q_;
  Monitor monitor_;
  std::vector<std::uint32_t> start_in_q_;  // per face of p: a vertex of q that is extreme along its normal
  ConvexCell sum_;
  std::vector<VertexPair> pairs_;  // per vertex of the sum
  std::unordered_map<std::uint64_t, std::uint32_t> vertex_;
  std::vector<std::uint32_t> face_;
};

void SolidSum::add_corner(std::uint32_t i, std::uint32_t j) {
  const std::uint64_t key = static_cast<std::uint64_t>(i) << 32U | j;
  const auto [it, is_new] = vertex_.try_emplace(key, static_cast<std::uint32_t>(pairs_.size()));
  if (is_new) {
    pairs_.push_back({i, j});
    sum_.mesh.vertices.push_back(plus(p_.cell().mesh.vertices[i], q_.cell().mesh.vertices[j]));
  }
  face_.push_back(it->second);
}

void SolidSum::end_face(bool marked, const Integer3& normal) {
  sum_.mesh.push_face(face_);
  sum_.normals.push_back(normal);
  sum_.facet_marks.push_back(marked ? 1 : 0);
  face_.clear();
}

// The normal of a parallelogram whose first side is the edge of q and whose second is that of p.
Integer3 SolidSum::normal_of_edges(std::uint32_t of_p, std::uint32_t of_q) const {
  const Integer3& u = q_.line(of_q).integers();
  const Integer3& v = p_.line(of_p).integers();
  Integer3 n;
  Integer divisor;
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_ptr x = n[i].get_mpz_t();
    mpz_mul(x, u[(i + 1) % 3].get_mpz_t(), v[(i + 2) % 3].get_mpz_t());
    mpz_submul(x, u[(i + 2) % 3].get_mpz_t(), v[(i + 1) % 3].get_mpz_t());
    mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), x);
  }
  if (p_.sign_of(of_p) * q_.sign_of(of_q) < 0) divisor = -divisor;
  for (Integer& x : n) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), divisor.get_mpz_t());
  return n;
}

// The sum of two parallel polygons (or a polygon and an edge): their edges in the order of their
// angles, beginning with the first edge of p. Parallel edges become one.
void SolidSum::merge(const Direction& normal, const Loop& p, const Loop& q) {
  struct Edge {
    const NormalDiagram* diagram;
    std::uint32_t corner;
  };
  const Edge first{&p_, p[0]};
  const auto orientation = [&](const Edge& a, const Edge& b) {
    return a.diagram->sign_of(a.corner) * b.diagram->sign_of(b.corner) *
           sign_of_determinant(normal, a.diagram->line(a.corner), b.diagram->line(b.corner), monitor_);
  };
  // 0 for angles in [0, 180) against the first edge, 1 for [180, 360).
  const auto half = [&](const Edge& e) {
    const int sign = orientation(first, e);
    if (sign != 0) return sign > 0 ? 0 : 1;
    const int along = first.diagram->sign_of(first.corner) * e.diagram->sign_of(e.corner) *
                      sign_of_dot(first.diagram->line(first.corner), e.diagram->line(e.corner), monitor_);
    return along > 0 ? 0 : 1;
  };
  const auto compare = [&](const Edge& a, const Edge& b) {
    const int ha = half(a);
    const int hb = half(b);
    return ha != hb ? ha - hb : -orientation(a, b);
  };
  std::size_t begin = 0;
  for (std::size_t k = 1; k < q.size(); ++k) {
    if (compare({&q_, q[k]}, {&q_, q[begin]}) < 0) begin = k;
  }
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < p.size() || j < q.size()) {
    const std::uint32_t cp = p[i % p.size()];
    const std::uint32_t cq = q[(begin + j) % q.size()];
    add_corner(p_.source(cp), q_.source(cq));
    int order = 0;
    if (i == p.size()) {
      order = 1;
    } else if (j == q.size()) {
      order = -1;
    } else {
      order = compare({&p_, cp}, {&q_, cq});
    }
    if (order <= 0) ++i;
    if (order >= 0) ++j;
  }
}

void SolidSum::facets_of_p() {
  start_in_q_.assign(p_.face_count(), 0);
  std::uint32_t start = 0;
  for (std::uint32_t f = 0; f < p_.face_count(); ++f) {
    // A neighbour that has been placed already is a good start.
    const std::uint32_t first = p_.cell().mesh.face_begin[f];
    for (std::uint32_t c = first; c < p_.cell().mesh.face_begin[f + 1]; ++c) {
      const std::uint32_t other = p_.face(p_.twin(c));
      if (other < f) start = start_in_q_[other];
    }
    const NormalDiagram::Extreme e = q_.extreme(p_.normal(f), start, monitor_);
    start_in_q_[f] = start = e.vertex;
    const Loop loop = face_loop(p_, first);
    bool marked = p_.cell().facet_marked(f);
    if (e.dimension == 0) {
      for (const std::uint32_t c : loop) add_corner(p_.source(c), e.vertex);
      marked = marked && q_.cell().vertex_marked(e.vertex);
    } else {
      merge(p_.normal(f), loop, extreme_loop(q_, e));
      marked =
          marked && (e.dimension == 1 ? q_.cell().edge_marked(e.corner) : q_.cell().facet_marked(q_.face(e.corner)));
    }
    end_face(marked, p_.normal(f).integers());
  }
}

void SolidSum::facets_of_q() {
  std::vector<std::uint32_t> starts(q_.face_count(), 0);
  std::uint32_t start = 0;
  for (std::uint32_t g = 0; g < q_.face_count(); ++g) {
    const std::uint32_t first = q_.cell().mesh.face_begin[g];
    for (std::uint32_t c = first; c < q_.cell().mesh.face_begin[g + 1]; ++c) {
      const std::uint32_t other = q_.face(q_.twin(c));
      if (other < g) start = starts[other];
    }
    const NormalDiagram::Extreme e = p_.extreme(q_.normal(g), start, monitor_);
    starts[g] = start = e.vertex;
    if (e.dimension == 2) continue;  // two parallel facets: done from the other side
    const Loop loop = face_loop(q_, first);
    bool marked = q_.cell().facet_marked(g);
    if (e.dimension == 0) {
      for (const std::uint32_t c : loop) add_corner(e.vertex, q_.source(c));
      marked = marked && p_.cell().vertex_marked(e.vertex);
    } else {
      merge(q_.normal(g), extreme_loop(p_, e), loop);
      marked = marked && p_.cell().edge_marked(e.corner);
    }
    end_face(marked, q_.normal(g).integers());
  }
}

// How far two edges c, d of q are from becoming level as the direction turns from n1 to n2: the
// sign of t(c) - t(d), where edge . (n1 (1-t) + n2 t) = 0. With a = edge.n1 < 0 < b = edge.n2 that
// is the sign of a_d b_c - a_c b_d, which is -(c x d) . (n1 x n2).
int compare_turn(const NormalDiagram& q, std::uint32_t c, std::uint32_t d, const Direction& n1, const Direction& n2,
                 const Monitor& monitor) {
  const Direction& u = q.line(c);
  const Direction& v = q.line(d);
  const auto dot = [](const Direction& x, const Direction& y) {
    return x.approximate[0] * y.approximate[0] + x.approximate[1] * y.approximate[1] +
           x.approximate[2] * y.approximate[2];
  };
  const double value = dot(u, n1) * dot(v, n2) - dot(u, n2) * dot(v, n1);
  // A dot product is at most 3 and within 3.1 (e + e') + 16u (see sign_of_dot); each of the two
  // products of them is then within 6.2 times that, rounding included.
  const double error = 3.1 * (std::max(u.error, v.error) + std::max(n1.error, n2.error)) + 0x1p-49;
  const int sign = sign_by_ladder({value, 14 * error}, monitor, [&] {
    return sign_of_dot(Direction::cross(u, v), Direction::cross(n1, n2), monitor);
  });
  return -q.sign_of(c) * q.sign_of(d) * sign;
}

// What happens next at vertex v of q, extreme at some direction between n1 and n2, as the direction turns on to n2.
SolidSum::Turn SolidSum::next_turn(std::uint32_t v, const Direction& n1, const Direction& n2) const {
  Turn turn;
  bool level_all_the_time = false;
  bool tie = false;
  const std::uint32_t first = q_.corner_at(v);
  std::uint32_t c = first;
  do {
    const int rise = q_.sign_along(c, n2, monitor_);
    const int start = rise >= 0 ? q_.sign_along(c, n1, monitor_) : 0;
    if (rise == 0) {
      level_all_the_time = level_all_the_time || start == 0;
    } else if (rise > 0 && start == 0) {
      turn.level = c;
    } else if (rise > 0) {
      const int order = turn.next == kNone ? -1 : compare_turn(q_, c, turn.next, n1, n2, monitor_);
      if (order < 0) turn.next = c;
      if (order <= 0) tie = order == 0;
    }
    c = q_.next_around(c);
  } while (c != first);
  turn.at_facet = tie || level_all_the_time;
  return turn;
}

// Walks the arc of an edge of p, from the normal n1 of its left face to n2 of its right one, through the diagram of q,
// and adds a facet for each edge of q that becomes level strictly between.
//
// Where the arc passes through the normal of a facet of q, facets_of_q has found the facet of the sum, and the walk
// only steps over it: at each vertex of that facet some edge of the facet gets level at the same direction.
void SolidSum::walk(std::uint32_t corner) {
  const Direction& n1 = p_.normal(p_.face(corner));
  const Direction& n2 = p_.normal(p_.face(p_.twin(corner)));
  std::uint32_t v = start_in_q_[p_.face(corner)];
  Turn turn = next_turn(v, n1, n2);
  while (turn.level != kNone) {
    v = q_.target(turn.level);
    turn = next_turn(v, n1, n2);
  }
  std::uint32_t passed = kNone;  // an edge of the facet of q whose normal the arc passed through last
  while (turn.next != kNone) {
    if (turn.at_facet || (passed != kNone && compare_turn(q_, turn.next, passed, n1, n2, monitor_) == 0)) {
      passed = turn.next;
    } else {
      add_parallelogram(corner, turn.next);
    }
    v = q_.target(turn.next);
    turn = next_turn(v, n1, n2);
  }
}

// Turning about the edge of p raises the edge of q, so their order about the normal is fixed.
void SolidSum::add_parallelogram(std::uint32_t of_p, std::uint32_t of_q) {
  add_corner(p_.source(of_p), q_.source(of_q));
  add_corner(p_.source(of_p), q_.target(of_q));
  add_corner(p_.target(of_p), q_.target(of_q));
  add_corner(p_.target(of_p), q_.source(of_q));
  end_face(p_.cell().edge_marked(of_p) && q_.cell().edge_marked(of_q), normal_of_edges(of_p, of_q));
}

void SolidSum::edges_of_p() {
  for (std::uint32_t c = 0; c < p_.corner_count(); ++c) {
    if (c < p_.twin(c)) walk(c);
  }
}

// The mark of the edge (or vertex, if from == to) between two vertices of an operand.
bool joined_mark(const NormalDiagram& d, std::uint32_t from, std::uint32_t to) {
  if (from == to) return d.cell().vertex_marked(from);
  std::uint32_t c = d.corner_at(from);
  while (d.target(c) != to) c = d.next_around(c);
  return d.cell().edge_marked(c);
}

void SolidSum::set_marks() {
  using Boundary = ConvexCell::Boundary;
  const Boundary a = p_.cell().boundary;
  const Boundary b = q_.cell().boundary;
  if (a == Boundary::kOpen || b == Boundary::kOpen) {
    sum_.boundary = Boundary::kOpen;
  } else if (a == Boundary::kClosed && b == Boundary::kClosed) {
    sum_.boundary = Boundary::kClosed;
  } else {
    sum_.boundary = Boundary::kMixed;
    for (const auto& [i, j] : pairs_) {
      sum_.vertex_marks.push_back(p_.cell().vertex_marked(i) && q_.cell().vertex_marked(j) ? 1 : 0);
    }
    const Mesh& mesh = sum_.mesh;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const auto face = mesh.face(f);
      for (std::size_t k = 0; k < face.size(); ++k) {
        const VertexPair from = pairs_[face[k]];
        const VertexPair to = pairs_[face[(k + 1) % face.size()]];
        sum_.edge_marks.push_back(joined_mark(p_, from[0], to[0]) && joined_mark(q_, from[1], to[1]) ? 1 : 0);
      }
    }
    return;
  }
  sum_.facet_marks.clear();
}

ConvexCell SolidSum::run() {
  sum_.dimension = 3;
  facets_of_p();
  facets_of_q();
  edges_of_p();
  set_marks();
  return std::move(sum_);
}

}  // namespace

ConvexCell convex_sum(const ConvexCell& c, const ConvexCell& d, const Monitor& monitor) {
  if (d.dimension == 0) return translated(c, d.mesh.vertices[0]);
  if (c.dimension == 0) return translated(d, c.mesh.vertices[0]);
  if (c.dimension < 3 || d.dimension < 3) return flat_sum(c, d, monitor);
  return convex_sum(NormalDiagram(c), NormalDiagram(d), monitor);
}

ConvexCell convex_sum(const NormalDiagram& c, const NormalDiagram& d, const Monitor& monitor) {
  return SolidSum(c, d, monitor).run();
}

}  // namespace nef::minkowski
