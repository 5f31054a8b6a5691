// SPDX-License-Identifier: Apache-2.0
//
// Along each side between two charts colours are compared at some places, a texel apart or so. The system has three
// right sides, one for each channel.
#include "apps/visual_hull/texture/levelling.h"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>

namespace nef::visual_hull {
namespace {

constexpr double kSmooth = 0.05;  // weight of differences between neighbours in a chart, for each triangle
constexpr double kAnchor = 0.05;  // weight of the offsets themselves, for each texel

class Levelling {
 public:
  Levelling(const Surface& surface, const Atlas& atlas, Texels& texels)
      : surface_(surface), atlas_(atlas), texels_(texels) {}

  void run() {
    number_unknowns();
    if (count_ == 0) return;
    right_ = Eigen::MatrixXd::Zero(count_, 3);
    for (const Surface::Side& side : surface_.sides()) {
      const auto& [a, b] = side.triangles;
      if (in_view(a) && in_view(b) && atlas_.chart_of[a] != atlas_.chart_of[b]) add_seam(side);
    }
    if (!any_seam_) return;
    for (std::uint32_t t = 0; t < surface_.size(); ++t) {
      if (!in_view(t)) continue;
      add_smooth(t);
      add_anchor(t);
    }
    Eigen::SparseMatrix<double> matrix(count_, count_);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    if (solver.info() != Eigen::Success) return;  // colours stay as they are
    const Eigen::MatrixXd offsets = solver.solve(right_);
    if (offsets.allFinite()) apply(offsets);
  }

 private:
  [[nodiscard]] bool in_view(std::uint32_t t) const { return atlas_.charts[atlas_.chart_of[t]].view != kNoView; }

  // One for each vertex of each chart: corners at a vertex in one chart share it.
  void number_unknowns() {
    struct Corner {
      std::uint32_t vertex, chart, triangle, corner;
      [[nodiscard]] bool same(const Corner& other) const { return vertex == other.vertex && chart == other.chart; }
    };
    std::vector<Corner> corners;
    for (std::uint32_t t = 0; t < surface_.size(); ++t) {
      if (!in_view(t)) continue;
      for (std::uint32_t i = 0; i < 3; ++i) corners.push_back({surface_.triangle(t)[i], atlas_.chart_of[t], t, i});
    }
    std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
      return std::array{a.chart, a.vertex, a.triangle, a.corner} < std::array{b.chart, b.vertex, b.triangle, b.corner};
    });
    unknown_.resize(surface_.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (i == 0 || !corners[i].same(corners[i - 1])) ++count_;
      unknown_[corners[i].triangle][corners[i].corner] = count_ - 1;
    }
  }

  [[nodiscard]] std::size_t corner_of(std::uint32_t t, std::uint32_t vertex) const {
    const auto& corners = surface_.triangle(t);
    return corners[0] == vertex ? 0 : corners[1] == vertex ? 1 : 2;
  }

  // A row of the least squares problem.
  template <std::size_t kSize>
  void add_row(const std::array<Eigen::Index, kSize>& at, const std::array<double, kSize>& factor,
               const std::array<double, 3>& value, double weight) {
    for (std::size_t i = 0; i < kSize; ++i) {
      for (std::size_t j = 0; j < kSize; ++j) entries_.emplace_back(at[i], at[j], weight * factor[i] * factor[j]);
      for (Eigen::Index c = 0; c < 3; ++c) right_(at[i], c) += weight * factor[i] * value[static_cast<std::size_t>(c)];
    }
  }

  void add_smooth(std::uint32_t t) {
    for (std::size_t i = 0; i < 3; ++i) add_row<2>({unknown_[t][i], unknown_[t][(i + 1) % 3]}, {1, -1}, {}, kSmooth);
  }

  // Colours are right on the average already (blend_views).
  void add_anchor(std::uint32_t t) {
    constexpr double kLeast = 0.02;  // texels: triangles without area have an anchor, too
    const double texels = std::abs(doubled_area(atlas_.places[t])) / 6 + kLeast;
    for (std::size_t i = 0; i < 3; ++i) add_row<1>({unknown_[t][i]}, {1}, {}, kAnchor * texels);
  }

  void add_seam(const Surface::Side& side) {
    std::array<std::array<Place2, 2>, 2> ends{};
    std::array<std::array<Eigen::Index, 2>, 2> at{};
    for (std::size_t k = 0; k < 2; ++k) {
      const std::uint32_t t = side.triangles[k];
      for (std::size_t e = 0; e < 2; ++e) {
        const std::size_t corner = corner_of(t, e == 0 ? side.from : side.to);
        ends[k][e] = atlas_.places[t][corner];
        at[k][e] = unknown_[t][corner];
      }
    }
    const double length = std::max(std::hypot(ends[0][1][0] - ends[0][0][0], ends[0][1][1] - ends[0][0][1]),
                                   std::hypot(ends[1][1][0] - ends[1][0][0], ends[1][1][1] - ends[1][0][1]));
    const int count = static_cast<int>(std::clamp(std::ceil(length), 1.0, 64.0));
    const double weight = std::max(length, 0.1) / count;
    for (int i = 0; i < count; ++i) {
      const double s = (i + 0.5) / count;
      std::array<std::array<float, 3>, 2> colors{};
      bool known = true;
      for (std::size_t k = 0; k < 2; ++k) {
        const std::size_t texel = texels_.texel_at(
            {ends[k][0][0] + s * (ends[k][1][0] - ends[k][0][0]), ends[k][0][1] + s * (ends[k][1][1] - ends[k][0][1])});
        known = known && texels_.triangle(texel) != Texels::kFree && texels_.grade[texel] != TexelGrade::kNone;
        colors[k] = texels_.color[texel];
      }
      if (!known) continue;
      std::array<double, 3> difference{};
      for (std::size_t c = 0; c < 3; ++c) difference[c] = static_cast<double>(colors[1][c] - colors[0][c]);
      add_row<4>({at[0][0], at[0][1], at[1][0], at[1][1]}, {1 - s, s, s - 1, -s}, difference, weight);
      any_seam_ = true;
    }
  }

  void apply(const Eigen::MatrixXd& offsets) {
    for (std::size_t texel = 0; texel < texels_.size(); ++texel) {
      const std::uint32_t t = texels_.triangle(texel);
      if (t == Texels::kFree || texels_.grade[texel] == TexelGrade::kNone || !in_view(t)) continue;
      const Weights w = texels_.weights(texel);
      for (std::size_t c = 0; c < 3; ++c) {
        double offset = 0;
        for (std::size_t i = 0; i < 3; ++i) offset += w[i] * offsets(unknown_[t][i], static_cast<Eigen::Index>(c));
        texels_.color[texel][c] =
            static_cast<float>(std::clamp(static_cast<double>(texels_.color[texel][c]) + offset, 0.0, 255.0));
      }
    }
  }

  const Surface& surface_;
  const Atlas& atlas_;
  Texels& texels_;
  Eigen::Index count_ = 0;
  std::vector<std::array<Eigen::Index, 3>> unknown_;  // of each corner of each triangle in a view
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::MatrixXd right_;
  bool any_seam_ = false;
};

}  // namespace

void level_seams(const Surface& surface, const Atlas& atlas, Texels& texels) {
  Levelling(surface, atlas, texels).run();
}

}  // namespace nef::visual_hull
