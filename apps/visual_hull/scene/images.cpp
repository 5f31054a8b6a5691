// SPDX-License-Identifier: Apache-2.0
//
// Looking up an image is a product of folders, subfolders and extensions, tried in a fixed order. Images of a folder
// are paired with views by name without extension if every image and every view has exactly one partner, and otherwise
// by natural order, with a note.
#include "apps/visual_hull/scene/images.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <system_error>

#include "apps/visual_hull/scene/image_file.h"
#include "apps/visual_hull/scene/natural_order.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::visual_hull {
namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 10> kExtensions{"png",  "pgm", "pbm",  "bmp", "tif",
                                                  "tiff", "jpg", "jpeg", "ppm", "webp"};

bool has_image_extension(const fs::path& path) {
  const std::string extension = nef::lower_extension(path.string());
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

// The file itself, or with a usual extension more, or with another one: the mask of photo.jpg may be photo.png.
std::optional<fs::path> with_some_extension(const fs::path& base) {
  if (is_file(base)) return base;
  for (const char* extension : kExtensions) {
    fs::path longer = base.string() + "." + extension;
    if (is_file(longer)) return longer;
  }
  if (!has_image_extension(base)) return std::nullopt;
  for (const char* extension : kExtensions) {
    fs::path other = fs::path(base).replace_extension(extension);
    if (is_file(other)) return other;
  }
  return std::nullopt;
}

std::string filename_of(const fs::path& file) { return file.filename().string(); }

// The images that have the names of the views' images, extensions aside; nothing unless all views and all images have
// such partners, each one.
std::optional<std::vector<fs::path>> pair_by_names(const std::vector<View>& views, const std::vector<fs::path>& files) {
  std::map<std::string, fs::path> by_stem;
  for (const fs::path& file : files) by_stem.emplace(file.stem().string(), file);
  std::vector<fs::path> paired;
  for (const View& view : views) {
    const auto found = by_stem.find(view.image.stem().string());
    if (found == by_stem.end()) return std::nullopt;
    paired.push_back(std::move(found->second));
    by_stem.erase(found);
  }
  return by_stem.empty() ? std::optional(std::move(paired)) : std::nullopt;
}

// The images of a folder for the views, as many as these are.
std::vector<fs::path> pair_images(const std::vector<View>& views, const fs::path& folder, std::vector<fs::path> files,
                                  nef::Messages* notes) {
  if (auto paired = pair_by_names(views, files)) return *std::move(paired);
  const auto text_order = [](const fs::path& a, const fs::path& b) { return filename_of(a) < filename_of(b); };
  if (notes != nullptr && !std::is_sorted(files.begin(), files.end(), text_order)) {
    const auto turned = std::adjacent_find(files.begin(), files.end(),
                                           [&](const fs::path& a, const fs::path& b) { return text_order(b, a); });
    notes->push_back(fmt::format(
        "the images of {} are paired with the views in the order of the numbers in their names ({} before {}); if that "
        "is wrong, name the image of each view in the scene",
        folder.string(), filename_of(*turned), filename_of(*std::next(turned))));
  }
  return files;
}

}  // namespace

fs::path scene_folder(const fs::path& scene) {
  std::error_code error;
  return fs::is_directory(scene, error) ? scene : scene.parent_path();
}

std::optional<fs::path> look_up_image(const std::vector<fs::path>& folders, const std::string& name) {
  const fs::path given = fs::path(name).lexically_normal();
  const bool photograph = !given.empty() && *given.begin() == "images";
  for (const fs::path& folder : folders) {
    if (photograph) {
      for (const char* sub : {"masks", "silhouettes"}) {
        if (auto found = with_some_extension(folder / sub / given.lexically_relative("images"))) return found;
      }
    }
    for (const char* sub : {"", "masks", "silhouettes", "images", "visualize"}) {
      if (auto found = with_some_extension(folder / sub / given)) return found;
    }
  }
  return std::nullopt;
}

fs::path find_image(const fs::path& folder, const std::string& name) {
  if (auto found = look_up_image({folder}, name)) return *found;
  throw nef::InputError("view " + name + ": there is no image " + (folder / name).string() +
                        ", with or without a usual extension, nor one in masks/, silhouettes/ or images/ there");
}

std::vector<fs::path> list_images(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) throw nef::InputError(folder.string() + " is not a directory of images");
  std::vector<fs::path> images;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (std::error_code unknown; entry.is_regular_file(unknown) && has_image_extension(entry.path()))
      images.push_back(entry.path());
  }
  if (error) throw nef::InputError(folder.string() + " cannot be read (" + error.message() + ")");
  std::sort(images.begin(), images.end(),
            [](const fs::path& a, const fs::path& b) { return naturally_before(filename_of(a), filename_of(b)); });
  return images;
}

std::vector<fs::path> images_of(const Scene& scene, const fs::path& folder, const std::optional<fs::path>& images,
                                nef::Messages* notes) {
  const std::size_t count = scene.views.size();
  if (images) {
    std::vector<fs::path> files = list_images(*images);
    if (files.size() != count) {
      throw nef::InputError(
          fmt::format("{} contains {} images, but the scene has {} views", images->string(), files.size(), count));
    }
    return pair_images(scene.views, *images, std::move(files), notes);
  }
  const bool any_named =
      std::any_of(scene.views.begin(), scene.views.end(), [](const View& v) { return v.polygons || !v.image.empty(); });
  std::string other_number;  // a folder with images, but not one for each view
  if (!any_named) {
    for (const char* sub : {"masks", "silhouettes", "images", ""}) {
      std::error_code error;
      const fs::path place = *sub == '\0' ? folder : folder / sub;
      if (!fs::is_directory(place, error)) continue;
      std::vector<fs::path> files = list_images(place);
      if (files.size() == count) return pair_images(scene.views, place, std::move(files), notes);
      if (!files.empty() && other_number.empty()) {
        other_number =
            fmt::format("{} contains {} images, but the scene has {} views; --images DIR names another folder",
                        place.empty() ? "." : place.string(), files.size(), count);
      }
    }
  }
  std::vector<fs::path> folders{folder};
  folders.insert(folders.end(), scene.image_folders.begin(), scene.image_folders.end());
  std::vector<fs::path> files(count);
  for (std::size_t i = 0; i < count; ++i) {
    const View& view = scene.views[i];
    if (view.polygons) continue;
    if (view.image.empty()) {
      if (!other_number.empty()) throw nef::InputError(other_number);
      throw nef::InputError(
          fmt::format("view {}: the scene names no image, and neither {} nor masks/, silhouettes/ or images/ in it "
                      "contains {} images, one for each view; give --images DIR or --silhouette",
                      view.name, folder.empty() ? "." : folder.string(), count));
    }
    const auto found = look_up_image(folders, view.image.string());
    files[i] = found ? *found : find_image(folder, view.image.string());
  }
  return files;
}

void leave_out_views(Scene& scene, const std::vector<std::string>& names, const fs::path& folder,
                     const std::optional<fs::path>& images, nef::Messages* notes) {
  if (scene.guessed) {
    throw nef::InputError("views of a turntable whose camera is not known cannot be left out: its steps are equal");
  }
  for (const std::string& name : names) {
    if (std::none_of(scene.views.begin(), scene.views.end(), [&](const View& view) { return view.name == name; })) {
      throw nef::InputError("view " + name + " cannot be left out: the scene has no view of this name");
    }
  }
  const std::vector<fs::path> files = images_of(scene, folder, images, notes);
  std::vector<View> left;
  for (std::size_t i = 0; i < files.size(); ++i) {
    View& view = scene.views[i];
    if (std::find(names.begin(), names.end(), view.name) != names.end()) continue;
    if (!files[i].empty()) view.image = fs::absolute(files[i]);
    left.push_back(std::move(view));
  }
  if (left.empty()) throw nef::InputError("all views are left out: without any there is no hull");
  scene.views = std::move(left);
}

std::optional<ImageSize> size_of_image(const fs::path& folder, const std::string& name) {
  if (name.empty()) return std::nullopt;
  const auto file = look_up_image({folder}, name);
  if (!file) return std::nullopt;
  const cv::Mat image = read_pixels(*file);
  if (image.empty()) return std::nullopt;  // whoever needs the pixels says what is wrong with them
  return ImageSize{image.cols, image.rows};
}

}  // namespace nef::visual_hull
