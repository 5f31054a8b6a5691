// SPDX-License-Identifier: Apache-2.0
//
// Lines are split into words first; comments, calls of functions in other languages and the punctuation of matrices are
// dropped. Then the number of words in a line tells what begins there: 12 or 21 numbers, with or without a name, are a
// camera, and rows of four numbers are read three at a time.
#include "apps/visual_hull/formats/scene_text.h"

#include <algorithm>
#include <sstream>

#include "apps/visual_hull/scene/scene_number.h"
#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"

namespace nef::visual_hull {
namespace {

struct Line {
  std::size_t number = 0;
  std::vector<std::string> tokens;
};

// Comments go, and so do lines of other programs' languages that call a function (P = cat(3, P0, P1);); the
// punctuation of matrices as these print them counts as space.
std::vector<Line> split(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream stream(text);
  std::string raw;
  bool call = false;
  for (std::size_t number = 1; std::getline(stream, raw); ++number) {
    raw = raw.substr(0, raw.find('#'));
    call = call || (raw.find('(') != std::string::npos && raw.find('=') < raw.find('('));
    if (call) {
      call = raw.find(')') == std::string::npos;  // it may take several lines
      continue;
    }
    std::replace_if(
        raw.begin(), raw.end(), [](char c) { return c == ',' || c == ';' || c == '[' || c == ']' || c == '='; }, ' ');
    std::istringstream words(raw);
    Line line{number, {}};
    std::string token;
    while (words >> token) line.tokens.push_back(token);
    if (!line.tokens.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

class TextScene {
 public:
  TextScene(const std::string& text, const std::filesystem::path& file) : file_(file), lines_(split(text)) {}

  Scene read() {
    std::size_t announced = 0;
    std::size_t i = 0;
    if (lines_.size() > 1 && lines_[0].tokens.size() == 1 && lines_[1].tokens.size() >= 12) {
      announced = count(lines_[0]);
      i = 1;
    }
    while (i < lines_.size()) i = read_view(i);
    if (scene_.views.empty()) throw nef::InputError(file_.string() + ": there is no camera in the file");
    if (announced != 0 && announced != scene_.views.size()) {
      throw nef::InputError(file_.string() + ": the first line announces " + std::to_string(announced) +
                            " views, but there are " + std::to_string(scene_.views.size()));
    }
    scene_.format = "text, " + kind_;
    return std::move(scene_);
  }

 private:
  [[noreturn]] void fail(const Line& line, const std::string& what) const {
    throw nef::InputError(place(line) + ": " + what);
  }

  std::string place(const Line& line) const { return file_.string() + ", line " + std::to_string(line.number); }

  // Nothing is told of a file that has shown neither a camera nor most of a line of numbers: it may be anything.
  Quote quote(std::size_t numbers_before) const {
    constexpr std::size_t kEnough = 6;
    return scene_.views.empty() && numbers_before < kEnough ? Quote::kNever : Quote::kWord;
  }

  std::size_t count(const Line& line) const {
    const std::string& token = line.tokens[0];
    if (token.size() > 7 || token.find_first_not_of("0123456789") != std::string::npos) {
      fail(line, "a number of views, or a camera, is expected");
    }
    return std::stoul(token);
  }

  std::vector<Rational> numbers(const Line& line, std::size_t from) const {
    std::vector<Rational> values;
    for (std::size_t i = from; i < line.tokens.size(); ++i) {
      values.push_back(scene_number(line.tokens[i], place(line), "of a camera", quote(values.size())));
    }
    return values;
  }

  static Matrix34 matrix(const std::vector<Rational>& v) {
    Matrix34 m;
    for (std::size_t i = 0; i < 12; ++i) m[i / 4][i % 4] = v[i];
    return m;
  }

  static Matrix3 matrix3(const std::vector<Rational>& v, std::size_t from) {
    Matrix3 m;
    for (std::size_t i = 0; i < 9; ++i) m[i / 3][i % 3] = v[from + i];
    return m;
  }

  void add(const std::string& name, const Camera& camera, bool named) {
    View view;
    view.name = name;
    view.camera = camera;
    if (named) view.image = name;
    scene_.views.push_back(std::move(view));
  }

  std::string default_name() const { return std::to_string(scene_.views.size() + 1); }

  // Reads the camera that begins at line i; returns the line after it.
  std::size_t read_view(std::size_t i) {
    const Line& line = lines_[i];
    const std::size_t n = line.tokens.size();
    if (n == 22 || n == 21) {
      const std::vector<Rational> v = numbers(line, n - 21);
      const std::string name = n == 22 ? line.tokens[0] : default_name();
      kind_ = "K R t per line (Middlebury)";
      add(name, Camera::from_parts(name, matrix3(v, 0), matrix3(v, 9), {v[18], v[19], v[20]}), n == 22);
      return i + 1;
    }
    if (n == 13 || n == 12) {
      const std::string name = n == 13 ? line.tokens[0] : default_name();
      add(name, Camera(name, matrix(numbers(line, n - 12))), n == 13);
      return i + 1;
    }
    if (n == 1 || n == 4 || n == 5) return read_rows(i);
    fail(line, std::to_string(n) +
                   " words: a camera is [name] and 12 numbers (3x4 matrix), [name] and 21 numbers (K R t), "
                   "or three lines of four numbers");
  }

  std::size_t read_rows(std::size_t i) {
    const Line& head = lines_[i];
    std::string name = default_name();
    bool named = false;
    if (head.tokens.size() != 4) {
      name = head.tokens[0];
      named = true;
    }
    if (head.tokens.size() == 1) ++i;
    std::vector<Rational> values;
    for (std::size_t row = 0; row < 3; ++row, ++i) {
      if (i >= lines_.size()) {
        fail(head, "the file ends inside the matrix of " +
                       (quote(values.size()) == Quote::kWord ? "view " + nef::in_quotes(name) : "this view"));
      }
      const std::size_t skip = lines_[i].tokens.size() == 5 && row == 0 && head.tokens.size() == 5 ? 1 : 0;
      if (lines_[i].tokens.size() - skip != 4) fail(lines_[i], "a row of a 3x4 matrix has four numbers");
      const std::vector<Rational> part = numbers(lines_[i], skip);
      values.insert(values.end(), part.begin(), part.end());
    }
    add(name, Camera(name, matrix(values)), named);
    return i;
  }

  std::filesystem::path file_;
  std::vector<Line> lines_;
  std::string kind_ = "3x4 matrices";
  Scene scene_;
};

}  // namespace

Scene read_text_scene(const std::string& text, const std::filesystem::path& file) {
  return TextScene(text, file).read();
}

}  // namespace nef::visual_hull
