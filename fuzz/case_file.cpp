// SPDX-License-Identifier: Apache-2.0
#include "fuzz/case_file.h"

#include <sstream>

#include "nef/base/error.h"

namespace nef::fuzz {

std::string case_text(const Finding& finding) {
  std::ostringstream out;
  out << "fuzz 1\n# " << finding.complaint << "\n";
  std::istringstream story(finding.story);
  for (std::string line; std::getline(story, line);) out << "#   " << line << "\n";
  out << "fuzzer " << finding.fuzzer << "\nchoices";
  for (const std::uint32_t choice : finding.choices) out << ' ' << choice;
  out << "\n";
  return out.str();
}

Finding read_case(const std::string& text, const std::string& path) {
  std::istringstream in(text);
  std::string line;
  Finding finding;
  if (!std::getline(in, line) || line != "fuzz 1") throw InputError(path + ":1: not a case of fuzz (want: fuzz 1)");
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "fuzzer") words >> finding.fuzzer;
    if (key == "choices") {
      for (std::uint32_t choice = 0; words >> choice;) finding.choices.push_back(choice);
    }
  }
  if (finding.fuzzer.empty()) throw InputError(path + ": no line 'fuzzer NAME'");
  return finding;
}

}  // namespace nef::fuzz
