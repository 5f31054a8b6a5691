// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/scene/scene.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"
#include "nef/base/text/word_list.h"

namespace nef::visual_hull {

ThresholdOptions parse_threshold(const std::string& text) {
  ThresholdOptions options;
  if (text == "otsu") {
    options.kind = ThresholdOptions::Kind::kOtsu;
    return options;
  }
  options.kind = ThresholdOptions::Kind::kValue;
  const std::optional<Rational> value = nef::try_parse_rational(text);
  if (!value) throw nef::InputError("threshold " + nef::in_quotes(text) + " is neither a number nor otsu");
  options.value = nef::nearest_double(*value);
  return options;
}

const std::vector<std::string>& channel_names() {
  static const std::vector<std::string> names{"gray",  "red",        "green",    "blue",      "alpha",
                                              "value", "saturation", "red-blue", "red-green", "green-blue"};
  return names;
}

ThresholdOptions::Channel parse_channel(const std::string& text) {
  const std::vector<std::string>& names = channel_names();
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) {
    throw nef::InputError("channel " + nef::in_quotes(text) + " is not " + nef::word_list(names, "or"));
  }
  return static_cast<ThresholdOptions::Channel>(found - names.begin());
}

}  // namespace nef::visual_hull
