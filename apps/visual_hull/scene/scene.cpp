// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/scene/scene.h"

#include <map>

#include "nef/base/error.h"
#include "nef/base/in_quotes.h"

namespace visual_hull {

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

ThresholdOptions::Channel parse_channel(const std::string& text) {
  using Channel = ThresholdOptions::Channel;
  static const std::map<std::string, Channel> names{{"gray", Channel::kGray},
                                                    {"red", Channel::kRed},
                                                    {"green", Channel::kGreen},
                                                    {"blue", Channel::kBlue},
                                                    {"alpha", Channel::kAlpha}};
  const auto found = names.find(text);
  if (found == names.end())
    throw nef::InputError("channel " + nef::in_quotes(text) + " is not gray, red, green, blue or alpha");
  return found->second;
}

}  // namespace visual_hull
