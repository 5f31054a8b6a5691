// SPDX-License-Identifier: Apache-2.0
#include "nef/io/mesh/face_groups.h"

#include <algorithm>
#include <cmath>

namespace nef {

std::array<std::uint8_t, 3> group_color(std::size_t group) {
  // Hues a golden section apart never come close again soon.
  constexpr double kGolden = 0.6180339887498949;
  const double hue = std::fmod(0.58 + kGolden * static_cast<double>(group), 1.0) * 6;
  const double value = group / 6 % 2 == 0 ? 0.86 : 0.62;
  constexpr double kSaturation = 0.55;
  std::array<std::uint8_t, 3> color{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double k = std::fmod(5 - 2 * static_cast<double>(i) + hue, 6.0);
    const double x = value * (1 - kSaturation * std::clamp(std::min(k, 4 - k), 0.0, 1.0));
    color[i] = static_cast<std::uint8_t>(std::lround(255 * x));
  }
  return color;
}

double linear_light(std::uint8_t channel) {
  const double x = channel / 255.0;
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

std::string group_word(const std::string& name) {
  std::string word = name.empty() ? "_" : name;
  for (char& c : word) {
    if (static_cast<unsigned char>(c) <= ' ' || c == '#' || c == '"' || c == '\\' || c == 127) c = '_';
  }
  return word;
}

std::vector<std::vector<std::uint32_t>> faces_by_group(const FaceGroups& groups) {
  std::vector<std::vector<std::uint32_t>> faces(groups.names.size());
  for (std::uint32_t f = 0; f < groups.of_face.size(); ++f) faces[groups.of_face[f]].push_back(f);
  return faces;
}

}  // namespace nef
