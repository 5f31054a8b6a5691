// SPDX-License-Identifier: Apache-2.0
//
// A binary glTF 2.0 file in the making: its lists and its bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace nef {

/// Numbers of the specification, as the JSON has them.
enum class GlbComponent : int { kUint8 = 5121, kUint16 = 5123, kUint32 = 5125, kFloat = 5126 };
enum class GlbMode : std::size_t {
  kPoints = 0,
  kLines = 1,
  kLineStrip = 3,
  kTriangles = 4,
  kTriangleStrip = 5,
  kTriangleFan = 6
};
/// What numbers are for: anything, data of vertices, or their indices.
enum class GlbTarget : int { kNone = 0, kVertices = 34962, kIndices = 34963 };

inline constexpr std::uint32_t kGlbMagic = 0x46546c67;  // "glTF"
inline constexpr std::uint32_t kGlbJsonChunk = 0x4e4f534a;
inline constexpr std::uint32_t kGlbBinaryChunk = 0x004e4942;

/// What all such files are made of. Whoever writes one fills `nodes`, `scenes`, `meshes`, `materials` and `animations`;
/// numbers are added here and named by the index of their accessor.
class GlbDocument {
 public:
  using Json = nlohmann::ordered_json;

  Json scenes = Json::array();
  Json nodes = Json::array();
  Json meshes = Json::array();
  Json materials = Json::array();
  Json animations = Json::array();

  /// Floats in groups of `width` (1 to 4) with their bounds; at least one group.
  std::size_t add_floats(std::span<const float> values, std::size_t width, GlbTarget target);
  /// Indices of vertices.
  std::size_t add_indices(std::span<const std::uint32_t> indices);
  /// Colours in linear light, four numbers each, 65535 being full.
  std::size_t add_colors(std::span<const std::uint16_t> channels);
  /// A PNG file as a texture that ends at its borders; named by its index among the textures.
  std::size_t add_texture(std::string_view png);

  /// The file. Lists without entries are left out, as the format knows none.
  [[nodiscard]] std::string bytes() const;

 private:
  template <typename T>
  Json accessor(std::span<const T> values, GlbTarget target, GlbComponent component);
  std::size_t add(Json accessor);

  Json accessors_ = Json::array();
  Json views_ = Json::array();
  Json images_ = Json::array();
  Json samplers_ = Json::array();
  Json textures_ = Json::array();
  std::string binary_;
};

}  // namespace nef
