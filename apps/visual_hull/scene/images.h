// SPDX-License-Identifier: Apache-2.0
//
// The image files of a scene.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/visual_hull/scene/scene.h"
#include "nef/construct/construct.h"

namespace nef::visual_hull {

/// The folder in which the images of a scene are looked up: the scene itself if it is one.
std::filesystem::path scene_folder(const std::filesystem::path& scene);

/// The image that a scene calls `name`: as it is, with a usual extension added, or with another
/// usual extension, in one of `folders` or in their subfolders masks, silhouettes, images and visualize, in this order.
/// A name that begins with `images/` is looked up in masks and silhouettes first: these are what a hull is made from.
/// Nothing if there is none.
std::optional<std::filesystem::path> look_up_image(const std::vector<std::filesystem::path>& folders,
                                                   const std::string& name);

/// The same in one folder. Throws InputError if there is none.
std::filesystem::path find_image(const std::filesystem::path& folder, const std::string& name);

/// The images of a folder in the order of their names, where numbers are compared as such (natural_order.h). Throws
/// InputError if it is none.
std::vector<std::filesystem::path> list_images(const std::filesystem::path& folder);

/// An image file for each view that has no polygons, an empty path for others: those of `images` (a folder), else what
/// the scene names, else, if it names none, the images of the first of `folder` and its subfolders masks, silhouettes
/// and images that holds as many as there are views. Images of a folder belong to the views whose images have the same
/// names without extensions if all have such partners, else the i-th in the order of list_images to the i-th view;
/// `notes` gets a line if that is not the order of the names as text. Throws InputError naming the view or the folder.
std::vector<std::filesystem::path> images_of(const Scene& scene, const std::filesystem::path& folder,
                                             const std::optional<std::filesystem::path>& images,
                                             nef::Messages* notes = nullptr);

/// Takes the views of these names out of a scene. Those that stay have the images that images_of finds for all of them,
/// as absolute paths. Throws InputError for a name that no view has, where no view would be left, for a turntable whose
/// camera is to be found (Scene::guessed), whose steps are equal then; and what images_of does.
void leave_out_views(Scene& scene, const std::vector<std::string>& names, const std::filesystem::path& folder,
                     const std::optional<std::filesystem::path>& images, nef::Messages* notes = nullptr);

/// The size of an image that a scene calls `name`, if it is there and can be read.
std::optional<ImageSize> size_of_image(const std::filesystem::path& folder, const std::string& name);

}  // namespace nef::visual_hull
