// SPDX-License-Identifier: Apache-2.0
//
// A product is n (M v + t - p) for a face of the fixed piece, (M n) (w - t) - n p for one of the moving piece, and
// g M (a x e) + (M e) (g x (t + ...)) for two edges, M being the rotation and t the position. Over an arc of
// quaternions it is, times a positive number, the Bernstein polynomial of its values for the three matrices of
// motion_cell.h; over a stroke that of two positions. If all these values are surely positive in doubles, or all
// negative, there is no root.
//
// Most products are never looked at. A face counts only if it may keep the pieces apart somewhere in the cell, that is,
// unless a point of the other piece is surely behind it all the time. Two edges count only if they may meet: let a
// plane along both keep the pieces apart until it no longer does. If it then contains more of a piece than its edge, it
// contains a face of that, which keeps the pieces apart at this value, and whose product with an end of the other edge
// is 0 there and not all the time. Otherwise what touches is the two edges.
#include "apps/planner/mechanism/contact_events.h"

#include <algorithm>
#include <set>
#include <span>

#include "apps/planner/mechanism/contact_products.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

Rational3 apply(const Matrix3& m, const Rational3& v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }

double reach_of(const ContactPiece& moving, const ContactPiece& fixed, const MotionCell& cell) {
  return moving.piece->reach + fixed.piece->reach + cell.position_reach;
}

// The sign that all control values surely have; 0 if there is none.
template <typename Value>
int common_sign(const MotionCell& cell, double error, const Value& value) {
  bool above = true;
  bool below = true;
  for (std::size_t i = 0; i < cell.turn_count; ++i) {
    for (std::size_t k = 0; k < cell.position_count; ++k) {
      const double x = value(cell.turns[i], cell.positions[k]);
      above = above && x > error;
      below = below && x < -error;
    }
  }
  return above ? 1 : below ? -1 : 0;
}

// With room for the errors of the coordinates.
void add_around(const Vector3d& x, double error, Box& box) {
  for (const double side : {-error, error}) box.add_rounded({x[0] + side, x[1] + side, x[2] + side});
}

template <typename Add>
std::vector<Box> boxes_of_edges(const ContactPiece& piece, const Add& add) {
  std::vector<Box> boxes(piece.edges.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    add(piece.piece->points[piece.edges[i].from], boxes[i]);
    add(piece.piece->points[piece.edges[i].to], boxes[i]);
  }
  return boxes;
}

// The boxes that meet the box of all others.
std::vector<std::uint32_t> that_meet(const std::vector<Box>& boxes, const std::vector<Box>& others) {
  Box all;
  for (const Box& other : others) all.add(other);
  std::vector<std::uint32_t> result;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].overlaps(all)) result.push_back(i);
  }
  return result;
}

// Calls visit(edge of the moving piece, edge of the other one) for all that may meet in a cell.
template <typename Visit>
void for_each_close_edges(const ContactPiece& moving, const ContactPiece& fixed, const MotionCell& cell, double error,
                          Visit&& visit) {
  const std::vector<Box> swept = boxes_of_edges(moving, [&](const Vector3d& x, Box& box) {
    cell.for_each_image(x, [&](const Vector3d& image) { add_around(image, error, box); });
  });
  const std::vector<Box> others =
      boxes_of_edges(fixed, [&](const Vector3d& x, Box& box) { add_around(x, error, box); });
  const std::vector<std::uint32_t> near = that_meet(others, swept);
  for (const std::uint32_t i : that_meet(swept, others)) {
    for (const std::uint32_t j : near) {
      if (swept[i].overlaps(others[j])) visit(i, j);
    }
  }
}

// Is some vertex on no face's positive side? side(vertex, face) is 0 where doubles cannot tell.
template <typename Side, typename ExactSide>
bool some_is_inside(std::size_t vertices, std::size_t faces, const Side& side, const ExactSide& exact_side) {
  std::vector<std::size_t> open;
  for (std::size_t v = 0; v < vertices; ++v) {
    open.clear();
    bool outside = false;
    for (std::size_t f = 0; f < faces && !outside; ++f) {
      const int there = side(v, f);
      outside = there > 0;
      if (there == 0) open.push_back(f);
    }
    if (!outside && std::none_of(open.begin(), open.end(), [&](std::size_t f) { return exact_side(v, f) > 0; })) {
      return true;
    }
  }
  return false;
}

class EventFinder {
 public:
  EventFinder(const ContactPiece& moving, const ContactPiece& fixed, const EventCell& cell,
              std::vector<ContactEvent>* events, std::vector<ScrewContact>* products)
      : a_(moving), b_(fixed), exact_(cell), cell_(cell.rounded), events_(events), products_(products) {
    reach_ = reach_of(a_, b_, cell_);
    error_ = product_error(reach_);
  }

  void run() {
    vertices_on_faces();
    faces_on_vertices();
    edges_on_edges();
  }

 private:
  template <typename Value>
  [[nodiscard]] bool has_no_root(const Value& value, double error) const {
    return common_sign(cell_, error, value) != 0;
  }

  // Takes the roots of the polynomial with these exact control values, value(matrix, position).
  template <typename Value>
  void take_roots(const Value& value, const ContactItems& items) {
    if (products_ != nullptr) return take_product(value, items);
    std::array<Rational, 3> c;
    if (exact_.turning) {
      std::array<Rational, 3> b;
      for (std::size_t i = 0; i < 3; ++i) b[i] = exact_.weights[i] * value(exact_.turns[i], exact_.positions[0]);
      c = {b[0], 2 * (b[1] - b[0]), b[0] - 2 * b[1] + b[2]};
    } else {
      const Rational begin = value(exact_.turns[0], exact_.positions[0]);
      c = {begin, value(exact_.turns[0], exact_.positions[1]) - begin, 0};
    }
    for (const QuadraticRoot& root : roots_in_unit_interval(c))
      events_->push_back({moved(root, exact_.from, exact_.width), items});
  }

  template <typename Value>
  void take_product(const Value& value, const ContactItems& items) {
    ScrewContact found;
    found.items = items;
    for (std::size_t i = 0; i < 3; ++i) {
      const Rational still = value(exact_.turns[i], exact_.positions[0]);
      found.product.still[i] = exact_.weights[i] * still;
      found.product.along[i] = exact_.weights[i] * (value(exact_.turns[i], exact_.positions[1]) - still);
    }
    if (!found.product.vanishes()) products_->push_back(std::move(found));
  }

  // Is a point of a piece surely behind a plane all the time? value(matrix, position, point); the points that are most
  // likely to be are tried.
  template <typename Value>
  [[nodiscard]] bool some_behind(const ContactPiece& piece, const Value& value) const {
    const auto behind = [&](const Vector3d& x) {
      return common_sign(cell_, error_, [&](const auto& m, const Vector3d& t) { return value(m, t, x); }) < 0;
    };
    if (behind(piece.middle)) return true;
    const auto at_first = [&](const Vector3d& x) { return value(cell_.turns[0], cell_.positions[0], x); };
    const std::vector<Vector3d>& points = piece.piece->points;
    const auto least = std::min_element(
        points.begin(), points.end(), [&](const Vector3d& x, const Vector3d& y) { return at_first(x) < at_first(y); });
    return behind(*least);
  }

  void vertices_on_faces() {
    for (std::uint32_t f = 0; f < b_.faces.size(); ++f) {
      const Vector3d& n = b_.piece->normals[f];
      const std::uint32_t corner = b_.faces[f].ring.front();
      const Vector3d& p = b_.piece->points[corner];
      const auto value = [&](const auto& m, const Vector3d& t, const Vector3d& x) {
        return vertex_product(n, p, m, t, x);
      };
      if (some_behind(a_, value)) continue;
      for (std::uint32_t v = 0; v < a_.vertices().size(); ++v) {
        const Vector3d& x = a_.piece->points[v];
        if (has_no_root([&](const auto& m, const Vector3d& t) { return value(m, t, x); }, error_)) continue;
        take_roots(
            [&](const Matrix3& m, const Rational3& t) {
              return dot(b_.faces[f].normal, plus(apply(m, a_.vertices()[v]), minus(t, b_.vertices()[corner])));
            },
            {ContactItems::Kind::kVertexFace, v, f});
      }
    }
  }

  void faces_on_vertices() {
    for (std::uint32_t f = 0; f < a_.faces.size(); ++f) {
      const Vector3d& n = a_.piece->normals[f];
      const std::uint32_t corner = a_.faces[f].ring.front();
      const double at = n.dot(a_.piece->points[corner]);
      const Rational exact_at = dot(a_.faces[f].normal, a_.vertices()[corner]);
      const auto value = [&](const auto& m, const Vector3d& t, const Vector3d& x) {
        return face_product(n, at, m, t, x);
      };
      if (some_behind(b_, value)) continue;
      for (std::uint32_t v = 0; v < b_.vertices().size(); ++v) {
        const Vector3d& x = b_.piece->points[v];
        if (has_no_root([&](const auto& m, const Vector3d& t) { return value(m, t, x); }, error_)) continue;
        take_roots(
            [&](const Matrix3& m, const Rational3& t) -> Rational {
              return dot(apply(m, a_.faces[f].normal), minus(b_.vertices()[v], t)) - exact_at;
            },
            {ContactItems::Kind::kFaceVertex, f, v});
      }
    }
  }

  void edges_on_edges() {
    for_each_close_edges(a_, b_, cell_, error_, [&](std::uint32_t i, std::uint32_t j) {
      if (!edges_have_no_root(i, j)) take_edges(i, j);
    });
  }

  [[nodiscard]] bool edges_have_no_root(std::uint32_t i, std::uint32_t j) const {
    const RoughEdge moving = rough_edge(a_, i);
    const RoughEdge fixed = rough_edge(b_, j);
    return has_no_root([&](const auto& m, const Vector3d& t) { return edge_product(moving, fixed, m, t); },
                       edge_product_error(reach_, moving, fixed));
  }

  static RoughEdge rough_edge(const ContactPiece& piece, std::uint32_t edge) {
    const Vector3d& from = piece.piece->points[piece.edges[edge].from];
    return {from, piece.piece->points[piece.edges[edge].to] - from};
  }

  void take_edges(std::uint32_t i, std::uint32_t j) {
    const Rational3& a = a_.vertices()[a_.edges[i].from];
    const Rational3& b = b_.vertices()[b_.edges[j].from];
    const Rational3 e = minus(a_.vertices()[a_.edges[i].to], a);
    const Rational3 g = minus(b_.vertices()[b_.edges[j].to], b);
    const Rational3 moment = cross(a, e);
    take_roots(
        [&](const Matrix3& m, const Rational3& t) -> Rational {
          return dot(g, apply(m, moment)) + dot(apply(m, e), cross(g, minus(t, b)));
        },
        {ContactItems::Kind::kEdges, i, j});
  }

  const ContactPiece& a_;
  const ContactPiece& b_;
  const EventCell& exact_;
  const MotionCell& cell_;
  double reach_ = 0;
  double error_ = 0;
  std::vector<ContactEvent>* events_;
  std::vector<ScrewContact>* products_;  // of a screw
};

Surd dot_of(const Surd3& a, const Surd3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Surd3 cross_of(const Surd3& a, const Surd3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Surd3 difference(const Surd3& a, const Surd3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Surd3 surds(const Rational3& v) { return {Surd(v[0]), Surd(v[1]), Surd(v[2])}; }
bool vanishes(const Surd3& v) { return v[0].sign() == 0 && v[1].sign() == 0 && v[2].sign() == 0; }

// Is a point of the plane of a convex polygon in it?
bool in_polygon(const Surd3& point, const std::vector<Surd3>& corners, const Surd3& normal) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Surd3 side = difference(corners[(i + 1) % corners.size()], corners[i]);
    if (dot_of(cross_of(normal, side), difference(point, corners[i])).sign() < 0) return false;
  }
  return true;
}

}  // namespace

ContactPiece::ContactPiece(const RigidBody::Piece& its_piece) : piece(&its_piece) {
  for (const Vector3d& x : its_piece.points) middle += x / static_cast<double>(its_piece.points.size());
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (std::size_t f = 0; f < its_piece.mesh.face_count(); ++f) {
    Face& face = faces.emplace_back();
    const auto ring = its_piece.mesh.face(f);
    face.ring.assign(ring.begin(), ring.end());
    std::vector<Rational3> corners;
    for (const std::uint32_t corner : face.ring) corners.push_back(its_piece.mesh.vertices[corner]);
    face.normal = normal_of(std::span<const Rational3>(corners));
    for (std::size_t i = 0; i < face.ring.size(); ++i) {
      const std::uint32_t a = face.ring[i];
      const std::uint32_t b = face.ring[(i + 1) % face.ring.size()];
      if (sides.emplace(std::min(a, b), std::max(a, b)).second) edges.push_back({a, b});
    }
  }
}

EventCell::EventCell(const Joint& joint, const Rational& begin, const Rational& end)
    : from(begin),
      width(end - begin),
      turning(joint.kind() != Joint::Kind::kSlider),
      rounded(joint.sweep(begin, end, 0).all) {
  const std::array<Quaternion, 2> ends = joint.arc(begin, end);
  const auto set = [&](std::size_t i, const Quaternion& p, const Quaternion& q) {
    turns[i] = rotation_between(p, q);
    weights[i] = scalar_product(p, q);
  };
  set(0, ends[0], ends[0]);
  set(1, ends[0], ends[1]);
  set(2, ends[1], ends[1]);
  if (!turning) positions = {joint.pose(begin).position, joint.pose(end).position};
  if (joint.kind() == Joint::Kind::kScrew) positions[1] = joint.direction();
}

void append_events(const ContactPiece& moving, const ContactPiece& fixed, const EventCell& cell,
                   std::vector<ContactEvent>& events) {
  EventFinder(moving, fixed, cell, &events, nullptr).run();
}

void append_products(const ContactPiece& moving, const ContactPiece& fixed, const EventCell& cell,
                     std::vector<ScrewContact>& products) {
  EventFinder(moving, fixed, cell, nullptr, &products).run();
}

std::size_t event_cost(const ContactPiece& moving, const ContactPiece& fixed) {
  return moving.vertices().size() * fixed.faces.size() + moving.faces.size() * fixed.vertices().size() +
         moving.edges.size() * fixed.edges.size();
}

// In doubles, by the first image of the moving piece. With R for the reach, points are off by less than e =
// product_error (as wide as the cell is, too), normals by 2^-50; differences are at most 2 R, so the side of a corner
// is off by less than 8 e R, and the products of edges, of four factors that are off by less than 2 e of 2 R each, by
// less than 128 e R^3.
bool may_touch(const ContactPiece& moving, const ContactPiece& fixed, const MotionCell& cell,
               const ContactItems& items) {
  const double reach = reach_of(moving, fixed, cell);
  const double error = product_error(reach);
  const auto image = [&](std::uint32_t v) -> Vector3d {
    return cell.turns[0] * moving.piece->points[v] + cell.positions[0];
  };
  const auto beside = [&](const Vector3d& point, const std::vector<Vector3d>& corners, const Vector3d& normal) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector3d side = corners[(i + 1) % corners.size()] - corners[i];
      if (normal.cross(side).dot(point - corners[i]) < -8 * error * reach) return true;
    }
    return false;
  };
  std::vector<Vector3d> corners;
  switch (items.kind) {
    case ContactItems::Kind::kVertexFace:
      for (const std::uint32_t corner : fixed.faces[items.fixed].ring) corners.push_back(fixed.piece->points[corner]);
      return !beside(image(items.moving), corners, fixed.piece->normals[items.fixed]);
    case ContactItems::Kind::kFaceVertex:
      for (const std::uint32_t corner : moving.faces[items.moving].ring) corners.push_back(image(corner));
      return !beside(fixed.piece->points[items.fixed], corners, cell.turns[0] * moving.piece->normals[items.moving]);
    default:
      break;
  }
  const ContactPiece::Edge& edge = moving.edges[items.moving];
  const ContactPiece::Edge& other = fixed.edges[items.fixed];
  const Vector3d e = image(edge.to) - image(edge.from);
  const Vector3d g = fixed.piece->points[other.to] - fixed.piece->points[other.from];
  const Vector3d n = e.cross(g);
  const Vector3d between = fixed.piece->points[other.from] - image(edge.from);
  const double slack = 128 * error * reach * reach * reach;
  const auto inside = [&](const Vector3d& along) {
    const double at = between.cross(along).dot(n);
    return at >= -slack && at <= n.squaredNorm() + slack;
  };
  return inside(g) && inside(e);
}

PlacedPiece::PlacedPiece(const ContactPiece& moving, const Joint& joint, const QuadraticRoot& value)
    : moving_(moving), around_(joint.sweep(value).all), pose_(joint.pose(value)) {
  for (const Rational3& v : moving.vertices()) {
    Surd3 x = turned(v);
    for (std::size_t k = 0; k < 3; ++k) x[k] = x[k] + pose_[3][k];
    vertices_.push_back(std::move(x));
  }
}

Surd3 PlacedPiece::turned(const Rational3& v) const {
  const Surd3 x = surds(v);
  return {dot_of(pose_[0], x), dot_of(pose_[1], x), dot_of(pose_[2], x)};
}

bool PlacedPiece::touches(const ContactPiece& fixed) const {
  const double error = product_error(reach_of(moving_, fixed, around_));
  if (is_vertex_in(fixed, error) || has_vertex_of(fixed, error)) return true;
  bool crossing = false;
  for_each_close_edges(moving_, fixed, around_, error, [&](std::uint32_t i, std::uint32_t j) {
    crossing = crossing || touch(fixed, {ContactItems::Kind::kEdges, i, j});
  });
  return crossing;
}

bool PlacedPiece::is_vertex_in(const ContactPiece& fixed, double error) const {
  const auto side = [&](std::size_t v, std::size_t f) {
    const Vector3d& x = moving_.piece->points[v];
    const Vector3d& n = fixed.piece->normals[f];
    const Vector3d& p = fixed.piece->points[fixed.faces[f].ring.front()];
    return common_sign(around_, error, [&](const auto& m, const Vector3d& t) { return vertex_product(n, p, m, t, x); });
  };
  const auto exact_side = [&](std::size_t v, std::size_t f) {
    const ContactPiece::Face& face = fixed.faces[f];
    return dot_of(surds(face.normal), difference(vertices_[v], surds(fixed.vertices()[face.ring.front()]))).sign();
  };
  return some_is_inside(vertices_.size(), fixed.faces.size(), side, exact_side);
}

bool PlacedPiece::has_vertex_of(const ContactPiece& fixed, double error) const {
  const auto side = [&](std::size_t v, std::size_t f) {
    const Vector3d& x = fixed.piece->points[v];
    const Vector3d& n = moving_.piece->normals[f];
    const double at = n.dot(moving_.piece->points[moving_.faces[f].ring.front()]);
    return common_sign(around_, error, [&](const auto& m, const Vector3d& t) { return face_product(n, at, m, t, x); });
  };
  const auto exact_side = [&](std::size_t v, std::size_t f) {
    const ContactPiece::Face& face = moving_.faces[f];
    return dot_of(turned(face.normal), difference(surds(fixed.vertices()[v]), vertices_[face.ring.front()])).sign();
  };
  return some_is_inside(fixed.vertices().size(), moving_.faces.size(), side, exact_side);
}

bool PlacedPiece::is_between(const ContactPiece& fixed, const ContactItems& items) const {
  switch (items.kind) {
    case ContactItems::Kind::kVertexFace: {
      const ContactPiece::Face& face = fixed.faces[items.fixed];
      const Surd3 normal = surds(face.normal);
      const Surd3 corner = surds(fixed.vertices()[face.ring.front()]);
      return std::all_of(vertices_.begin(), vertices_.end(),
                         [&](const Surd3& x) { return dot_of(normal, difference(x, corner)).sign() >= 0; });
    }
    case ContactItems::Kind::kFaceVertex: {
      const ContactPiece::Face& face = moving_.faces[items.moving];
      const Surd3 normal = turned(face.normal);
      const Surd at = dot_of(normal, vertices_[face.ring.front()]);
      return std::all_of(fixed.vertices().begin(), fixed.vertices().end(),
                         [&](const Rational3& y) { return (dot_of(normal, surds(y)) - at).sign() >= 0; });
    }
    default:
      return edges_between(fixed, items);
  }
}

bool PlacedPiece::edges_between(const ContactPiece& fixed, const ContactItems& items) const {
  const ContactPiece::Edge& edge = moving_.edges[items.moving];
  const ContactPiece::Edge& other = fixed.edges[items.fixed];
  const Surd3 along = difference(vertices_[edge.to], vertices_[edge.from]);
  const Surd3 normal = cross_of(along, surds(minus(fixed.vertices()[other.to], fixed.vertices()[other.from])));
  if (vanishes(normal)) return false;
  const Surd at = dot_of(normal, vertices_[edge.from]);
  // On which sides of the plane some vertices are: of the moving piece, and of the other one.
  int moving_side = 0;
  for (const Surd3& x : vertices_) {
    const int side = (dot_of(normal, x) - at).sign();
    if (side * moving_side < 0) return false;
    if (side != 0) moving_side = side;
  }
  return std::all_of(fixed.vertices().begin(), fixed.vertices().end(),
                     [&](const Rational3& y) { return (dot_of(normal, surds(y)) - at).sign() * moving_side <= 0; });
}

bool PlacedPiece::touch(const ContactPiece& fixed, const ContactItems& items) const {
  std::vector<Surd3> corners;
  switch (items.kind) {
    case ContactItems::Kind::kVertexFace: {
      const ContactPiece::Face& face = fixed.faces[items.fixed];
      for (const std::uint32_t corner : face.ring) corners.push_back(surds(fixed.vertices()[corner]));
      return in_polygon(vertices_[items.moving], corners, surds(face.normal));
    }
    case ContactItems::Kind::kFaceVertex: {
      const ContactPiece::Face& face = moving_.faces[items.moving];
      for (const std::uint32_t corner : face.ring) corners.push_back(vertices_[corner]);
      return in_polygon(surds(fixed.vertices()[items.fixed]), corners, turned(face.normal));
    }
    default:
      break;
  }
  const ContactPiece::Edge& edge = moving_.edges[items.moving];
  const ContactPiece::Edge& other = fixed.edges[items.fixed];
  const Surd3 a = vertices_[edge.from];
  const Surd3 b = surds(fixed.vertices()[other.from]);
  const Surd3 e = difference(vertices_[edge.to], a);
  const Surd3 g = surds(minus(fixed.vertices()[other.to], fixed.vertices()[other.from]));
  const Surd3 n = cross_of(e, g);
  if (vanishes(n)) return false;
  // a + s e = b + t g, where s n n and t n n are these.
  const Surd3 between = difference(b, a);
  if (dot_of(between, n).sign() != 0) return false;
  const Surd square = dot_of(n, n);
  for (const Surd3* along : {&g, &e}) {
    const Surd at = dot_of(cross_of(between, *along), n);
    if (at.sign() < 0 || (square - at).sign() < 0) return false;
  }
  return true;
}

}  // namespace nef::planner
