// SPDX-License-Identifier: Apache-2.0
#include "nef/boolean/result_assembly.h"

#include <algorithm>

namespace nef {

void ResultAssembly::copy(std::size_t x, std::uint32_t v, const std::vector<LabelId>* marks) {
  if (!runs_.empty()) {
    Run& last = runs_.back();
    if (last.vertices.origin == x && last.marks == marks && last.vertices.first + last.vertices.count == v) {
      ++last.vertices.count;
      return;
    }
  }
  runs_.push_back({{x, v, 1}, marks});
}

void ResultAssembly::add(PointId point, const SphereMapView& map) {
  if (runs_.empty() || runs_.back().vertices.origin != VertexRun::kNew) {
    runs_.push_back({{VertexRun::kNew, static_cast<std::uint32_t>(new_points_.size()), 0}, nullptr});
  }
  ++runs_.back().vertices.count;
  new_points_.push_back(point);
  new_.push_vertex(map);
}

bool ResultAssembly::is_first_operand() const {
  return runs_.size() == 1 && runs_[0].vertices.origin == 0 && runs_[0].marks == nullptr &&
         runs_[0].vertices.count == operands_[0].complex().vertex_count();
}

std::vector<VertexRun> ResultAssembly::origins() const {
  std::vector<VertexRun> result;
  result.reserve(runs_.size());
  for (const Run& run : runs_) result.push_back(run.vertices);
  return result;
}

const Complex& ResultAssembly::origin(const Run& run) const {
  return run.vertices.origin == VertexRun::kNew ? new_ : operands_[run.vertices.origin].complex();
}

void ResultAssembly::reserve(Complex& result) const {
  std::size_t vertices = 0;
  VertexRecord size;
  for (const Run& run : runs_) {
    const VertexRecord& first = origin(run).vertices[run.vertices.first];
    const VertexRecord& last = origin(run).vertices[run.vertices.first + run.vertices.count];
    vertices += run.vertices.count;
    size.svertices += last.svertices - first.svertices;
    size.shalfedges += last.shalfedges - first.shalfedges;
    size.sloops += last.sloops - first.sloops;
    size.sfaces += last.sfaces - first.sfaces;
    size.entries += last.entries - first.entries;
  }
  result.points.reserve(vertices);
  result.vertices.reserve(vertices + 1);
  result.svertices.reserve(size.svertices);
  result.shalfedges.reserve(size.shalfedges);
  result.sloops.reserve(size.sloops);
  result.sfaces.reserve(size.sfaces);
  result.entries.reserve(size.entries);
}

// By common name.
std::vector<bool> ResultAssembly::used_planes(std::size_t planes) const {
  std::vector<bool> used(planes, false);
  for (const Run& run : runs_) {
    const Complex& from = origin(run);
    const VertexRecord& begin = from.vertices[run.vertices.first];
    const VertexRecord& end = from.vertices[run.vertices.first + run.vertices.count];
    const auto note = [&](const auto& row) {
      for (std::uint32_t s = begin.svertices; s < end.svertices; ++s) {
        used[row(from.svertices[s].p)] = used[row(from.svertices[s].q)] = true;
      }
      for (std::uint32_t e = begin.shalfedges; e < end.shalfedges; ++e) used[row(from.shalfedges[e].plane)] = true;
      for (std::uint32_t l = begin.sloops; l < end.sloops; ++l) used[row(from.sloops[l].plane)] = true;
    };
    if (run.vertices.origin == 1) {
      note([&](PlaneId plane) { return operands_[1].plane(plane).row(); });
    } else {
      note([](PlaneId plane) { return plane.row(); });
    }
  }
  return used;
}

// Cascades would otherwise carry the planes of everything that ever was.
std::array<std::vector<std::uint32_t>, 3> ResultAssembly::final_rows(PlaneTable& planes, Complex& result) const {
  const std::vector<bool> used = used_planes(planes.size());
  const auto count = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
  const std::span<const std::uint32_t> common = operands_[1].common_rows();
  std::array<std::vector<std::uint32_t>, 3> rows;
  if (count == used.size()) {
    result.planes = std::move(planes);
    rows[1].assign(common.begin(), common.end());
    return rows;
  }
  result.planes.reserve(count);
  std::vector<std::uint32_t> row(used.size(), kNone);
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    if (used[i]) row[i] = result.planes.append_new(planes, i);
  }
  for (const std::uint32_t r : common) rows[1].push_back(row[r]);
  rows[0] = row;
  rows[VertexRun::kNew] = std::move(row);
  return rows;
}

Complex ResultAssembly::complex(PlaneTable& planes) const {
  Complex result;
  const auto rows = final_rows(planes, result);
  reserve(result);
  constexpr std::uint32_t kBlock = 256;  // vertices whose copies stay in a fast cache while they are renamed
  for (const Run& run : runs_) {
    const VertexRun& r = run.vertices;
    for (std::uint32_t done = 0; done < r.count; done += kBlock) {
      append(run, r.first + done, std::min(kBlock, r.count - done), rows[r.origin], result);
    }
    for (std::uint32_t i = r.first; i < r.first + r.count; ++i) {
      if (r.origin == VertexRun::kNew) {
        result.points.push_from(tables_.points, new_points_[i]);
      } else {
        result.points.push_from(operands_[r.origin].complex().points, PointId{i});
      }
    }
  }
  return result;
}

// The sphere maps of a range of vertices; indices inside them are local, so only where they begin changes, and the
// names of planes.
void ResultAssembly::append(const Run& run, std::uint32_t first, std::uint32_t count,
                            std::span<const std::uint32_t> rows, Complex& result) const {
  const Complex& from = origin(run);
  const VertexRecord begin = from.vertices[first];
  const VertexRecord end = from.vertices[first + count];
  const VertexRecord base = result.vertices.back();
  const auto mark = [&run](LabelId label) {
    return run.marks == nullptr || label == kOutside ? label : (*run.marks)[label];
  };
  result.vertices.back().mark = mark(begin.mark);
  for (std::uint32_t v = first + 1; v <= first + count; ++v) {
    VertexRecord record = from.vertices[v];
    record.svertices += base.svertices - begin.svertices;
    record.shalfedges += base.shalfedges - begin.shalfedges;
    record.sloops += base.sloops - begin.sloops;
    record.sfaces += base.sfaces - begin.sfaces;
    record.entries += base.entries - begin.entries;
    record.mark = v == first + count ? LabelId{0} : mark(record.mark);
    result.vertices.push_back(record);
  }
  const auto copy = [](const auto& items, std::uint32_t a, std::uint32_t b, auto& out) {
    out.insert(out.end(), items.begin() + a, items.begin() + b);
  };
  copy(from.svertices, begin.svertices, end.svertices, result.svertices);
  copy(from.shalfedges, begin.shalfedges, end.shalfedges, result.shalfedges);
  copy(from.sloops, begin.sloops, end.sloops, result.sloops);
  copy(from.sfaces, begin.sfaces, end.sfaces, result.sfaces);
  copy(from.entries, begin.entries, end.entries, result.entries);
  const auto fresh = [](auto& items, std::uint32_t at) { return std::span(items).subspan(at); };
  if (!rows.empty()) {
    const auto rename = [&rows](PlaneId& plane) { plane = PlaneId{rows[plane.row()] << 1U | (plane.value & 1U)}; };
    for (SVertex& v : fresh(result.svertices, base.svertices)) {
      rename(v.p);
      rename(v.q);
    }
    for (SHalfedge& e : fresh(result.shalfedges, base.shalfedges)) rename(e.plane);
    for (SLoop& l : fresh(result.sloops, base.sloops)) rename(l.plane);
  }
  if (run.marks != nullptr) {
    for (SVertex& v : fresh(result.svertices, base.svertices)) v.mark = mark(v.mark);
    for (SHalfedge& e : fresh(result.shalfedges, base.shalfedges)) e.mark = mark(e.mark);
    for (SLoop& l : fresh(result.sloops, base.sloops)) l.mark = mark(l.mark);
    for (SFace& f : fresh(result.sfaces, base.sfaces)) f.mark = mark(f.mark);
  }
}

}  // namespace nef
