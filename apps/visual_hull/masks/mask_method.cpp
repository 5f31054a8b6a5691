// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/masks/mask_method.h"

#include <charconv>
#include <map>

#include "apps/program/numbers.h"
#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"

namespace nef::visual_hull {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw nef::InputError("--mask " + nef::in_quotes(text) + ": " + why);
}

std::array<int, 3> parse_color(const std::string& text, const std::string& color) {
  static const std::map<std::string, std::array<int, 3>> names{{"green", {0, 255, 0}},     {"blue", {0, 0, 255}},
                                                               {"red", {255, 0, 0}},       {"black", {0, 0, 0}},
                                                               {"white", {255, 255, 255}}, {"magenta", {255, 0, 255}}};
  if (const auto found = names.find(color); found != names.end()) return found->second;
  std::array<int, 3> result{};
  bool good = color.size() == 7 && color[0] == '#';
  for (std::size_t i = 0; good && i < 3; ++i) {
    const char* const begin = color.data() + 1 + 2 * i;
    const auto [end, error] = std::from_chars(begin, begin + 2, result[i], 16);
    good = error == std::errc() && end == begin + 2;
  }
  if (!good) refuse(text, "the colour is #RRGGBB, or green, blue, red, magenta, black or white");
  return result;
}

void parse_threshold_into(MaskMethod& method, const std::string& text, const std::string& rest) {
  if (rest.empty()) return;
  const std::size_t colon = rest.find(':');
  method.channel = parse_channel(rest.substr(0, colon));
  if (colon == std::string::npos) return;
  std::string level = rest.substr(colon + 1);
  method.below = level.starts_with('<');
  if (method.below) level.erase(0, 1);
  const std::optional<nef::Rational> value = nef::try_parse_rational(level);
  if (!value) refuse(text, "the level is a number of 255, or <NUMBER for an object that is darker");
  method.level = nef::nearest_double(*value);
}

std::array<int, 4> parse_rectangle(const std::string& text, const std::string& rest) {
  std::array<int, 4> result{};
  const std::vector<nef::Rational> numbers = nef::parse_numbers(rest, 4, "--mask grabcut");
  for (std::size_t i = 0; i < 4; ++i) {
    if (numbers[i].get_den() != 1 || numbers[i] < (i < 2 ? 0 : 1) || numbers[i] > 100000) {
      refuse(text, "the rectangle is x,y,width,height in whole pixels");
    }
    result[i] = static_cast<int>(numbers[i].get_num().get_si());
  }
  return result;
}

}  // namespace

MaskMethod parse_mask_method(const std::string& text) {
  using Kind = MaskMethod::Kind;
  const std::size_t colon = text.find(':');
  const std::string word = text.substr(0, colon);
  const std::string rest = colon == std::string::npos ? "" : text.substr(colon + 1);
  MaskMethod method;
  if (word == "auto" && colon == std::string::npos) return method;
  if (word == "threshold") {
    method.kind = Kind::kThreshold;
    parse_threshold_into(method, text, rest);
  } else if (word == "background" && !rest.empty()) {
    method.kind = rest == "median" ? Kind::kMedian : Kind::kBackground;
    method.background = rest;
  } else if (word == "key") {
    method.kind = Kind::kKey;
    method.key = parse_color(text, rest);
  } else if (word == "grabcut") {
    method.kind = Kind::kGrabCut;
    const bool numbers = rest.find_first_not_of("0123456789,.- ") == std::string::npos;
    if (!rest.empty() && numbers) method.rectangle = parse_rectangle(text, rest);
    if (!numbers) method.strokes = rest;
  } else {
    refuse(text,
           "it is auto, threshold[:CHANNEL[:LEVEL]], background:FILE, background:median, key:COLOUR or "
           "grabcut[:X,Y,WIDTH,HEIGHT] or grabcut:STROKES");
  }
  return method;
}

}  // namespace nef::visual_hull
