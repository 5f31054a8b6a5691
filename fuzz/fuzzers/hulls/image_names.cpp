// SPDX-License-Identifier: Apache-2.0
//
// Folders of images with numbers in their names, in any spelling: views get them in the order of the numbers. The
// oracle knows the numbers, since it made the names of them.
#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "apps/visual_hull/scene/images.h"
#include "fuzz/fuzzer.h"
#include "nef/io/file_bytes.h"
#include "tests/support/temporary_folder.h"

namespace nef::fuzz {
namespace {

namespace fs = std::filesystem;

// A name in parts: words between numbers, and each number with zeros in front.
struct ImageName {
  std::vector<std::uint64_t> numbers;
  std::vector<std::uint32_t> zeros;

  [[nodiscard]] std::string text(const std::vector<std::string>& words) const {
    std::string result = words[0];
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      result += std::string(zeros[i], '0') + std::to_string(numbers[i]) + words[i + 1];
    }
    return result;
  }
};

}  // namespace

void fuzz_image_names(const Case& the_case) {
  Choices& choices = the_case.choices();
  const std::vector<std::string> kWords{"img", "", "_", "view-", "a.b", "\xc3\xa9", " "};
  const std::size_t numbers = 1 + choices.below(3);
  std::vector<std::string> words;
  for (std::size_t i = 0; i <= numbers; ++i) {
    // Words between numbers keep these apart.
    const bool inner = i > 0 && i < numbers;
    words.push_back(inner ? kWords[2 + choices.below(5)] : kWords[choices.below(7)]);
  }
  std::map<std::vector<std::uint64_t>, std::string> by_numbers;  // one spelling each, so that order is no question
  for (std::uint32_t i = 1 + choices.below(30); i > 0; --i) {
    ImageName name;
    for (std::size_t k = 0; k < numbers; ++k) {
      name.numbers.push_back(choices.one_in(8) ? 99999999999999990ULL + choices.below(20) : choices.below(120));
      name.zeros.push_back(choices.one_in(3) ? choices.below(4) : 0);
    }
    by_numbers.emplace(name.numbers, name.text(words) + ".png");
  }
  const test::TemporaryFolder folder;
  std::vector<std::string> wanted;
  for (const auto& [key, name] : by_numbers) {
    wanted.push_back(name);
    the_case.tell(name);
    write_file(folder.file(name), "x");
  }
  nef::visual_hull::Scene scene;
  scene.views.resize(wanted.size());
  Messages notes;
  std::vector<std::string> got;
  for (const fs::path& file : nef::visual_hull::images_of(scene, folder.file(""), std::nullopt, &notes)) {
    got.push_back(file.filename().string());
  }
  Case::require(got == wanted, "order: images are not paired by number");
  const bool plain = std::is_sorted(wanted.begin(), wanted.end());
  Case::require(notes.size() == (plain ? 0U : 1U), "note: one if and only if text order is another");
  the_case.count(plain ? "folders in text order" : "folders in another order");
}

}  // namespace nef::fuzz
