// SPDX-License-Identifier: Apache-2.0
//
// Files of every format, written by the suite and then damaged. A reader either refuses with one line or makes
// something that keeps all promises of its type.
#include "fuzz/formats.h"
#include "fuzz/grid.h"
#include "fuzz/mutation.h"
#include "nef/base/error.h"

namespace nef::fuzz {
namespace {

// Bytes as they can stand in a comment.
std::string printable(const std::string& text) {
  static constexpr std::string_view kDigits = "0123456789abcdef";
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\n' || (byte >= 0x20 && byte < 0x7f)) {
      result += c;
    } else {
      result += std::string("\\x") + kDigits[byte >> 4U] + kDigits[byte & 15U];
    }
  }
  return result;
}

}  // namespace

void fuzz_files(const Case& the_case) {
  Choices& choices = the_case.choices();
  const Format& format = formats()[choices.below(static_cast<std::uint32_t>(formats().size()))];
  const GridPolyhedron set = random_grid_set(choices, 3, false);
  const std::string text = mutated(choices, format.write(set.set, set.text));
  the_case.tell(format.name);
  the_case.tell(printable(text));
  the_case.count(std::string(format.name));
  try {
    format.read(text);
    the_case.count("accepted");
  } catch (const Error& error) {
    the_case.count("refused");
    const std::string_view message = error.what();
    Case::require(!message.empty() && message.find('\n') == std::string_view::npos, "message: not one line");
    Case::require(message.size() < 600, "message: of " + std::to_string(message.size()) + " characters");
  }
}

}  // namespace nef::fuzz
