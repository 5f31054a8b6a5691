// SPDX-License-Identifier: Apache-2.0
#include "apps/program/reports/json_reader.h"

#include "apps/program/nearest_word.h"
#include "apps/program/reports/exact_json.h"
#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"
#include "nef/base/text/word_list.h"

namespace nef {

void JsonReader::fail(const std::string& what) const { throw InputError(where_ + ": " + what); }

void JsonReader::require_keys(const std::vector<const char*>& required,
                              const std::vector<const char*>& optional) const {
  if (!value_.is_object()) fail("expected a JSON object");
  for (const auto& item : value_.items()) {
    const auto is_it = [&](const char* key) { return item.key() == key; };
    if (std::any_of(required.begin(), required.end(), is_it)) continue;
    if (std::any_of(optional.begin(), optional.end(), is_it)) continue;
    std::vector<const char*> known = required;
    known.insert(known.end(), optional.begin(), optional.end());
    const std::string nearest = did_you_mean(item.key(), {known.begin(), known.end()});
    fail("unknown key " + in_quotes(item.key()) +
         (nearest.empty() ? " (known: " + word_list(known, "and") + ")" : nearest));
  }
  for (const char* key : required) {
    if (!value_.contains(key)) fail("'" + std::string(key) + "' is missing");
  }
}

Rational JsonReader::number() const { return rational_of(value_, where_); }

Rational3 JsonReader::point() const { return nef::point_of(value_, where_); }

std::size_t JsonReader::word(std::span<const char* const> words) const {
  const auto found = std::find_if(words.begin(), words.end(), [&](const char* word) { return value_ == word; });
  if (found == words.end()) {
    const std::string found_text = value_.is_string() ? value_.get<std::string>() : spelled(value_);
    fail("must be " + word_list(words, "or") + ", not " + in_quotes(found_text));
  }
  return static_cast<std::size_t>(found - words.begin());
}

}  // namespace nef
