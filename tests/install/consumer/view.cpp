// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <iostream>
#include "apps/view/picture.h"
#include "nef/construct/construct.h"
int main() {
  nef::view::Layer layer;
  layer.scene = nef::view::build_scene(nef::make_box({0, 0, 0}, {2, 2, 2}), {});
  nef::view::PictureOptions options;
  options.width = 64;
  options.height = 48;
  nef::view::write_picture({layer}, "box.png", options);
  if (std::filesystem::file_size("box.png") > 0) std::cout << "a picture of 64x48\n";
}
