// SPDX-License-Identifier: Apache-2.0
#include "nef/construct/plain_ring.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nef/number/approximation.h"

namespace nef {

bool PlainRing::read(std::uint32_t point, std::span<const FaceCorner> corners) {
  if (corners.size() < 3 || corners.size() > kMost || !order(corners)) return false;
  const std::size_t n = size_;
  for (std::size_t i = 0; i < n; ++i) planes_[i] = faces_.plane[ring_[i].face];
  bits_ = 1;  // ends the bits of any number of edges
  for (std::size_t i = 0; i < n; ++i) {
    PlaneId first = planes_[i == 0 ? n - 1 : i - 1];
    PlaneId second = planes_[i];
    if (first.row() == second.row()) return false;
    const bool swapped = second.row() < first.row();
    const bool turned = second.flipped();
    if (swapped) std::swap(first, second);
    const std::optional<int> sign = direction(point, ring_[i].next, first, second);
    if (!sign) return false;
    const PlaneId unflipped = second.unflipped();
    edges_[i] = {first.unflipped(), *sign > 0 ? unflipped : unflipped.opposite()};
    bits_ = bits_ << 3U | (swapped ? 4U : 0U) | (turned ? 2U : 0U) | (*sign > 0 ? 1U : 0U);
  }
  return true;
}

// Svertex i leads along the edge of corner i, shalfedge 2 i is the half of that corner's arc that leaves it.
void PlainRing::write(const SolidMarks& marks, SphereMapBuffer& map) const {
  const auto n = static_cast<std::uint32_t>(size_);
  const auto mark_of = [&](std::uint32_t i) { return planes_[i].flipped() ? marks.flipped_boundary : marks.boundary; };
  map.clear();
  map.svertices.reserve(n);
  map.shalfedges.reserve(2 * n);
  map.sfaces.reserve(2);
  map.entries.reserve(2);
  map.mark = mark_of(0);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t ahead = i + 1 == n ? 0 : i + 1;
    const std::uint32_t behind = i == 0 ? n - 1 : i - 1;
    const LabelId mark = mark_of(i);
    if (mark != map.mark) map.mark = marks.boundary;
    SVertex& v = map.svertices.emplace_back();
    v.p = edges_[i].p;
    v.q = edges_[i].q;
    v.out = 2 * i;
    v.mark = mark == mark_of(behind) ? mark : marks.boundary;
    map.shalfedges.push_back({planes_[i], i, 2 * ahead, 2 * behind, 0, mark});
    map.shalfedges.push_back({planes_[i].opposite(), ahead, 2 * behind + 1, 2 * ahead + 1, 1, mark});
  }
  for (const std::uint32_t side : {0U, 1U}) {
    map.sfaces.push_back({side, 1, side == 0 ? marks.outside : marks.inside});
    map.entries.push_back({SFaceEntry::Kind::kCycle, side});
  }
}

// From each corner on to the one that leaves along the edge where it arrives. False if this is not one way through all.
bool PlainRing::order(std::span<const FaceCorner> corners) {
  size_ = corners.size();
  std::copy(corners.begin(), corners.end(), ring_.begin());
  for (std::size_t i = 1; i < size_; ++i) {
    std::size_t j = i;
    while (j < size_ && ring_[j].next != ring_[i - 1].previous) ++j;
    if (j == size_) return false;
    std::swap(ring_[i], ring_[j]);
  }
  if (ring_[size_ - 1].previous != ring_[0].next) return false;
  for (std::size_t i = 0; i < size_; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (ring_[i].next == ring_[j].next) return false;
    }
  }
  return true;
}

void KnownRings::learn(std::uint64_t bits, VertexId vertex) {
  if (2 * (count_ + 1) > known_.size()) {
    constexpr std::size_t kFirst = 32;
    const std::vector<Known> before = std::exchange(known_, std::vector<Known>(std::max(kFirst, 2 * known_.size())));
    for (const Known& known : before) {
      if (known.bits != 0) known_[place_of(known.bits)] = known;
    }
  }
  known_[place_of(bits)] = {bits, vertex};
  ++count_;
}

// Where these bits are, or would be.
std::size_t KnownRings::place_of(std::uint64_t bits) const {
  const std::size_t last = known_.size() - 1;
  std::size_t place = (bits * 0x9e3779b97f4a7c15ULL) >> 32U & last;
  while (known_[place].bits != 0 && known_[place].bits != bits) place = (place + 1) & last;
  return place;
}

// The sign of (first normal x second normal).(to - from) for the unflipped planes; nothing if doubles can not tell.
//
// Components of normals are at most 1 and within 2^-52, so those of the product are within 2^-49. Coordinates are
// within 2^-51 of themselves, so differences are within 2^-50 of the sum of their sizes. What the sum of products is
// off by is doubled, which covers that it is itself rounded. An error above kTiny is far above what could have
// vanished, 2^-1074 each time; one below kHuge says that the differences are below 2^49 times that, so the sum of their
// products does not overflow.
std::optional<int> PlainRing::direction(std::uint32_t from, std::uint32_t to, PlaneId first, PlaneId second) const {
  const std::array<double, 4>& n = faces_.planes.approximate(first);
  const std::array<double, 4>& m = faces_.planes.approximate(second);
  const std::array<double, 3>& a = faces_.points.approximate(PointId{from});
  const std::array<double, 3>& b = faces_.points.approximate(PointId{to});
  double dot = 0;
  double error = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    const double product = n[j] * m[k] - n[k] * m[j];
    const double difference = b[i] - a[i];
    const double off = (std::fabs(a[i]) + std::fabs(b[i])) * 0x1p-50;
    dot += product * difference;
    error += (std::fabs(difference) + off) * 0x1p-49 + std::fabs(product) * (off + std::fabs(difference) * 0x1p-51);
  }
  constexpr double kTiny = 1e-280;
  constexpr double kHuge = 1e280;
  if (!(error > kTiny && error < kHuge)) return std::nullopt;
  return Approximation{dot, 2 * error}.sign();
}

}  // namespace nef
