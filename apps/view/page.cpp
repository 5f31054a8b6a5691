// SPDX-License-Identifier: Apache-2.0
#include "apps/view/page.h"

#include "apps/view/page/byte_text.h"
#include "apps/view/page/viewer_bundle.h"
#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"
#include "nef/io/file_bytes.h"

namespace nef::view {
namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

// Replaces the one mark in the page that the bundle leaves for a text.
void fill_in(std::string& page, const std::string& mark, const std::string& text) {
  const std::size_t at = page.find(mark);
  NEF_ASSERT(at != std::string::npos);
  page.replace(at, mark.size(), text);
}

}  // namespace

bool has_viewer_bundle() { return !viewer_bundle().empty(); }

void write_page(const std::vector<Layer>& layers, const std::string& path, const PageOptions& options) {
  if (!has_viewer_bundle()) {
    throw UnsupportedError(
        "pages cannot be written: the viewer bundle was not built because CMake found no node, npm or network; install "
        "the packages nodejs and npm and configure again (cmake -B build), or pass "
        "-DNEF_THREE_TARBALL=three-0.170.0.tgz");
  }
  std::string page(viewer_bundle());
  fill_in(page, "@NEF_SCENE@", base64(deflate(page_scene(layers, options))));
  fill_in(page, "@NEF_TITLE@", escaped(utf8(options.title)));
  write_file(path, page);
}

}  // namespace nef::view
