// SPDX-License-Identifier: Apache-2.0
//
// Cameras as calibration programs leave them: blocks under comments, and one file for each image. A comment line says
// what the following rows are; matrices are rows of numbers, read as the rationals that they spell. A folder is read
// file by file with `read_text_scene`, which knows PMVS's files, too.
#include "apps/visual_hull/formats/scene_blocks.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "apps/visual_hull/formats/scene_text.h"
#include "apps/visual_hull/scene/natural_order.h"
#include "apps/visual_hull/scene/scene_number.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::visual_hull {
namespace fs = std::filesystem;

namespace {

// The words of a comment line if the first one is `keyword`, whatever its case.
std::vector<std::string> comment_words(const std::string& line, const std::string& keyword) {
  const std::size_t start = line.find_first_not_of(" \t");
  if (start == std::string::npos || line[start] != '#') return {};
  std::istringstream stream(line.substr(start + 1));
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  if (words.empty() || words[0].size() != keyword.size()) return {};
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  return std::equal(words[0].begin(), words[0].end(), keyword.begin(), same) ? words : std::vector<std::string>{};
}

class BlockReader {
 public:
  BlockReader(const std::string& text, const fs::path& file) : stream_(text), file_(file) {}

  Scene read() {
    while (next_line()) {
      if (!comment_words(line_, "intrinsic").empty()) {
        read_rows(k_, 3);
        has_k_ = true;
      } else if (const auto words = comment_words(line_, "extrinsic"); !words.empty()) {
        read_camera(words);
      }
    }
    scene_.format = "text, blocks of intrinsic and extrinsic parameters";
    return std::move(scene_);
  }

 private:
  bool next_line() {
    ++number_;
    return static_cast<bool>(std::getline(stream_, line_));
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw nef::InputError(file_.string() + ", line " + std::to_string(number_) + ": " + what);
  }

  template <std::size_t kColumns>
  void read_rows(std::array<std::array<Rational, kColumns>, 3>& matrix, std::size_t columns) {
    for (std::size_t row = 0; row < 3; ++row) {
      do {
        if (!next_line()) fail("the file ends inside a matrix");
      } while (line_.find_first_not_of(" \t\r") == std::string::npos);
      std::istringstream words(line_);
      std::vector<std::string> tokens;
      for (std::string token; words >> token;) tokens.push_back(token);
      if (tokens.size() != columns) {
        fail("a row of " + std::to_string(columns) + " numbers is needed, not " + std::to_string(tokens.size()));
      }
      for (std::size_t i = 0; i < columns; ++i) {
        matrix[row][i] = scene_number(tokens[i], file_.string() + ", line " + std::to_string(number_), "of a camera");
      }
    }
  }

  void read_camera(const std::vector<std::string>& words) {
    if (!has_k_) fail("the intrinsic parameters are missing: they must come before the extrinsic ones");
    View view;
    const bool named = words.size() > 1 && words[words.size() - 2] == "for";
    view.name = named ? words.back() : std::to_string(scene_.views.size() + 1);
    if (named) view.image = view.name;
    Matrix34 pose;
    read_rows(pose, 4);
    Matrix3 r;
    Rational3 t;
    for (std::size_t i = 0; i < 3; ++i) {
      std::copy_n(pose[i].begin(), 3, r[i].begin());
      t[i] = pose[i][3];
    }
    view.camera = Camera::from_parts(view.name, k_, r, t);
    scene_.views.push_back(std::move(view));
  }

  std::istringstream stream_;
  fs::path file_;
  std::string line_;
  std::size_t number_ = 0;
  Matrix3 k_;
  bool has_k_ = false;
  Scene scene_;
};

// In the order of their names, by number.
std::vector<fs::path> files_with(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.is_regular_file(error) && entry.path().extension() == extension) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return naturally_before(a.filename().string(), b.filename().string());
  });
  return files;
}

// The files of a folder that begin as PMVS's cameras do.
std::vector<fs::path> contour_files(const fs::path& folder) {
  std::vector<fs::path> files = files_with(folder, ".txt");
  const auto other = [](const fs::path& file) {
    std::ifstream stream(file);
    std::string word;
    return !(stream >> word) || word != "CONTOUR";
  };
  files.erase(std::remove_if(files.begin(), files.end(), other), files.end());
  return files;
}

}  // namespace

bool has_parameter_blocks(const std::string& text) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!comment_words(line, "extrinsic").empty()) return true;
  }
  return false;
}

Scene read_parameter_blocks(const std::string& text, const fs::path& file) { return BlockReader(text, file).read(); }

Scene read_camera_folder(const fs::path& folder) {
  std::vector<fs::path> files = files_with(folder, ".pa");
  Scene scene;
  scene.format = "a folder of NAME.pa, one 3x4 matrix per file";
  if (files.empty()) {
    for (const char* sub : {"txt", "calib", "cameras", ""}) {
      files = contour_files(*sub == '\0' ? folder : folder / sub);
      if (!files.empty()) break;
    }
    scene.format = "a PMVS folder of CONTOUR files, one 3x4 matrix per file";
  }
  if (files.empty()) {
    throw nef::InputError(
        folder.string() +
        " is a directory without cameras (a COLMAP model, transforms.json, NAME.pa, "
        "or CONTOUR files of PMVS in txt/); give a scene file, or --turntable N for images of one turn");
  }
  for (const fs::path& file : files) {
    Scene one = read_text_scene(nef::read_file(file.string()), file);
    if (one.views.size() != 1) {
      throw nef::InputError(file.string() + ": one 3x4 matrix is needed, not " + std::to_string(one.views.size()));
    }
    View& view = one.views[0];
    view.name = file.stem().string();
    view.image = view.name;
    view.camera = Camera(view.name, view.camera.matrix());
    scene.views.push_back(std::move(view));
  }
  return scene;
}

}  // namespace nef::visual_hull
