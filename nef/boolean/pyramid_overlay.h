// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/boolean/operand.h"
#include "nef/sphere_map/overlay.h"

namespace nef {

/// Overlays local pyramids of two operands, with scratch space that is used again. For one thread.
class PyramidOverlay {
 public:
  /// All must outlive it.
  PyramidOverlay(const std::array<Operand, 2>& operands, const CommonTables& tables, const LabelFunction& f,
                 const Monitor& monitor)
      : operands_(operands), tables_(tables), f_(f), monitor_(monitor) {}

  /// The pyramids at two items, overlaid and simplified; `label` is the mark around the point in an operand that has no
  /// item there. Valid until the next call.
  const SphereMapBuffer& at(const std::array<ItemRef, 2>& items, LabelId label);

 private:
  const std::array<Operand, 2>& operands_;
  const CommonTables& tables_;
  const LabelFunction& f_;
  Monitor monitor_;
  SphereOverlay overlay_;
  std::array<SphereMapBuffer, 2> scratch_;
  SphereMapBuffer out_;
};

/// A point that lies on an item of each operand.
struct Meeting {
  PointId point;
  std::array<ItemRef, 2> items;
};

/// A vertex among others that have no links yet.
struct VertexOf {
  const Complex* complex = nullptr;  ///< null: there is none
  VertexId vertex{0};
};

/// What the overlays at many points have made: the vertices of a result where its operands meet.
class OverlaidMeetings {
 public:
  /// Makes the overlays on the threads of `monitor`, and tells of its progress.
  OverlaidMeetings(const std::array<Operand, 2>& operands, const CommonTables& tables, const LabelFunction& f,
                   std::span<const Meeting> meetings, const Monitor& monitor);

  /// The vertex at meeting k, if the point is one; its planes have common names. Belongs to this object.
  [[nodiscard]] VertexOf operator[](std::size_t k) const;

 private:
  static constexpr std::size_t kTogether = 256;  // meetings whose vertices stand in one complex

  std::vector<Complex> made_;
  std::vector<VertexId> vertex_;  // of each meeting, in its complex; not valid for none
};

}  // namespace nef
