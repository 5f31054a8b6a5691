// SPDX-License-Identifier: Apache-2.0
//
// Tiles in files: sets that are larger than memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

#include "nef/base/monitor.h"
#include "nef/polyhedron.h"

namespace nef {

/// The complex of a tile in binary .nef form, in a file whose name begins with a hash of its bytes. Immutable; a
/// temporary file is removed with the last tile that refers to it.
class TileFile {
 public:
  TileFile(std::filesystem::path path, bool temporary) : path_(std::move(path)), temporary_(temporary) {}
  TileFile(const TileFile&) = delete;
  TileFile& operator=(const TileFile&) = delete;
  ~TileFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// tile_file_name of its bytes. The file itself may have a number after the digits.
  [[nodiscard]] std::string name() const;

 private:
  std::filesystem::path path_;
  bool temporary_;
};

/// The name of a tile file with these bytes: 32 hexadecimal digits of their XXH3 and ".nef".
std::string tile_file_name(std::string_view bytes);

/// Reads one. Throws FileError if its bytes are not those of its name.
Polyhedron read_tile(const std::filesystem::path& path, const Monitor& monitor);

/// A set that a store keeps: in memory while it is used, in a file when memory runs short. It keeps its store alive.
/// May be used by several threads at once.
class StoredTile {
 public:
  StoredTile() = default;
  StoredTile(const StoredTile&) = delete;
  StoredTile& operator=(const StoredTile&) = delete;
  virtual ~StoredTile() = default;

  /// The set; read from its file if it is not in memory. Throws FileError if that is gone or damaged.
  [[nodiscard]] virtual Polyhedron load() const = 0;

  /// Its file, which is written if there is none yet. Throws FileError.
  [[nodiscard]] virtual std::shared_ptr<const TileFile> file() const = 0;
};

/// Keeps sets within a number of bytes; what was used longest ago goes to files. Must be held by a shared_ptr; the sets
/// keep their store alive. Sets that somebody is working with, and what belongs to them besides their complexes
/// (structures for point location), come on top. May be used by several threads at once.
class TileStore : public std::enable_shared_from_this<TileStore> {
 public:
  /// `memory`: bytes of complexes that stay in memory. Files of this run go to a folder of their own below `folder`,
  /// which is made when it is needed and removed with the store; what killed runs left there is removed first.
  TileStore(std::filesystem::path folder, std::uint64_t memory);
  TileStore(const TileStore&) = delete;
  TileStore& operator=(const TileStore&) = delete;
  ~TileStore();

  /// Takes a set over. Throws FileError if another one has to go to a file which cannot be written.
  std::shared_ptr<const StoredTile> keep(Polyhedron set);
  /// A set that is in a file already, under the name that tile_file_name gave; it is read when it is needed.
  std::shared_ptr<const StoredTile> keep_file(const std::filesystem::path& path);

  /// True if a set refers to this file.
  [[nodiscard]] bool uses(const std::filesystem::path& path) const;

  struct Counts {
    std::uint64_t bytes = 0;    ///< of complexes in memory now
    std::uint64_t written = 0;  ///< files so far
    std::uint64_t read = 0;     ///< files so far, each as often as it was read
  };
  [[nodiscard]] Counts counts() const;

 private:
  class Tile;  // what StoredTile is here
  using Lock = std::unique_lock<std::mutex>;

  Polyhedron load(const Tile& tile);
  std::shared_ptr<const TileFile> file_of(const Tile& tile);
  void forget(const Tile& tile);
  void touch(const Tile& tile);  // under the lock, as are the three below
  void unlist(const Tile& tile);
  void settle(const Tile& tile, Polyhedron set);
  [[nodiscard]] const std::filesystem::path& own_folder();
  void make_room();
  std::shared_ptr<const TileFile> write(const Polyhedron& set);

  mutable std::mutex mutex_;
  std::filesystem::path parent_;
  std::filesystem::path folder_;  // empty until it is needed
  int folder_lock_ = -1;          // tells others that this run is alive
  std::uint64_t memory_;
  Counts counts_;
  std::uint64_t next_number_ = 0;                                         // of the files of this run
  std::list<const Tile*> in_memory_;                                      // the last used first
  std::unordered_map<std::string, std::weak_ptr<const TileFile>> files_;  // of others, by path
};

}  // namespace nef
