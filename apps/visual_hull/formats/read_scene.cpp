// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/formats/read_scene.h"

#include "apps/visual_hull/formats/colmap.h"
#include "apps/visual_hull/formats/matlab.h"
#include "apps/visual_hull/formats/opencv_storage.h"
#include "apps/visual_hull/formats/scene_blocks.h"
#include "apps/visual_hull/formats/scene_json.h"
#include "apps/visual_hull/formats/scene_text.h"
#include "apps/visual_hull/formats/vsh.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "nef/io/polyhedron_file.h"

namespace nef::visual_hull {
namespace fs = std::filesystem;

namespace {

Scene read_folder(const fs::path& folder, const ReadOptions& options) {
  if (const auto model = colmap_model(folder)) return read_colmap(*model);
  for (const char* name : {"transforms.json", "transforms_train.json"}) {
    std::error_code error;
    if (fs::is_regular_file(folder / name, error)) return read_scene(folder / name, options);
  }
  return read_camera_folder(folder);
}

bool is_colmap_file(const fs::path& file) {
  const std::string name = file.stem().string();
  if (file.extension() != ".txt" && file.extension() != ".bin") return false;
  return (name == "cameras" || name == "images") && colmap_model(file.parent_path()) == file.parent_path();
}

// Files of other formats have their matrices where the format says.
void refuse_matrices(const fs::path& file, const ReadOptions& options) {
  if (options.matrices.empty()) return;
  throw nef::InputError("--matrices: " + file.string() + " is neither an OpenCV FileStorage nor a MATLAB file");
}

}  // namespace

Scene read_scene(const fs::path& file, const ReadOptions& options) {
  std::error_code error;
  if (fs::is_directory(file, error)) {
    refuse_matrices(file, options);
    return read_folder(file, options);
  }
  if (is_colmap_file(file)) {
    refuse_matrices(file, options);
    return read_colmap(file.parent_path());
  }
  const std::string text = nef::read_file(file.string());
  if (nef::is_file_extension(nef::lower_extension(file.string()))) {
    throw nef::InputError(
        file.string() + ": a set, not a scene with cameras and silhouettes; render_silhouettes makes one from a mesh");
  }
  if (is_matlab_file(text)) return read_matlab(file, options.matrices);
  if (is_opencv_storage(text)) return read_opencv_storage(text, file, options.matrices);
  refuse_matrices(file, options);
  if (text[text.find_first_not_of(" \t\r\n")] == '{') return read_json_scene(text, file);
  if (nef::lower_extension(file.string()) == "vsh") return read_vsh(text, file);
  if (has_parameter_blocks(text)) return read_parameter_blocks(text, file);
  if (text.find('\0') != std::string::npos) {  // an image, most likely
    throw nef::InputError(
        file.string() +
        ": not a scene; give a scene file, or a folder of images with --turntable N (docs/visual_hull.md)");
  }
  return read_text_scene(text, file);
}

}  // namespace nef::visual_hull
