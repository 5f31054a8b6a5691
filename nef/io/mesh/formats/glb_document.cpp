// SPDX-License-Identifier: Apache-2.0
#include "nef/io/mesh/formats/glb_document.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "nef/io/number_text.h"

namespace nef {
namespace {

void append_chunk(std::string& bytes, std::uint32_t type, std::string chunk, char padding) {
  chunk.resize((chunk.size() + 3) / 4 * 4, padding);
  append_little_endian(bytes, static_cast<std::uint32_t>(chunk.size()));
  append_little_endian(bytes, type);
  bytes += chunk;
}

}  // namespace

template <typename T>
GlbDocument::Json GlbDocument::accessor(std::span<const T> values, GlbTarget target, GlbComponent component) {
  Json view{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", values.size_bytes()}};
  if (target != GlbTarget::kNone) view["target"] = static_cast<int>(target);
  views_.push_back(std::move(view));
  for (const T value : values) append_little_endian(binary_, value);
  return {{"bufferView", views_.size() - 1}, {"componentType", static_cast<int>(component)}};
}

std::size_t GlbDocument::add(Json accessor) {
  accessors_.push_back(std::move(accessor));
  return accessors_.size() - 1;
}

std::size_t GlbDocument::add_floats(std::span<const float> values, std::size_t width, GlbTarget target) {
  std::vector<float> low(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(width));
  std::vector<float> high = low;
  for (std::size_t i = 0; i < values.size(); ++i) {
    low[i % width] = std::min(low[i % width], values[i]);
    high[i % width] = std::max(high[i % width], values[i]);
  }
  Json entry = accessor(values, target, GlbComponent::kFloat);
  entry["count"] = values.size() / width;
  entry["type"] = width == 1 ? "SCALAR" : "VEC" + std::to_string(width);
  entry["min"] = low;
  entry["max"] = high;
  return add(std::move(entry));
}

std::size_t GlbDocument::add_indices(std::span<const std::uint32_t> indices) {
  Json entry = accessor(indices, GlbTarget::kIndices, GlbComponent::kUint32);
  entry["count"] = indices.size();
  entry["type"] = "SCALAR";
  return add(std::move(entry));
}

std::size_t GlbDocument::add_colors(std::span<const std::uint16_t> channels) {
  Json entry = accessor(channels, GlbTarget::kVertices, GlbComponent::kUint16);
  entry["normalized"] = true;
  entry["count"] = channels.size() / 4;
  entry["type"] = "VEC4";
  return add(std::move(entry));
}

std::size_t GlbDocument::add_texture(std::string_view png) {
  constexpr int kLinear = 9729;
  constexpr int kClampToEdge = 33071;
  views_.push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", png.size()}});
  binary_ += png;
  binary_.resize((binary_.size() + 3) / 4 * 4, '\0');  // numbers that follow begin at multiples of their size
  images_.push_back({{"bufferView", views_.size() - 1}, {"mimeType", "image/png"}});
  samplers_.push_back(
      {{"magFilter", kLinear}, {"minFilter", kLinear}, {"wrapS", kClampToEdge}, {"wrapT", kClampToEdge}});
  textures_.push_back({{"source", images_.size() - 1}, {"sampler", samplers_.size() - 1}});
  return textures_.size() - 1;
}

std::string GlbDocument::bytes() const {
  Json document{{"asset", {{"version", "2.0"}, {"generator", "nef"}}}, {"scene", 0}, {"scenes", scenes}};
  const auto add_list = [&document](const char* key, const Json& list) {
    if (!list.empty()) document[key] = list;
  };
  add_list("nodes", nodes);
  add_list("meshes", meshes);
  add_list("accessors", accessors_);
  add_list("bufferViews", views_);
  add_list("images", images_);
  add_list("samplers", samplers_);
  add_list("textures", textures_);
  add_list("materials", materials);
  add_list("animations", animations);
  if (!binary_.empty()) document["buffers"] = {{{"byteLength", binary_.size()}}};
  std::string chunks;
  // Names may hold bytes that are no UTF-8.
  append_chunk(chunks, kGlbJsonChunk, document.dump(-1, ' ', false, Json::error_handler_t::replace), ' ');
  if (!binary_.empty()) append_chunk(chunks, kGlbBinaryChunk, binary_, '\0');
  std::string all;
  append_little_endian(all, kGlbMagic);
  append_little_endian(all, std::uint32_t{2});
  append_little_endian(all, static_cast<std::uint32_t>(12 + chunks.size()));
  return all + chunks;
}

}  // namespace nef
