// SPDX-License-Identifier: Apache-2.0
#include "nef/boolean/result/result_assembly.h"

#include <algorithm>

#include "nef/base/threads/parallel.h"

namespace nef {

// One vertex, behind the others.
void ResultAssembly::append(const Run& run) {
  if (!runs_.empty()) {
    Run& last = runs_.back();
    if (last.from == run.from && last.marks == run.marks && last.vertices.origin == run.vertices.origin &&
        last.vertices.first + last.vertices.count == run.vertices.first) {
      ++last.vertices.count;
      return;
    }
  }
  runs_.push_back(run);
}

void ResultAssembly::copy(std::size_t x, VertexId v, const std::vector<LabelId>* marks) {
  append({{x, v, 1}, &operands_[x].complex(), marks});
}

void ResultAssembly::add(const VertexOf& made) {
  if (made.complex != nullptr) append({{VertexRun::kNew, made.vertex, 1}, made.complex, nullptr});
}

void ResultAssembly::add(PointId point, const SphereMapView& map) {
  add({&new_.so_far(), VertexId{new_.so_far().vertex_count()}});
  new_.append(tables_.points, point, map);
}

bool ResultAssembly::is_first_operand() const {
  return runs_.size() == 1 && runs_[0].vertices.origin == 0 && runs_[0].marks == nullptr &&
         runs_[0].vertices.count == operands_[0].complex().vertex_count();
}

bool ResultAssembly::is_mostly_copies() const {
  std::size_t copies = 0;
  std::size_t others = 0;
  for (const Run& run : runs_) (run.vertices.origin == VertexRun::kNew ? others : copies) += run.vertices.count;
  return copies > others;
}

std::vector<VertexRun> ResultAssembly::origins() const {
  std::vector<VertexRun> result;
  result.reserve(runs_.size());
  for (const Run& run : runs_) result.push_back(run.vertices);
  return result;
}

void ResultAssembly::reserve(ComplexBuilder& result) const {
  std::size_t vertices = 0;
  VertexRecord size;
  for (const Run& run : runs_) {
    vertices += run.vertices.count;
    size.advance(run.from->vertices[run.vertices.first], run.from->vertices[run.vertices.first + run.vertices.count]);
  }
  result.reserve(vertices, size, operands_[0].complex().points.limbs());
}

// By common name; not zero for those that are used.
std::vector<std::uint8_t> ResultAssembly::used_planes(std::size_t planes) const {
  std::vector<std::uint8_t> used(planes, 0);
  for (const Run& run : runs_) {
    const Complex& from = *run.from;
    const VertexRecord& begin = from.vertices[run.vertices.first];
    const VertexRecord& end = from.vertices[run.vertices.first + run.vertices.count];
    const auto note = [&](const auto& use) {
      for (SHalfedgeId e = begin.shalfedges; e < end.shalfedges; e += 2) use(from.shalfedge_plane[e]);
      for (std::uint32_t i = begin.other_planes; i < end.other_planes; ++i) use(from.other_planes[i]);
      for (std::uint32_t l = begin.sloops; l < end.sloops; ++l) use(from.sloops[l].plane);
    };
    if (run.vertices.origin == 1) {
      note([&](PlaneId plane) { used[operands_[1].plane(plane).row()] = 1; });
    } else {
      note([&](PlaneId plane) { used[plane.row()] = 1; });
    }
  }
  return used;
}

ResultAssembly::FinalRows ResultAssembly::final_rows(std::size_t planes) const {
  std::vector<std::uint8_t> used = used_planes(planes);
  const std::vector<std::uint32_t>& common = tables_.rows_of_second;
  FinalRows result;
  if (std::find(used.begin(), used.end(), std::uint8_t{0}) == used.end()) {
    result.of_origin[1] = common;
    return result;
  }
  std::vector<std::uint32_t> row(planes, kNone);
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < planes; ++i) {
    if (used[i] != 0) row[i] = next++;
  }
  result.of_origin[1].reserve(common.size());
  for (const std::uint32_t r : common) result.of_origin[1].push_back(row[r]);
  result.of_origin[0] = row;
  result.of_origin[VertexRun::kNew] = std::move(row);
  result.used = std::move(used);
  return result;
}

void ResultAssembly::write(PlaneTable& planes, ComplexBuilder& result, const Monitor& monitor) const {
  const FinalRows rows = final_rows(planes.size());
  reserve(result);
  std::vector<ComplexBuilder::CopiedRun> copies;
  copies.reserve(runs_.size());
  for (const Run& run : runs_) {
    const VertexRun& r = run.vertices;
    const std::span<const LabelId> marks = run.marks == nullptr ? std::span<const LabelId>() : *run.marks;
    copies.push_back({run.from, r.first, r.count, rows.of_origin[r.origin], marks});
  }
  // Cascades would otherwise carry the planes of everything that ever was.
  const auto drop_planes = [&](const Monitor&) {
    if (!rows.used.empty()) planes.keep(rows.used);
  };
  parallel_calls(monitor, {drop_planes, [&](const Monitor& own) { result.copy(copies, own); }});
}

}  // namespace nef
