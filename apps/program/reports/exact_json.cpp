// SPDX-License-Identifier: Apache-2.0
//
// nlohmann's parser reports events; the handler here builds the value from them, so that it sees the text of a number
// before the library rounds it. A number with a fraction or exponent is stored as an object with one reserved key,
// which no input may use itself.
#include "apps/program/reports/exact_json.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"

namespace nef {
namespace {

using nlohmann::json;

// The key under which the text of a number is kept.
constexpr const char* kNumber = "$number";

// More are a mistake, or an attack on the stack of whoever reads the value.
constexpr std::size_t kMostLevels = 100;

// nlohmann's id for a number that no double holds.
constexpr int kNumberOverflow = 406;

// The end of a text, which is where an error was noticed.
std::string tail(const std::string& text) {
  constexpr std::size_t kLength = 37;  // and three dots
  return text.size() <= kLength ? text : "..." + text.substr(text.size() - kLength);
}

// Builds a value from parser events; floats keep their spelling.
class KeepText : public nlohmann::json_sax<json> {
 public:
  KeepText(const std::string& text, std::string name) : text_(text), name_(std::move(name)) {}

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t /*value*/, const string_t& text) override { return put({{kNumber, text}}); }
  bool string(string_t& value) override { return put(value); }
  bool binary(binary_t& /*value*/) override { return false; }
  bool start_object(std::size_t /*size*/) override { return open(json::object()); }
  bool key(string_t& value) override {
    key_ = value;
    if (value == kNumber) throw InputError(name_ + ": unknown key " + in_quotes(value));
    if (levels_.back().value.contains(value)) throw InputError(name_ + ": " + in_quotes(value) + " is given twice");
    return true;
  }
  bool end_object() override { return close(); }
  bool start_array(std::size_t /*size*/) override { return open(json::array()); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception& e) override {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(position, text_.size()));
    const std::string line = name_ + ":" + std::to_string(1 + std::count(text_.begin(), end, '\n')) + ": ";
    if (e.id == kNumberOverflow) {
      throw InputError(line + "the number " + tail(token) + " is too large for JSON: write it as a string");
    }
    // A file that does not begin like JSON may be anything, and nothing of it is told.
    const std::size_t first = text_.find_first_not_of(" \t\r\n");
    if (first == std::string::npos || (text_[first] != '{' && text_[first] != '[')) {
      throw InputError(name_ + ": not a JSON file, which begins with { or [");
    }
    throw InputError(line + "not valid JSON near " + in_quotes(tail(token)));
  }

  json result;

 private:
  struct Level {
    json value;
    std::string key;  // under which it goes into the level above
  };
  bool put(json value) {
    if (levels_.empty()) {
      result = std::move(value);
    } else if (levels_.back().value.is_array()) {
      levels_.back().value.push_back(std::move(value));
    } else {
      levels_.back().value[key_] = std::move(value);
    }
    return true;
  }
  bool open(json value) {
    if (levels_.size() >= kMostLevels) {
      throw InputError(name_ + ": nested more than " + std::to_string(kMostLevels) + " levels deep");
    }
    levels_.push_back({std::move(value), key_});
    return true;
  }
  bool close() {
    Level level = std::move(levels_.back());
    levels_.pop_back();
    key_ = level.key;
    return put(std::move(level.value));
  }

  const std::string& text_;
  std::string name_;
  std::string key_;
  std::vector<Level> levels_;
};

}  // namespace

json parse_exact_json(const std::string& text, const std::string& name) {
  KeepText handler(text, name);
  json::sax_parse(text, &handler);
  return std::move(handler.result);
}

std::string spelled(const json& value) {
  if (value.is_object() && value.contains(kNumber)) return value[kNumber].get<std::string>();
  if (!value.is_array()) return value.dump();
  std::string list;
  for (const json& item : value) list += (list.empty() ? "" : ", ") + spelled(item);
  return "[" + list + "]";
}

Rational rational_of(const json& value, const std::string& what) {
  std::string text;
  if (value.is_number_integer()) {
    text = value.dump();
  } else if (value.is_string()) {
    text = value.get<std::string>();
  } else if (value.is_object() && value.contains(kNumber)) {
    text = value[kNumber].get<std::string>();
  } else {
    throw InputError(what + ": expected a number or a string such as \"1/3\", not " + in_quotes(spelled(value)));
  }
  try {
    return parse_rational(text);
  } catch (const InputError& error) {
    throw InputError(what + ": " + error.what());
  }
}

std::vector<Rational> rationals_of(const json& value, const std::string& what) {
  std::vector<Rational> numbers;
  if (!value.is_array()) throw InputError(what + ": expected a list of numbers, not " + in_quotes(spelled(value)));
  for (const json& item : value) {
    if (item.is_array()) {
      const std::vector<Rational> inner = rationals_of(item, what);
      numbers.insert(numbers.end(), inner.begin(), inner.end());
    } else {
      numbers.push_back(rational_of(item, what));
    }
  }
  return numbers;
}

Rational3 point_of(const json& value, const std::string& what) {
  if (!value.is_array() || value.size() != 3)
    throw InputError(what + ": expected three numbers, as in [0, 0.5, \"1/3\"]");
  return {rational_of(value[0], what), rational_of(value[1], what), rational_of(value[2], what)};
}

json exact_json(std::span<const Rational> numbers) {
  json result = json::array();
  for (const Rational& x : numbers) result.push_back(to_string(x));
  return result;
}

json double_json(const Rational3& point) {
  return {nearest_double(point[0]), nearest_double(point[1]), nearest_double(point[2])};
}

}  // namespace nef
