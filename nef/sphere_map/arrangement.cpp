// SPDX-License-Identifier: Apache-2.0
//
// Sorting: the halves at a node are put into buckets by counting, and sorted by angle around the direction of the node.
//
// Simplification (thesis 4.4): arcs with one mark on both sides and in between are dropped; nodes at which two arcs of
// one circle with the node's mark meet are passed; isolated nodes that differ from nothing disappear. What remains are
// chains of arcs between essential nodes, and circles without any, which become an sloop. Each chain becomes a pair of
// shalfedges. Assembly links them around the nodes, traces the cycles, and puts cycles of different components that
// bound one sface together (`join_cycles`, only if Euler's formula says that there are several components). A ring in
// which nothing is redundant, the usual corner of a solid, is written in one walk. O(k log k) for k arcs, plus the
// joining.
#include "nef/sphere_map/arrangement.h"

#include <algorithm>
#include <numeric>

#include "nef/base/defect.h"
#include "nef/sphere_map/components.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef {

void Arrangement::clear() {
  nodes.clear();
  arcs.clear();
  circle = {};
  background = 0;
  centre = 0;
}

void Arrangement::load(const PlaneTable& planes, const SphereMapView& map) {
  clear();
  centre = map.mark;
  const auto face = [&map](std::uint32_t sface) { return map.sfaces[sface].mark; };
  background = face(0);
  for (const SVertex& v : map.svertices) {
    Node node;
    node.direction = direction_of(planes, v);
    node.mark = v.mark;
    node.around = v.out == kNone ? face(v.sface) : LabelId{0};
    nodes.push_back(std::move(node));
  }
  for (std::uint32_t e = 0; e < map.shalfedges.size(); e += 2) {
    const SHalfedge& half = map.shalfedges[e];
    arcs.push_back(
        {half.plane, half.source, map.target(e), half.mark, face(half.sface), face(map.shalfedges[e + 1].sface)});
  }
  if (!map.sloops.empty()) {
    circle = {true, map.sloops[0].plane, map.sloops[0].mark, face(map.sloops[0].sface), face(map.sloops[1].sface)};
  }
}

void Arrangement::sort_around_nodes(const PlaneTable& planes, const Monitor& monitor) {
  for (Node& node : nodes) node.degree = 0;
  for (const Arc& arc : arcs) {
    ++nodes[arc.source].degree;
    ++nodes[arc.target].degree;
  }
  std::uint32_t offset = 0;
  for (Node& node : nodes) {
    node.first_half = offset;
    offset += node.degree;
    node.degree = 0;
  }
  halves_.resize(offset);
  for (std::uint32_t half = 0; half < 2 * arcs.size(); ++half) {
    Node& node = nodes[source(half)];
    halves_[node.first_half + node.degree++] = half;
  }
  for (const Node& node : nodes) {
    if (node.degree <= 2) continue;  // any two are in cyclic order
    const auto first = halves_.begin() + node.first_half;
    const Direction reference = Direction::normal(planes, plane(*first));
    std::sort(first + 1, first + node.degree, [&](std::uint32_t a, std::uint32_t b) {
      return compare_around(node.direction, reference, Direction::normal(planes, plane(a)),
                            Direction::normal(planes, plane(b)), monitor) < 0;
    });
  }
}

void Arrangement::drop_redundant_arcs() {
  const auto redundant = [this](std::uint32_t half) {
    const Arc& arc = arcs[half >> 1U];
    return arc.mark == arc.left && arc.mark == arc.right;
  };
  for (Node& node : nodes) {
    const auto first = halves_.begin() + node.first_half;
    const auto last = first + node.degree;
    if (first != last && redundant(*first)) node.around = arcs[*first >> 1U].mark;
    node.degree = static_cast<std::uint32_t>(std::remove_if(first, last, redundant) - first);
  }
}

bool Arrangement::passes_through(std::uint32_t index) const {
  const Node& node = nodes[index];
  if (node.degree != 2) return false;
  const std::uint32_t a = halves_[node.first_half];
  const std::uint32_t b = halves_[node.first_half + 1];
  return plane(a) == plane(b).opposite() && arcs[a >> 1U].mark == node.mark && arcs[b >> 1U].mark == node.mark;
}

// Walks from each half that leaves an essential node through nodes that are not. Both directions
// of a chain are walked at once by symmetry: the chain that starts with h and ends with e is, seen
// from its other end, the chain that starts with e^1 and ends with h^1.
void Arrangement::trace_chains() {
  chain_end_.assign(2 * arcs.size(), kNone);
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    if (!essential(n)) continue;
    for (const std::uint32_t half : around(n)) {
      if (chain_end_[half] != kNone) continue;
      std::uint32_t end = half;
      while (!essential(target(end))) {
        role_[target(end)] = Role::kInChain;
        const std::span<const std::uint32_t> two = around(target(end));
        end = two[0] == (end ^ 1U) ? two[1] : two[0];
      }
      chain_end_[half] = end;
      chain_end_[end ^ 1U] = half ^ 1U;
    }
  }
}

// The corner of a solid as a rule: one ring of arcs in which nothing is redundant. It is walked around once.
bool Arrangement::assemble_ring(const PlaneTable& planes, SphereMapBuffer& out, const Monitor& monitor) const {
  const auto n = static_cast<std::uint32_t>(nodes.size());
  if (n < 2 || arcs.size() != n || circle.present) return false;
  for (const Arc& arc : arcs) {
    if (arc.mark == arc.left && arc.mark == arc.right) return false;
  }
  std::uint32_t half = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t node = source(half);
    if (nodes[node].degree != 2 || passes_through(node) || (i > 0 && half == 0)) return false;
    const std::uint32_t ahead = i + 1 == n ? 0 : i + 1;
    const std::uint32_t behind = i == 0 ? n - 1 : i - 1;
    SVertex v;
    v.p = nodes[node].direction.p;
    v.q = nodes[node].direction.q;
    v.out = 2 * i;
    v.mark = nodes[node].mark;
    choose_planes(planes, node, v, monitor);
    out.svertices.push_back(v);
    const LabelId mark = arcs[half >> 1U].mark;
    detail::require_one_mark(left(half) == left(0) && left(half ^ 1U) == left(1), "an sface has one mark",
                             {{"svertex", i}});
    out.shalfedges.push_back({plane(half), i, 2 * ahead, 2 * behind, 0, mark});
    out.shalfedges.push_back({plane(half ^ 1U), ahead, 2 * behind + 1, 2 * ahead + 1, 1, mark});
    const std::uint32_t there = target(half);
    if (nodes[there].degree != 2) return false;
    const std::span<const std::uint32_t> two = around(there);
    half = two[0] == (half ^ 1U) ? two[1] : two[0];
  }
  if (half != 0) return false;
  for (const std::uint32_t side : {0U, 1U}) {
    out.sfaces.push_back({side, 1, left(side)});
    out.entries.push_back({SFaceEntry::Kind::kCycle, side});
  }
  return true;
}

void Arrangement::simplify_and_assemble(const PlaneTable& planes, SphereMapBuffer& out, const Monitor& monitor) {
  monitor.check_interruption();  // whatever makes many vertices comes through here
  out.clear();
  out.mark = centre;
  if (assemble_ring(planes, out, monitor)) return;
  out.clear();
  out.mark = centre;
  drop_redundant_arcs();
  role_.assign(nodes.size(), Role::kPassed);
  std::uint32_t passed = kNone;
  LabelId whole = background;
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    const Node& node = nodes[n];
    if (node.degree == 0) {
      role_[n] = node.mark != node.around ? Role::kEssential : Role::kInChain;
      whole = node.around;
    } else if (passes_through(n)) {
      passed = n;
    } else {
      role_[n] = Role::kEssential;
    }
  }
  trace_chains();
  Circle loop = circle;
  if (loop.present && loop.mark == loop.left && loop.mark == loop.right) {
    whole = loop.mark;
    loop = {};
  }
  // A passed node that no chain has reached lies on a circle of such nodes: it becomes the loop.
  for (std::uint32_t n = 0; n < nodes.size() && passed != kNone && !loop.present; ++n) {
    if (role_[n] != Role::kPassed) continue;
    const std::uint32_t half = halves_[nodes[n].first_half];
    loop = Circle{true, plane(half), nodes[n].mark, left(half), left(half ^ 1U)};
  }
  build_incidences(planes, out, monitor);
  if (loop.present) {
    out.sloops.push_back({loop.plane, kNone, loop.mark});
    out.sloops.push_back({loop.plane.opposite(), kNone, loop.mark});
    out.sfaces.push_back({0, 0, loop.left});  // marks for build_faces, which replaces these
    out.sfaces.push_back({0, 0, loop.right});
  }
  if (out.svertices.empty() && !loop.present) {
    out.sfaces.push_back({0, 0, whole});
    return;
  }
  build_faces(planes, out, monitor);
}

void Arrangement::build_incidences(const PlaneTable& planes, SphereMapBuffer& out, const Monitor& monitor) {
  node_svertex_.assign(nodes.size(), kNone);
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    if (!essential(n)) continue;
    node_svertex_[n] = static_cast<std::uint32_t>(out.svertices.size());
    SVertex v;
    v.p = nodes[n].direction.p;
    v.q = nodes[n].direction.q;
    v.mark = nodes[n].mark;
    out.svertices.push_back(v);
  }
  final_half_.assign(2 * arcs.size(), kNone);
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    if (!essential(n)) continue;
    for (const std::uint32_t half : around(n)) {
      if (final_half_[half] != kNone) continue;
      const auto even = static_cast<std::uint32_t>(out.shalfedges.size());
      const std::uint32_t back = chain_end_[half] ^ 1U;
      final_half_[half] = even;
      final_half_[back] = even + 1;
      SHalfedge e;
      e.mark = arcs[half >> 1U].mark;
      e.plane = plane(half);
      e.source = node_svertex_[n];
      out.shalfedges.push_back(e);
      e.plane = plane(back);
      e.source = node_svertex_[source(back)];
      out.shalfedges.push_back(e);
    }
  }
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    if (!essential(n)) continue;
    const std::span<const std::uint32_t> ring = around(n);
    if (ring.empty()) continue;
    out.svertices[node_svertex_[n]].out = final_half_[ring[0]];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      // The sface left of the shalfedge that arrives along ring[i] continues with its clockwise
      // neighbour.
      const std::uint32_t arriving = final_half_[ring[i]] ^ 1U;
      const std::uint32_t leaving = final_half_[ring[(i + ring.size() - 1) % ring.size()]];
      out.shalfedges[arriving].next = leaving;
      out.shalfedges[leaving].prev = arriving;
    }
  }
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    if (essential(n)) choose_planes(planes, n, out.svertices[node_svertex_[n]], monitor);
  }
}

// An svertex should be the meeting of two planes of facets that are there: then no plane outlives
// its facets, and both ends of an edge use planes of the same facets.
void Arrangement::choose_planes(const PlaneTable& planes, std::uint32_t node, SVertex& v,
                                const Monitor& monitor) const {
  const std::span<const std::uint32_t> ring = around(node);
  const auto require_planes = [&v, node] {
    detail::require(v.p.valid() && v.q.valid(), "an svertex is where two planes meet", {{"node", node}});
  };
  if (ring.size() < 2) return require_planes();
  PlaneId first = plane(ring[0]);
  PlaneId second;
  for (const std::uint32_t half : ring) {
    const PlaneId candidate = plane(half);
    if (candidate.row() < first.row()) first = candidate;
  }
  for (const std::uint32_t half : ring) {
    const PlaneId candidate = plane(half);
    if (candidate.row() != first.row() && (!second.valid() || candidate.row() < second.row())) second = candidate;
  }
  if (!second.valid()) return require_planes();  // an edge within one plane, whose faces do not go on from each other
  first = first.unflipped();
  second = second.unflipped();
  if (v.p == first && v.q == second) return;
  const bool same_pair = (v.p.row() == first.row() && v.q.row() == second.row()) ||
                         (v.p.row() == second.row() && v.q.row() == first.row());
  bool positive = false;
  if (same_pair) {
    positive = (v.p.flipped() != v.q.flipped()) == (v.p.row() != first.row());
  } else {
    positive = sign_of_dot(nodes[node].direction, Direction::cross(planes, first, second), monitor) > 0;
  }
  v.p = first;
  v.q = positive ? second : second.opposite();
}

// Every cycle of shalfedges, every isolated svertex and every side of an sloop bounds an sface.
void Arrangement::collect_cycles(const SphereMapBuffer& out) {
  cycles_.clear();
  cycle_of_half_.assign(out.shalfedges.size(), kNone);
  cycle_of_vertex_.assign(out.svertices.size(), kNone);
  cycle_of_loop_.clear();
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    if (!essential(n)) continue;
    for (const std::uint32_t half : around(n)) {
      const std::uint32_t start = final_half_[half];
      if (cycle_of_half_[start] != kNone) continue;
      const auto cycle = static_cast<std::uint32_t>(cycles_.size());
      cycles_.push_back({{SFaceEntry::Kind::kCycle, start}, left(half)});
      for (std::uint32_t e = start; cycle_of_half_[e] == kNone; e = out.shalfedges[e].next) cycle_of_half_[e] = cycle;
    }
    if (nodes[n].degree == 0) {
      cycle_of_vertex_[node_svertex_[n]] = static_cast<std::uint32_t>(cycles_.size());
      cycles_.push_back({{SFaceEntry::Kind::kIsolatedVertex, node_svertex_[n]}, nodes[n].around});
    }
  }
  for (std::uint32_t side = 0; side < out.sloops.size(); ++side) {
    cycle_of_loop_.push_back(static_cast<std::uint32_t>(cycles_.size()));
    cycles_.push_back({{SFaceEntry::Kind::kLoop, side}, out.sfaces[side].mark});
  }
}

// Cycles of different components may bound one sface. By Euler's formula a component of v svertices and e edges has
// e - v + 2 cycles (an isolated svertex, too), so the number of cycles tells the number of components: mostly one.
void Arrangement::build_faces(const PlaneTable& planes, SphereMapBuffer& out, const Monitor& monitor) {
  collect_cycles(out);
  const auto count = static_cast<std::uint32_t>(cycles_.size());
  const std::size_t components =
      (count - out.sloops.size() + out.svertices.size() - out.shalfedges.size() / 2) / 2 + out.sloops.size() / 2;
  out.sfaces.clear();
  if (components == 1) {
    face_of_cycle_.resize(count);
    std::iota(face_of_cycle_.begin(), face_of_cycle_.end(), 0U);
  } else {
    face_of_cycle_ = join_cycles(planes, out.view(), cycle_of_half_, cycle_of_vertex_, cycle_of_loop_, count, monitor);
  }
  // From representatives, each the smallest of its sface, to numbers of sfaces and their ranges of entries.
  for (std::uint32_t c = 0; c < count; ++c) {
    if (face_of_cycle_[c] == c) {
      face_of_cycle_[c] = static_cast<std::uint32_t>(out.sfaces.size());
      out.sfaces.push_back({0, 1, cycles_[c].mark});
    } else {
      face_of_cycle_[c] = face_of_cycle_[face_of_cycle_[c]];
      ++out.sfaces[face_of_cycle_[c]].entry_count;
      detail::require_one_mark(cycles_[c].mark == out.sfaces[face_of_cycle_[c]].mark, "an sface has one mark", {});
    }
  }
  std::uint32_t first = 0;
  for (SFace& face : out.sfaces) {
    face.entries = first;
    first += face.entry_count;
    face.entry_count = 0;
  }
  out.entries.resize(count);
  for (std::uint32_t c = 0; c < count; ++c) {
    SFace& face = out.sfaces[face_of_cycle_[c]];
    out.entries[face.entries + face.entry_count++] = cycles_[c].entry;
  }
  for (std::uint32_t e = 0; e < out.shalfedges.size(); ++e) {
    out.shalfedges[e].sface = face_of_cycle_[cycle_of_half_[e]];
  }
  for (std::uint32_t v = 0; v < out.svertices.size(); ++v) {
    if (cycle_of_vertex_[v] != kNone) out.svertices[v].sface = face_of_cycle_[cycle_of_vertex_[v]];
  }
  for (std::uint32_t l = 0; l < out.sloops.size(); ++l) out.sloops[l].sface = face_of_cycle_[cycle_of_loop_[l]];
}

}  // namespace nef
