// SPDX-License-Identifier: Apache-2.0
//
// Names that hold numbers: their order, and which image a view gets.
#include "apps/visual_hull/scene/natural_order.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>

#include "apps/visual_hull/scene/images.h"
#include "tests/visual_hull/command/run_command.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using Catch::Contains;
using testing::Outcome;
using testing::run;
using testing::Scratch;
namespace fs = std::filesystem;

// The oracle: with all numbers padded to one length, natural order is text order. Leading zeros decide what is tied.
std::string padded(const std::string& name) {
  std::string result;
  for (std::size_t i = 0; i < name.size();) {
    std::size_t end = i;
    while (end < name.size() && std::isdigit(static_cast<unsigned char>(name[end])) != 0) ++end;
    if (end == i) {
      result += name[i++];
    } else {
      result += std::string(40 - (end - i), '0') + name.substr(i, end - i);
      i = end;
    }
  }
  return result;
}

std::string random_name() {
  const auto part = rc::gen::weightedOneOf<std::string>(
      {{3, rc::gen::container<std::string>(rc::gen::elementOf(std::string("0012379")))},
       {2, rc::gen::element<std::string>("img", "a", "_", "-", ".", "\xc3\xa9", "B", "img_")}});
  std::string name;
  for (const std::string& text : *rc::gen::resize(4, rc::gen::container<std::vector<std::string>>(part))) name += text;
  return name;
}

TEST_CASE("Names are ordered by their numbers, totally") {
  CHECK(naturally_before("img2", "img10"));
  CHECK(naturally_before("img9.png", "img010.png"));
  CHECK(naturally_before("a2b10", "a02b9") == false);
  CHECK(naturally_before("img01", "img1"));
  CHECK(naturally_before("99999999999999999999999998", "99999999999999999999999999"));
  CHECK(naturally_before("img", "img1"));
  CHECK(naturally_before("cam2_img10", "cam10_img2"));
  CHECK_FALSE(naturally_before("img1", "img1"));
  testing::property("as padded numbers have it", [] {
    const std::string a = random_name();
    const std::string b = random_name();
    const std::string x = padded(a);
    const std::string y = padded(b);
    if (x != y) {
      RC_ASSERT(naturally_before(a, b) == (x < y));
      RC_ASSERT(naturally_before(b, a) == (y < x));
    } else {
      RC_ASSERT((naturally_before(a, b) || naturally_before(b, a)) == (a != b));
      RC_ASSERT(!(naturally_before(a, b) && naturally_before(b, a)));
    }
  });
  testing::property("sorting does not depend on the order before", [] {
    std::vector<std::string> names;
    for (int i = *rc::gen::inRange(2, 12); i > 0; --i) names.push_back(random_name());
    std::vector<std::string> other = names;
    std::reverse(other.begin(), other.end());
    std::sort(names.begin(), names.end(), naturally_before);
    std::sort(other.begin(), other.end(), naturally_before);
    RC_ASSERT(names == other);
  });
}

std::vector<std::string> names_of(const std::vector<fs::path>& files) {
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(file.filename().string());
  return names;
}

Scene scene_of_names(const std::vector<std::string>& images) {
  Scene scene;
  for (const std::string& image : images) {
    scene.views.emplace_back();
    scene.views.back().name = image;
    scene.views.back().image = image;
  }
  return scene;
}

TEST_CASE("Images of a folder go to views by number, or by the names that views give them") {
  const Scratch s;
  for (const char* name : {"img1.png", "img2.png", "img10.png"}) s.write(name, "x");
  const std::vector<std::string> by_number{"img1.png", "img2.png", "img10.png"};
  CHECK(names_of(list_images(s.folder())) == by_number);

  nef::Messages notes;
  CHECK(names_of(images_of(scene_of_names({"", "", ""}), s.folder(), std::nullopt, &notes)) == by_number);
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Contains("in the order of the numbers in their names (img2.png before img10.png)"));
  notes.clear();
  CHECK(names_of(images_of(scene_of_names({"a", "b", "c"}), ".", s.folder(), &notes)) == by_number);
  CHECK(notes.size() == 1);
  // A list that somebody wrote keeps its order.
  notes.clear();
  const Scene listed = scene_of_names({"img1.jpg", "img10.jpg", "img2.jpg"});
  const std::vector<std::string> as_listed{"img1.png", "img10.png", "img2.png"};
  CHECK(names_of(images_of(listed, ".", s.folder(), &notes)) == as_listed);
  CHECK(names_of(images_of(listed, s.folder(), std::nullopt, &notes)) == as_listed);
  CHECK(notes.empty());

  // A view that is left out leaves the images of the others as they are.
  Scene some = scene_of_names({"a", "b", "c"});
  leave_out_views(some, {"b"}, ".", s.folder());
  CHECK(names_of(images_of(some, "/elsewhere", std::nullopt)) == std::vector<std::string>{"img1.png", "img10.png"});
  CHECK_THROWS_WITH(leave_out_views(some, {"b"}, ".", std::nullopt), Contains("no view of this name"));
  CHECK_THROWS_WITH(leave_out_views(some, {"a", "c"}, ".", std::nullopt), Contains("all views are left out"));
  some.guessed = true;
  CHECK_THROWS_WITH(leave_out_views(some, {"a"}, ".", std::nullopt), Contains("its steps are equal"));

  fs::create_directories(s.folder() / "padded");
  for (const char* name : {"img01.png", "img02.png", "img10.png"}) s.write("padded/" + std::string(name), "x");
  images_of(scene_of_names({"", "", ""}), s.folder() / "padded", std::nullopt, &notes);
  CHECK(notes.empty());
}

TEST_CASE("Camera files of a folder, and numbered matrices, are views by number") {
  const Scratch s;
  fs::create_directories(s.folder() / "pa");
  for (const char* name : {"v10", "v9", "v2"}) s.write("pa/" + std::string(name) + ".pa", "1 0 0 0 0 1 0 0 0 0 1 5");
  std::vector<std::string> names;
  for (const View& view : read_scene(s.folder() / "pa").views) names.push_back(view.name);
  CHECK(names == std::vector<std::string>{"v2", "v9", "v10"});

  fs::create_directories(s.folder() / "model");
  s.write("model/cameras.txt", "1 PINHOLE 200 100 100 100 100 50\n");
  s.write("model/images.txt", "1 1 0 0 0 0 0 5 1 f10.png\n\n2 1 0 0 0 0 0 5 1 f9.png\n\n3 1 0 0 0 0 0 5 1 f1.png\n\n");
  names.clear();
  for (const View& view : read_scene(s.folder() / "model").views) names.push_back(view.name);
  CHECK(names == std::vector<std::string>{"f1.png", "f9.png", "f10.png"});

  const std::string matrix = ": [[1., 0., 0., 0.], [0., 1., 0., 0.], [0., 0., 1., 5.]]\n";
  std::string text = "%YAML:1.0\n---\n";
  for (const char* name : {"m10", "m2", "m01"}) text += name + matrix;
  names.clear();
  for (const View& view : read_scene(s.write("m.yml", text), {"m*"}).views) names.push_back(view.name);
  CHECK(names == std::vector<std::string>{"01", "2", "10"});
  CHECK_THROWS_WITH(read_scene(s.write("p.yml", "%YAML:1.0\n---\nP1" + matrix + "P01" + matrix)),
                    Contains("'P1' and 'P01' have the same number"));
}

// The hull of images that are numbered without zeros is that of the same images named by the scene.
TEST_CASE("The program pairs images by number, and says so") {
  const Scratch s;
  const std::string scene = source_folder() + "/data/visual_hull/eight/eight.json";
  for (int i = 0; i < 12; ++i) {
    char name[16];
    std::snprintf(name, sizeof name, "eight_%02d.png", i);
    fs::copy_file(fs::path(scene).parent_path() / name, s.folder() / ("mask" + std::to_string(i + 1) + ".png"));
  }
  const auto volume = [&](const std::string& options) {
    const Outcome outcome = run(scene + " --simplify 2 " + options);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const std::size_t at = outcome.output.find("-> hull with");
    REQUIRE(at != std::string::npos);
    return outcome.output.substr(at, outcome.output.find(" (", at) - at);
  };
  const std::string images = "--images " + s.folder().string();
  CHECK(volume(images) == volume(""));
  CHECK_THAT(run(scene + " --simplify 2 " + images).output, Contains("(mask9.png before mask10.png)"));
  CHECK_THAT(run(scene + " --check " + images).output, Contains("(mask9.png before mask10.png)"));
  const Outcome turntable = run(s.folder().string() + " --check --turntable 12 --K 100,50,50 --radius 5");
  CHECK(turntable.code == 0);
  CHECK_THAT(turntable.output, Contains("2: " + (s.folder() / "mask2.png").string()));
  CHECK_THAT(turntable.output, Contains("12: " + (s.folder() / "mask12.png").string()));
}

}  // namespace
}  // namespace nef::visual_hull
