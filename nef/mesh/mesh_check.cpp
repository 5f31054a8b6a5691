// SPDX-License-Identifier: Apache-2.0
//
// Faces, duplicates, edges, contacts, planarity, vertices and orientation are checked one after another, and each
// finding is one record with its elements. Edges and duplicates are found by sorting keys, contacts by
// `SurfaceContacts`. If all faces are triangles whose stars are closed, edges and duplicates need no search. The sign
// of the enclosed volume is summed in doubles with a bound, and exactly if that does not tell.
#include "nef/mesh/mesh_check.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <span>

#include "nef/base/fast_path.h"
#include "nef/mesh/area_vector.h"
#include "nef/mesh/edge_order.h"
#include "nef/mesh/surface/convex_surface.h"
#include "nef/mesh/surface/equal_faces.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/mesh/surface/surface_contacts.h"
#include "nef/number/brief_text.h"

namespace nef {
namespace {

std::string number(std::size_t value) { return std::to_string(value); }

std::string edge_text(const std::array<std::uint32_t, 2>& edge) {
  return "edge " + number(edge[0]) + "-" + number(edge[1]);
}

std::string face_list(const std::vector<std::uint32_t>& faces) {
  std::string text = faces.size() == 1 ? "face " : "faces ";
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (i > 0) text += i + 1 == faces.size() ? " and " : ", ";
    text += number(faces[i]);
  }
  return text;
}

// Gathers problems, at most so many of each kind, legal and illegal ones counted apart, and edges by their balance.
class Report {
 public:
  explicit Report(std::size_t limit) : limit_(limit) {}

  // False once the kind is full.
  bool add(MeshProblem problem) {
    is_legal_ = is_legal_ && problem.legal;
    std::size_t& count = counts_[6 * static_cast<std::size_t>(problem.kind) +
                                 2 * static_cast<std::size_t>(problem.balance) + (problem.legal ? 1 : 0)];
    if (count < limit_) {
      ++count;
      problems_.push_back(std::move(problem));
    }
    return count < limit_;
  }

  /// False once something was added that no solid has.
  [[nodiscard]] bool is_legal() const { return is_legal_; }

  std::vector<MeshProblem> take() {
    std::stable_sort(problems_.begin(), problems_.end(),
                     [](const MeshProblem& a, const MeshProblem& b) { return a.kind < b.kind; });
    return std::move(problems_);
  }

 private:
  std::size_t limit_;
  bool is_legal_ = true;
  std::array<std::size_t, 72> counts_{};
  std::vector<MeshProblem> problems_;
};

MeshProblem face_problem(MeshProblemKind kind, std::uint32_t face, std::string what) {
  MeshProblem problem;
  problem.kind = kind;
  problem.faces = {face};
  problem.text = "face " + number(face) + " " + std::move(what);
  return problem;
}

void check_faces(const Mesh& mesh, const MeshSurface& surface, Report& report) {
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    switch (surface.defects[f]) {
      case FaceDefect::kNone:
        if (surface.irregular[f]) {
          MeshProblem problem =
              face_problem(MeshProblemKind::kDegenerateFace, f, "comes to a vertex twice; it is cut there");
          problem.legal = true;
          report.add(std::move(problem));
        }
        break;
      case FaceDefect::kBadIndex: {
        MeshProblem problem = face_problem(MeshProblemKind::kBadIndex, f, "");
        for (const std::uint32_t v : mesh.face(f)) {
          if (v >= mesh.vertices.size()) problem.vertices.push_back(v);
        }
        problem.text +=
            "names vertex " + number(problem.vertices[0]) + ", but there are " + number(mesh.vertices.size());
        report.add(std::move(problem));
        break;
      }
      case FaceDefect::kTooFewCorners:
        report.add(face_problem(MeshProblemKind::kDegenerateFace, f, "has fewer than three corners"));
        break;
      case FaceDefect::kNoArea: {
        MeshProblem problem = face_problem(MeshProblemKind::kDegenerateFace, f, "has no area and is left out");
        problem.legal = true;
        report.add(std::move(problem));
        break;
      }
      case FaceDefect::kCrossesItself:
        report.add(face_problem(MeshProblemKind::kSelfIntersection, f, "crosses itself"));
        break;
    }
  }
}

// True if one ring is the other, walked backward.
bool turned_against(const Mesh& mesh, const MeshSurface& surface, std::uint32_t f, std::uint32_t g) {
  const auto a = mesh.face(f);
  const auto b = mesh.face(g);
  const std::size_t n = a.size();
  if (b.size() != n) return false;
  for (std::size_t shift = 0; shift < n; ++shift) {
    std::size_t i = 0;
    while (i < n && surface.place[a[i]] == surface.place[b[(shift + n - i) % n]]) ++i;
    if (i == n) return true;
  }
  return false;
}

void check_duplicates(const Mesh& mesh, const MeshSurface& surface, Report& report, const Monitor& monitor) {
  std::vector<std::uint32_t> latest = first_with_corners(mesh, surface, monitor);  // of the faces with these corners
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::uint32_t f = 0; f < latest.size(); ++f) {
    const std::uint32_t first = latest[f];
    if (first == f) continue;
    pairs.push_back({latest[first], f});
    latest[first] = f;
  }
  std::sort(pairs.begin(), pairs.end());
  for (const auto& [f, g] : pairs) {
    MeshProblem problem;
    problem.kind = MeshProblemKind::kDuplicateFace;
    problem.faces = {f, g};
    problem.legal = turned_against(mesh, surface, f, g);
    problem.text = face_list(problem.faces) + " have the same corners";
    if (problem.legal) problem.text += ", back to back";
    report.add(std::move(problem));
  }
}

struct FaceEdge {
  std::uint64_t key = 0;
  std::uint32_t face = 0;
  bool forward = false;
  std::array<std::uint32_t, 2> vertices{};  // as the face names them
};

std::vector<FaceEdge> face_edges(const Mesh& mesh, const MeshSurface& surface) {
  std::vector<FaceEdge> edges;
  edges.reserve(mesh.corners.size());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (surface.defects[f] == FaceDefect::kBadIndex) continue;
    const auto face = mesh.face(f);
    for (std::size_t i = 0; i < face.size(); ++i) {
      const std::uint32_t u = surface.place[face[i]];
      const std::uint32_t v = surface.place[face[(i + 1) % face.size()]];
      if (u == v) continue;
      edges.push_back({edge_key(u, v), f, u < v, {face[i], face[(i + 1) % face.size()]}});
    }
  }
  sort_by_pair(edges, mesh.vertices.size());
  return edges;
}

// Returns true if every edge is used equally often in both directions.
bool check_edges(const Mesh& mesh, const MeshSurface& surface, const SurfaceContacts& contacts, Report& report) {
  std::optional<std::set<std::uint64_t>> crossing;  // looked for when an edge has more than two faces
  const auto crosses = [&](std::uint64_t key) {
    if (!crossing) {
      crossing.emplace();
      contacts.for_each_bad_edge([&](std::uint32_t u, std::uint32_t v, std::span<const std::uint32_t> /*triangles*/) {
        crossing->insert(pair_key(u, v));
        return true;
      });
    }
    return crossing->count(key) > 0;
  };
  bool balanced = true;
  const std::vector<FaceEdge> edges = face_edges(mesh, surface);
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    std::size_t forward = 0;
    for (last = first; last < edges.size() && edges[last].key == edges[first].key; ++last) {
      forward += edges[last].forward ? 1 : 0;
    }
    const std::size_t count = last - first;
    const bool even = 2 * forward == count;
    balanced = balanced && even;
    if (count == 2 && even) continue;
    MeshProblem problem;
    problem.edges = {edges[first].vertices};
    problem.vertices = {edges[first].vertices[0], edges[first].vertices[1]};
    for (std::size_t i = first; i < last; ++i) problem.faces.push_back(edges[i].face);
    problem.text = edge_text(problem.edges[0]);
    if (!even) problem.balance = count % 2 == 0 ? EdgeBalance::kEven : EdgeBalance::kOdd;
    if (count == 1) {
      problem.kind = MeshProblemKind::kOpenBorder;
      problem.text += " belongs to " + face_list(problem.faces) + " only: the surface is open there";
    } else if (count == 2) {
      problem.kind = MeshProblemKind::kInconsistentOrientation;
      problem.text += " is run through in the same direction by " + face_list(problem.faces) + ": flip one of them";
    } else {
      problem.kind = MeshProblemKind::kNonManifoldEdge;
      problem.legal = even && !crosses(edges[first].key);
      problem.text += " belongs to " + number(count) + " faces (" + face_list(problem.faces) + ")";
      problem.text += problem.legal ? ", which pair up: solids touch there"
                      : even        ? ", which do not separate inside from outside there"
                                    : ", which do not pair up";
    }
    report.add(std::move(problem));
  }
  return balanced;
}

// True if all faces are good triangles, so that the triangles of the surface are they.
bool all_triangles(const MeshSurface& surface) {
  return surface.triangles.size() == surface.defects.size() &&
         std::all_of(surface.defects.begin(), surface.defects.end(),
                     [](FaceDefect defect) { return defect == FaceDefect::kNone; }) &&
         std::find(surface.irregular.begin(), surface.irregular.end(), true) == surface.irregular.end();
}

MeshProblem contact_problem(SurfaceContacts::Kind kind, std::uint32_t f, std::uint32_t g) {
  using Contact = SurfaceContacts::Kind;
  MeshProblem problem;
  problem.legal = kind == Contact::kTouch || kind == Contact::kCover;
  problem.kind = problem.legal ? MeshProblemKind::kTouching : MeshProblemKind::kSelfIntersection;
  problem.faces = f == g ? std::vector<std::uint32_t>{f} : std::vector<std::uint32_t>{std::min(f, g), std::max(f, g)};
  problem.text = face_list(problem.faces);
  if (kind == Contact::kTouch) {
    problem.text += f == g ? " touches itself" : " touch without sharing a vertex or edge there";
  } else if (kind == Contact::kCover) {
    problem.text += f == g ? " covers itself, folded" : " cover each other, back to back";
  } else if (kind == Contact::kCross) {
    problem.text += f == g ? " crosses itself" : " cross each other";
  } else {
    problem.text += f == g ? " overlaps itself" : " overlap in a common plane";
  }
  return problem;
}

void check_contacts(const MeshSurface& surface, std::span<const FaceContact> found, Report& report) {
  using Contact = SurfaceContacts::Kind;
  std::vector<bool> covered;  // of each face: another one lies on it, back to back
  for (const FaceContact& contact : found) {
    if (!contact.covers) continue;
    covered.resize(surface.defects.size(), false);
    covered[contact.f] = covered[contact.g] = true;
  }
  for (const FaceContact& contact : found) {
    MeshProblem problem = contact_problem(contact.kind, contact.f, contact.g);
    if (contact.kind == Contact::kOverlap && !covered.empty() && (covered[contact.f] || covered[contact.g])) {
      // A third face may undo one of the two; the winding numbers will tell.
      problem.kind = MeshProblemKind::kTouching;
      problem.legal = true;
    }
    report.add(std::move(problem));
  }
}

void check_planarity(const Mesh& mesh, const MeshSurface& surface, Report& report) {
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (surface.planar[f]) continue;
    MeshProblem problem = face_problem(MeshProblemKind::kNonPlanarFace, f, "is not planar: a corner is ");
    problem.text += face_deviation_text(mesh, f) + " off its plane";
    problem.legal = true;
    report.add(std::move(problem));
  }
}

void check_vertices(const Mesh& mesh, const MeshSurface& surface, Report& report) {
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const std::uint32_t v : mesh.corners) {
    if (v < used.size()) used[surface.place[v]] = true;
  }
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    if (used[surface.place[v]]) continue;
    MeshProblem problem;
    problem.kind = MeshProblemKind::kIsolatedVertex;
    problem.legal = true;
    problem.vertices = {v};
    problem.text = "vertex " + number(v) + " belongs to no face";
    if (!report.add(std::move(problem))) return;
  }
}

// The sign of the enclosed volume: in doubles, exactly where these can not tell.
int volume_sign(const Mesh& mesh, const MeshSurface& surface) {
  double sum = 0;
  double size = 0;
  for (const auto& t : surface.triangles) {
    const auto& a = surface.points.approximate(t[0]);
    const auto& b = surface.points.approximate(t[1]);
    const auto& c = surface.points.approximate(t[2]);
    const double x = a[0] * (b[1] * c[2] - b[2] * c[1]);
    const double y = a[1] * (b[2] * c[0] - b[0] * c[2]);
    const double z = a[2] * (b[0] * c[1] - b[1] * c[0]);
    sum += x + y + z;
    size += std::abs(a[0]) * (std::abs(b[1] * c[2]) + std::abs(b[2] * c[1])) +
            std::abs(a[1]) * (std::abs(b[2] * c[0]) + std::abs(b[0] * c[2])) +
            std::abs(a[2]) * (std::abs(b[0] * c[1]) + std::abs(b[1] * c[0]));
  }
  // u = 2^-53. Each of the three coordinates of a term is off by 4u (PointTable), three products and differences round
  // by u each: 15u of its size, 2^-49. The n sums, and those of x, y and z, add (n + 2)u of all sizes, of which `size`
  // is n u off itself: less than 2^-44 + n 2^-52 in all. What underflows, in coordinates or in products, is off by
  // 2^-1074 and is multiplied by two coordinates at most, which are moderate: far below 1e-150.
  const auto n = static_cast<double>(surface.triangles.size());
  if (surface.points.moderate() && std::abs(sum) > size * (0x1p-44 + 0x1p-52 * n) + 1e-150 * n) {
    return sum > 0 ? 1 : -1;
  }
  if (!surface.points.are_numbers()) throw OpenQuestion();
  Rational exact = 0;
  for (const auto& t : surface.triangles) {
    exact += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]]));
  }
  return sgn(exact);
}

}  // namespace

const char* name(MeshProblemKind kind) {
  switch (kind) {
    case MeshProblemKind::kBadIndex:
      return "bad index";
    case MeshProblemKind::kDegenerateFace:
      return "degenerate face";
    case MeshProblemKind::kDuplicateFace:
      return "duplicate face";
    case MeshProblemKind::kOpenBorder:
      return "open border";
    case MeshProblemKind::kNonManifoldEdge:
      return "non-manifold edge";
    case MeshProblemKind::kInconsistentOrientation:
      return "inconsistent orientation";
    case MeshProblemKind::kSelfIntersection:
      return "self-intersection";
    case MeshProblemKind::kTouching:
      return "touching";
    case MeshProblemKind::kNonPlanarFace:
      return "non-planar face";
    case MeshProblemKind::kIsolatedVertex:
      return "isolated vertex";
    case MeshProblemKind::kInsideOut:
      return "inside out";
  }
  return "unknown problem";
}

bool is_strictly_legal(const MeshProblem& problem) {
  switch (problem.kind) {
    case MeshProblemKind::kNonManifoldEdge:
    case MeshProblemKind::kNonPlanarFace:
    case MeshProblemKind::kIsolatedVertex:
      return problem.legal;
    default:
      return false;
  }
}

std::vector<MeshProblem> check_mesh(const Mesh& mesh, const MeshCheckOptions& options, const Monitor& monitor) {
  return check_mesh(mesh, MeshSurface(mesh, monitor), options, monitor);
}

std::vector<MeshProblem> check_mesh(const Mesh& mesh, const MeshSurface& surface, const MeshCheckOptions& options,
                                    const Monitor& monitor, std::optional<std::vector<FaceContact>>* contacts,
                                    OpenPairs* open) {
  std::optional<std::vector<FaceContact>> own;
  std::optional<std::vector<FaceContact>>& found = contacts == nullptr ? own : *contacts;
  if (kFastPaths && bounds_small_convex_solids(mesh, surface, monitor)) {
    found.emplace();
    return {};
  }
  Report report(options.max_per_kind);
  const SurfaceContacts meeting(surface, monitor);
  check_faces(mesh, surface, report);
  bool closed = all_triangles(surface) && meeting.stars().all_closed();
  if (!closed) {
    check_duplicates(mesh, surface, report, monitor);
    closed = check_edges(mesh, surface, meeting, report);
  }
  const bool decided = options.only_verdict && !report.is_legal();
  if (options.self_intersections && !decided) {
    if (!found) found = face_contacts(surface, meeting, open);
    check_contacts(surface, *found, report);
  }
  check_planarity(mesh, surface, report);
  check_vertices(mesh, surface, report);
  if (closed && !surface.triangles.empty() && volume_sign(mesh, surface) < 0) {
    MeshProblem problem;
    problem.kind = MeshProblemKind::kInsideOut;
    problem.legal = true;
    problem.text = "the mesh is inside out: its faces are clockwise as seen from outside";
    report.add(std::move(problem));
  }
  return report.take();
}

double face_deviation(const Mesh& mesh, std::size_t face) {
  const auto corners = mesh.face(face);
  if (corners.size() < 4) return 0;
  const Rational3 normal = area_vector(mesh, corners);
  const Rational length2 = dot(normal, normal);
  if (length2 == 0) return 0;
  std::vector<Rational3> points;
  for (const std::uint32_t v : corners) points.push_back(mesh.vertices[v]);
  const Rational3 centre = mean_of<Rational>(points);
  Rational largest = 0;
  for (const Rational3& p : points) largest = std::max(largest, Rational(abs(dot(normal, minus(p, centre)))));
  return std::sqrt(nearest_double(largest * largest / length2));
}

std::string face_deviation_text(const Mesh& mesh, std::size_t face) {
  return short_text(face_deviation(mesh, face), 3);
}

std::string not_planar_text(const Mesh& mesh, std::size_t face) {
  return "face " + std::to_string(face) + " is not planar (off by " + face_deviation_text(mesh, face) + ")";
}

}  // namespace nef
