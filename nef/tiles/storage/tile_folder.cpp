// SPDX-License-Identifier: Apache-2.0
//
// Writing: each tile goes to a file that is named by its content, so a tile that is there is not written again (a file
// of the store is linked); then the index is written and renamed into place; then files that it does not name are
// removed. Reading checks the hash of the index, builds the tree by recursion, and leaves tiles to the store.
#include "nef/tiles/storage/tile_folder.h"

#include <unistd.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "nef/io/file_bytes.h"
#include "nef/io/native/native_binary.h"
#include "nef/io/polyhedron_file.h"
#include "nef/io/text_cursor.h"
#include "nef/tiles/tile_tree.h"

namespace nef {
namespace {

namespace fs = std::filesystem;
using Kind = TileNode::Kind;

constexpr std::int64_t kVersion = 1;
constexpr std::string_view kAxes = "xyz";

std::string hash_of(std::string_view bytes) {
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx",
                static_cast<unsigned long long>(XXH3_64bits(bytes.data(), bytes.size())));
  return digits.data();
}

bool is_tile_name(std::string_view name) {
  constexpr std::size_t kDigits = 32;
  return name.size() == kDigits + 4 && name.ends_with(".nef") && name.find_first_not_of("0123456789abcdef") == kDigits;
}

class FolderWriter {
 public:
  explicit FolderWriter(fs::path folder) : folder_(std::move(folder)) {}

  void write(const TiledPolyhedron& set) {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (!fs::is_directory(folder_, error)) {
      throw FileError(
          FileProblem::kUnreadable,
          folder_.string() + ": the folder for tiles cannot be created; give another name, or remove what is there");
    }
    index_ = "nef-tiles " + std::to_string(kVersion) + "\nlimit " + std::to_string(set.tiling().limit) + "\n";
    add(set.tree());
    index_ += "end " + hash_of(index_) + "\n";
    write_file((folder_ / kTileFolderIndex).string(), index_);
    remove_others(set.tiling().store.get());
  }

 private:
  void add(const TileRef& tree) {
    const TileNode& node = *tree.node;
    const char* negation = tree.complemented ? " not" : "";
    if (node.kind == Kind::kUniform) {
      index_ += "uniform " + std::to_string(node.mark) + "\n";
    } else if (node.kind == Kind::kTile) {
      const std::string name = write_tile(node);
      index_ += std::string("tile") + negation + " " + name + " " + std::to_string(node.vertices);
      for (const std::array<double, 3>& corner : {node.box.low, node.box.high}) {
        for (const double x : corner) index_ += " " + hexadecimal(x);
      }
      index_ += "\n";
      names_.insert(name);
    } else {
      index_ += std::string("cut") + negation + " " + kAxes[node.plane.axis] + " " + node.plane.at.get_str() + "\n";
      add(node.low);
      add(node.high);
    }
  }

  static std::string hexadecimal(double x) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%a", x);
    return text.data();
  }

  // A file of the store is linked, if it is on the same file system.
  std::string write_tile(const TileNode& node) {
    if (!node.stored) {
      const std::string bytes = native_binary(node.in_memory);
      std::string name = tile_file_name(bytes);
      if (std::error_code unknown; !fs::exists(folder_ / name, unknown)) write_file((folder_ / name).string(), bytes);
      return name;
    }
    const std::shared_ptr<const TileFile> file = node.stored->file();
    const fs::path target = folder_ / file->name();
    std::error_code error;
    if (fs::exists(target, error)) return file->name();
    fs::create_hard_link(file->path(), target, error);
    if (error && !fs::exists(target, error)) write_file(target.string(), read_file(file->path().string()));
    return file->name();
  }

  void remove_others(const TileStore* store) const {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
      const std::string name = entry.path().filename().string();
      if (!is_tile_name(name) || names_.contains(name)) continue;
      if (store == nullptr || !store->uses(entry.path())) fs::remove(entry.path(), error);
    }
  }

  fs::path folder_;
  std::string index_;
  std::set<std::string> names_;
};

class FolderReader {
 public:
  FolderReader(fs::path folder, Tiling tiling, const Monitor& monitor)
      : folder_(std::move(folder)),
        path_((folder_ / kTileFolderIndex).string()),
        bytes_(read_file(path_)),
        cursor_(bytes_, path_),
        tiling_(std::move(tiling)),
        monitor_(monitor) {}

  TiledPolyhedron read() {
    check_hash();
    expect("nef-tiles");
    if (cursor_.integer("version") != kVersion) {
      cursor_.fail(FileProblem::kUnsupported, "a version of the format that is newer than this program; update it");
    }
    expect("limit");
    const std::int64_t limit = cursor_.integer("limit");
    if (limit < 1) cursor_.fail(FileProblem::kSyntax, "a tile must be allowed a vertex");
    tiling_.limit = static_cast<std::size_t>(limit);
    TileRef root = subtree(0);
    expect("end");
    return {std::move(root), tiling_};
  }

 private:
  void check_hash() const {
    const std::size_t end = bytes_.rfind("end ");
    if (end == std::string::npos || end == 0 || bytes_[end - 1] != '\n') {
      cursor_.fail(FileProblem::kTruncated,
                   "the index of the tiles ends too early; write the set again from its source");
    }
    if (bytes_.substr(end) != "end " + hash_of(std::string_view(bytes_).substr(0, end)) + "\n") {
      cursor_.fail(FileProblem::kSyntax, "the index of the tiles was damaged; write the set again from its source");
    }
  }

  void expect(std::string_view wanted) {
    const std::string_view word = cursor_.word();
    if (word != wanted) {
      cursor_.fail(FileProblem::kSyntax,
                   "expected '" + std::string(wanted) + "', not " + in_quotes(word) + "; write the set again");
    }
  }

  TileRef subtree(std::size_t depth) {
    constexpr std::size_t kDeepest = 1000;  // trees of millions of tiles have some 50 levels
    if (depth > kDeepest) cursor_.fail(FileProblem::kUnsupported, "more than 1000 cuts below each other");
    const std::string kind(cursor_.word());
    if (kind == "uniform") return uniform_leaf(static_cast<LabelId>(integer_up_to(1, "mark")));
    if (kind != "cut" && kind != "tile") {
      cursor_.fail(FileProblem::kSyntax, "expected cut, tile or uniform, not " + in_quotes(kind));
    }
    std::string_view word = cursor_.word_in_line();
    const bool complemented = word == "not";
    if (complemented) word = cursor_.word_in_line();
    const TileRef tree = kind == "cut" ? cut(word, depth) : tile(std::string(word));
    return complemented ? tree.complement() : tree;
  }

  TileRef cut(std::string_view axis, std::size_t depth) {
    const std::size_t i = axis.size() == 1 ? kAxes.find(axis[0]) : std::string_view::npos;
    if (i == std::string_view::npos) cursor_.fail(FileProblem::kSyntax, "a cut is at x, y or z");
    Rational at;
    cursor_.number(at, "cut", 0, {});
    const AxisPlane plane(i, at);
    TileRef low = subtree(depth + 1);
    return cut_node(plane, std::move(low), subtree(depth + 1));
  }

  TileRef tile(const std::string& name) {
    if (!is_tile_name(name)) cursor_.fail(FileProblem::kSyntax, in_quotes(name) + " is not the name of a tile");
    TileNode node;
    node.kind = Kind::kTile;
    node.tiles = 1;
    node.vertices = static_cast<std::size_t>(cursor_.integer("number of vertices"));
    for (std::array<double, 3>* corner : {&node.box.low, &node.box.high}) {
      for (double& x : *corner) x = hexadecimal(cursor_.word_in_line());
    }
    const fs::path file = folder_ / name;
    if (std::error_code unknown; !fs::exists(file, unknown)) {
      cursor_.fail(FileProblem::kUnreadable,
                   "the tile " + name + " is missing; if the set is being written, read it again");
    }
    if (tiling_.store) {
      node.stored = tiling_.store->keep_file(file);
    } else {
      node.in_memory = read_tile(file, monitor_);
    }
    return {std::make_shared<const TileNode>(std::move(node)), false};
  }

  // As %a writes it.
  [[nodiscard]] double hexadecimal(std::string_view word) const {
    const bool negative = word.starts_with('-');
    std::string_view digits = word.substr(negative ? 1 : 0);
    double value = 0;
    std::from_chars_result end{};
    if (digits.starts_with("0x")) {
      digits.remove_prefix(2);
      end = std::from_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::hex);
    } else {
      end = std::from_chars(digits.data(), digits.data() + digits.size(), value);  // inf
    }
    if (end.ec != std::errc() || end.ptr != digits.data() + digits.size()) {
      cursor_.fail(FileProblem::kNotANumber, in_quotes(word) + " is not a side of a box");
    }
    return negative ? -value : value;
  }

  std::int64_t integer_up_to(std::int64_t most, std::string_view what) {
    const std::int64_t value = cursor_.integer(what);
    if (value < 0 || value > most) cursor_.fail(FileProblem::kSyntax, "no such " + std::string(what));
    return value;
  }

  fs::path folder_;
  std::string path_;
  std::string bytes_;
  TextCursor cursor_;
  Tiling tiling_;
  Monitor monitor_;
};

}  // namespace

bool names_tile_folder(const std::string& path) {
  const std::string plain = path.ends_with('/') ? path.substr(0, path.size() - 1) : path;
  return lower_extension(plain) == kTileFolderExtension;
}

void write_tiles(const std::string& folder, const TiledPolyhedron& set) { FolderWriter(folder).write(set); }

TiledPolyhedron read_tiles(const std::string& folder, std::shared_ptr<TileStore> store, const Monitor& monitor) {
  return FolderReader(folder, {.store = std::move(store)}, monitor).read();
}

Polyhedron read_file_or_tiles(const std::string& path, const MeshOptions& options, Messages* messages) {
  if (!names_tile_folder(path)) return read_polyhedron(path, options, messages);
  return read_tiles(path, nullptr, options.monitor).polyhedron(options.monitor);
}

}  // namespace nef
