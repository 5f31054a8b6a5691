// SPDX-License-Identifier: Apache-2.0
//
// Values of JSON files with the place where they stand, which every complaint names.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "nef/number/number.h"

namespace nef {

/// A value that parse_exact_json has made, and where it stands: "file: key: inner key". It refers to the value. All
/// readers throw InputError "where: what" for another value than is wanted.
class JsonReader {
 public:
  JsonReader(const nlohmann::json& value, std::string where) : value_(value), where_(std::move(where)) {}

  [[nodiscard]] const nlohmann::json& value() const { return value_; }
  [[nodiscard]] const std::string& where() const { return where_; }
  [[noreturn]] void fail(const std::string& what) const;

  /// Requires an object with all of the required keys and no others but the optional ones.
  void require_keys(const std::vector<const char*>& required, const std::vector<const char*>& optional = {}) const;
  /// Whether it is an object with this key.
  [[nodiscard]] bool has(const std::string& key) const { return value_.is_object() && value_.contains(key); }
  /// The value of a key, which must be there.
  [[nodiscard]] JsonReader operator[](const std::string& key) const { return {value_[key], where_ + ": " + key}; }

  /// make(reader) for each value of a list.
  template <class Make>
  [[nodiscard]] auto list(Make&& make) const {
    if (!value_.is_array()) fail("expected a list");
    std::vector<decltype(make(*this))> result;
    for (const nlohmann::json& entry : value_) result.push_back(make(JsonReader(entry, where_)));
    return result;
  }
  /// The same for a list of so many values.
  template <std::size_t kSize, class Make>
  [[nodiscard]] auto exactly(Make&& make) const {
    if (!value_.is_array() || value_.size() != kSize) fail("expected a list of " + std::to_string(kSize));
    const auto all = list(make);
    std::array<decltype(make(*this)), kSize> result{};
    std::copy(all.begin(), all.end(), result.begin());
    return result;
  }

  /// Numbers and points as rational_of and point_of (exact_json.h) take them.
  [[nodiscard]] Rational number() const;
  [[nodiscard]] Rational3 point() const;
  /// The number of one of these words.
  [[nodiscard]] std::size_t word(std::span<const char* const> words) const;

  static Rational number_of(const JsonReader& reader) { return reader.number(); }
  static Rational3 point_of(const JsonReader& reader) { return reader.point(); }

 private:
  const nlohmann::json& value_;
  std::string where_;
};

}  // namespace nef
