// SPDX-License-Identifier: Apache-2.0
//
// What a sphere map shows around a vertex (an edge) is what touches it. Cells of larger dimension have larger numbers,
// and smaller cells are gone through in order, so all lists come out in order, and none is sorted but the few cells
// around one vertex or edge.
#include "apps/planner/free_space/incidences.h"

#include <algorithm>

namespace nef::planner {
namespace {

// The larger cells around one cell after the other; some may be named several times.
class Surroundings {
 public:
  Surroundings(const Complex& complex, const CellNumbering& cells) : c_(complex), cells_(cells) {}

  void vertex(VertexId v, std::vector<CellId>& out) const {
    const SphereMapView map = c_.sphere_map(v);
    const VertexRecord& record = c_.vertices[v];
    for (std::uint32_t s = 0; s < map.svertices.size(); ++s) out.push_back(cells_.edge(record.svertices + s));
    for (std::uint32_t e = 0; e < map.shalfedges.size(); e += 2) out.push_back(facet(record.shalfedges + e));
    for (std::uint32_t l = 0; l < map.sloops.size(); ++l) {
      out.push_back(cells_.facet(facet_of(c_.sloop_facet[record.sloops + l])));
    }
    for (std::uint32_t f = 0; f < map.sfaces.size(); ++f) out.push_back(volume(record.sfaces + f));
  }

  void edge(HalfedgeId halfedge, std::vector<CellId>& out) const {
    const VertexId v = c_.source(halfedge);
    const SphereMapView map = c_.sphere_map(v);
    const VertexRecord& record = c_.vertices[v];
    const SVertex& svertex = map.svertices[halfedge - record.svertices];
    if (svertex.out == kNone) {
      out.push_back(volume(record.sfaces + svertex.sface));
      return;
    }
    std::uint32_t e = svertex.out;
    do {
      out.push_back(facet(record.shalfedges + e));
      out.push_back(volume(record.sfaces + map.shalfedges[e].sface));
      e = map.next_around(e);
    } while (e != svertex.out);
  }

  void facet(FacetId f, std::vector<CellId>& out) const {
    out.push_back(cells_.volume(c_.facets[f].volume_above));
    out.push_back(cells_.volume(c_.facets[f].volume_below));
  }

 private:
  [[nodiscard]] CellId facet(SHalfedgeId shalfedge) const {
    return cells_.facet(facet_of(c_.shalfedge_facet[shalfedge]));
  }
  [[nodiscard]] CellId volume(SFaceId sface) const { return cells_.volume(c_.sface_volume(sface)); }

  const Complex& c_;
  const CellNumbering& cells_;
};

}  // namespace

Incidences::Incidences(const Complex& complex, const CellNumbering& cells, const std::vector<bool>& free) {
  const Surroundings around(complex, cells);
  const CellId volumes = cells.volume(VolumeId{0});
  std::vector<CellId> larger;  // of all cells but volumes, list after list
  std::vector<std::uint32_t> larger_begin(volumes + 1, 0);
  std::vector<std::uint32_t> smaller(cells.size(), 0);  // how many
  for (CellId cell = 0; cell < volumes; ++cell) {
    const std::size_t first = larger.size();
    if (free[cell]) {
      const int dimension = cells.dimension(cell);
      if (dimension == 0) around.vertex(VertexId{cells.index(cell)}, larger);
      if (dimension == 1) around.edge(cells.halfedge(cell), larger);
      if (dimension == 2) around.facet(FacetId{cells.index(cell)}, larger);
      const auto begin = larger.begin() + static_cast<std::ptrdiff_t>(first);
      std::sort(begin, larger.end());
      larger.erase(std::unique(begin, larger.end()), larger.end());
      larger.erase(std::remove_if(begin, larger.end(), [&](CellId other) { return !free[other]; }), larger.end());
    }
    for (std::size_t i = first; i < larger.size(); ++i) ++smaller[larger[i]];
    larger_begin[cell + 1] = static_cast<std::uint32_t>(larger.size());
  }
  begin_.resize(cells.size() + 1);
  larger_.resize(cells.size());
  begin_[0] = 0;
  for (CellId cell = 0; cell < cells.size(); ++cell) {
    larger_[cell] = begin_[cell] + smaller[cell];
    begin_[cell + 1] = larger_[cell] + (cell < volumes ? larger_begin[cell + 1] - larger_begin[cell] : 0);
  }
  lists_.resize(begin_.back());
  std::vector<std::uint32_t>& next = smaller;  // where the next smaller cell goes
  std::copy(begin_.begin(), begin_.end() - 1, next.begin());
  for (CellId cell = 0; cell < volumes; ++cell) {
    for (std::uint32_t i = larger_begin[cell]; i < larger_begin[cell + 1]; ++i) {
      lists_[larger_[cell] + i - larger_begin[cell]] = larger[i];
      lists_[next[larger[i]]++] = cell;
    }
  }
}

}  // namespace nef::planner
