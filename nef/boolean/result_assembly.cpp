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
    runs_.push_back({{VertexRun::kNew, static_cast<std::uint32_t>(new_.so_far().vertex_count()), 0}, nullptr});
  }
  ++runs_.back().vertices.count;
  new_.append(tables_.points, point, map);
}

bool ResultAssembly::is_first_operand() const {
  return runs_.size() == 1 && runs_[0].vertices.origin == 0 && runs_[0].marks == nullptr &&
         runs_[0].vertices.count == operands_[0].complex().vertex_count();
}

bool ResultAssembly::is_mostly_copies() const {
  std::size_t copies = 0;
  for (const Run& run : runs_) copies += run.vertices.origin == VertexRun::kNew ? 0 : run.vertices.count;
  return copies > new_.so_far().vertex_count();
}

std::vector<VertexRun> ResultAssembly::origins() const {
  std::vector<VertexRun> result;
  result.reserve(runs_.size());
  for (const Run& run : runs_) result.push_back(run.vertices);
  return result;
}

const Complex& ResultAssembly::origin(const Run& run) const {
  return run.vertices.origin == VertexRun::kNew ? new_.so_far() : operands_[run.vertices.origin].complex();
}

void ResultAssembly::reserve(ComplexBuilder& result) const {
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
  result.reserve(vertices, size);
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
std::array<std::vector<std::uint32_t>, 3> ResultAssembly::final_rows(PlaneTable& planes) const {
  const std::vector<bool> used = used_planes(planes.size());
  const auto count = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
  const std::span<const std::uint32_t> common = operands_[1].common_rows();
  std::array<std::vector<std::uint32_t>, 3> rows;
  if (count == used.size()) {
    rows[1].assign(common.begin(), common.end());
    return rows;
  }
  PlaneTable kept;
  kept.reserve(count);
  std::vector<std::uint32_t> row(used.size(), kNone);
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    if (used[i]) row[i] = kept.append_new(planes, i);
  }
  planes = std::move(kept);
  for (const std::uint32_t r : common) rows[1].push_back(row[r]);
  rows[0] = row;
  rows[VertexRun::kNew] = std::move(row);
  return rows;
}

void ResultAssembly::write(PlaneTable& planes, ComplexBuilder& result) const {
  const auto rows = final_rows(planes);
  reserve(result);
  for (const Run& run : runs_) {
    const VertexRun& r = run.vertices;
    const std::span<const LabelId> marks = run.marks == nullptr ? std::span<const LabelId>() : *run.marks;
    result.copy(origin(run), r.first, r.count, rows[r.origin], marks);
  }
}

}  // namespace nef
