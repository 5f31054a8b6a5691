// SPDX-License-Identifier: Apache-2.0
//
// A list of the tiles in memory, the last used first, under one lock. When they take more than the bound, the last one
// is written to a file and dropped. Files are written and read without the lock: a tile that is being written keeps its
// set for those that ask meanwhile. The folder of a run is locked (flock) while the run is alive, so that folders that
// killed runs left can be told and removed.
#include "nef/tiles/storage/tile_store.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <utility>

#include "nef/io/content_hash.h"
#include "nef/io/file_bytes.h"
#include "nef/io/native/native_binary.h"

namespace nef {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolderPrefix = ".nef-tiles-";
constexpr const char* kAliveFile = "alive";
constexpr const char* kExtension = ".nef";
constexpr std::size_t kDigits = 32;

std::string hash_part(const fs::path& path) { return path.filename().string().substr(0, kDigits); }

// A descriptor that holds the lock of a folder, or -1 if somebody else does or it cannot be had.
int lock_folder(const fs::path& folder) {
  const int descriptor = open((folder / kAliveFile).c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
  if (descriptor >= 0 && flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  if (descriptor >= 0) close(descriptor);
  return -1;
}

// Folders whose runs have ended without a chance to remove them. Younger ones may not be locked yet.
void remove_folders_of_dead(const fs::path& parent) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(parent, error)) {
    if (!entry.path().filename().string().starts_with(kFolderPrefix)) continue;
    if (!fs::exists(entry.path() / kAliveFile, error)) continue;
    const int descriptor = lock_folder(entry.path());
    if (descriptor < 0) continue;
    fs::remove_all(entry.path(), error);
    close(descriptor);
  }
}

}  // namespace

TileFile::~TileFile() {
  std::error_code ignored;
  if (temporary_) fs::remove(path_, ignored);
}

std::string TileFile::name() const { return hash_part(path_) + kExtension; }

std::string tile_file_name(std::string_view bytes) { return content_hash(bytes) + kExtension; }

Polyhedron read_tile(const fs::path& path, const Monitor& monitor) {
  const std::string bytes = read_file(path.string());
  if (tile_file_name(bytes) != hash_part(path) + kExtension) {
    throw FileError(
        FileProblem::kSyntax,
        path.string() +
            ": the tile does not match its name; it was damaged or replaced: write the set again from its source");
  }
  return read_native_binary(bytes, path.string(), NativeContents::kTile, monitor);
}

class TileStore::Tile final : public StoredTile, public std::enable_shared_from_this<Tile> {
 public:
  explicit Tile(std::shared_ptr<TileStore> keeper) : store(std::move(keeper)) {}
  ~Tile() override { store->forget(*this); }

  [[nodiscard]] Polyhedron load() const override { return store->load(*this); }
  [[nodiscard]] std::shared_ptr<const TileFile> file() const override { return store->file_of(*this); }

  const std::shared_ptr<TileStore> store;
  // Under the store's lock. At least one of set and file is there.
  mutable Polyhedron set;
  mutable std::size_t bytes = 0;  // of the set; 0 if it is not in memory
  mutable std::shared_ptr<const TileFile> known_file;
  mutable std::list<const Tile*>::iterator place;  // among those in memory
  mutable bool listed = false;                     // it has such a place
};

TileStore::TileStore(fs::path folder, std::uint64_t memory)
    : parent_(folder.empty() ? fs::path(".") : std::move(folder)), memory_(memory) {}

TileStore::~TileStore() {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
  if (folder_lock_ >= 0) close(folder_lock_);
}

std::shared_ptr<const StoredTile> TileStore::keep(Polyhedron set) {
  auto tile = std::make_shared<const Tile>(shared_from_this());
  {
    const Lock lock(mutex_);
    settle(*tile, std::move(set));
  }
  make_room();
  return tile;
}

std::shared_ptr<const StoredTile> TileStore::keep_file(const fs::path& path) {
  auto tile = std::make_shared<const Tile>(shared_from_this());
  const Lock lock(mutex_);
  std::weak_ptr<const TileFile>& known = files_[path.string()];
  tile->known_file = known.lock();
  if (!tile->known_file) known = tile->known_file = std::make_shared<const TileFile>(path, false);
  return tile;
}

bool TileStore::uses(const fs::path& path) const {
  const Lock lock(mutex_);
  const auto at = files_.find(path.string());
  return at != files_.end() && !at->second.expired();
}

TileStore::Counts TileStore::counts() const {
  const Lock lock(mutex_);
  return counts_;
}

Polyhedron TileStore::load(const Tile& tile) {
  std::shared_ptr<const TileFile> file;
  {
    const Lock lock(mutex_);
    if (tile.bytes != 0) {
      touch(tile);
      return tile.set;
    }
    file = tile.known_file;
  }
  Polyhedron set = read_tile(file->path(), {});
  {
    const Lock lock(mutex_);
    ++counts_.read;
    if (tile.bytes != 0) return tile.set;  // another thread was faster
    settle(tile, set);
  }
  make_room();
  return set;
}

std::shared_ptr<const TileFile> TileStore::file_of(const Tile& tile) {
  Polyhedron set;
  {
    const Lock lock(mutex_);
    if (tile.known_file) return tile.known_file;
    set = tile.set;
  }
  std::shared_ptr<const TileFile> file = write(set);
  const Lock lock(mutex_);
  return tile.known_file = std::move(file);
}

void TileStore::forget(const Tile& tile) {
  const Lock lock(mutex_);
  unlist(tile);
  counts_.bytes -= tile.bytes;
}

void TileStore::touch(const Tile& tile) {
  if (tile.listed) in_memory_.splice(in_memory_.begin(), in_memory_, tile.place);
}

void TileStore::unlist(const Tile& tile) {
  if (tile.listed) in_memory_.erase(tile.place);
  tile.listed = false;
}

void TileStore::settle(const Tile& tile, Polyhedron set) {
  tile.bytes = set.complex().bytes();
  tile.set = std::move(set);
  counts_.bytes += tile.bytes;
  tile.place = in_memory_.insert(in_memory_.begin(), &tile);
  tile.listed = true;
}

// The lock is not held while a tile is written: it has no place then, so that no other thread takes it, but its set
// stays for whoever asks.
void TileStore::make_room() {
  while (true) {
    std::shared_ptr<const Tile> tile;
    {
      const Lock lock(mutex_);
      if (counts_.bytes <= memory_ || in_memory_.size() < 2) return;
      const Tile& last = *in_memory_.back();
      unlist(last);
      tile = last.weak_from_this().lock();  // nothing if its last owner is about to forget it
    }
    if (!tile) continue;
    try {
      file_of(*tile);
    } catch (...) {
      const Lock lock(mutex_);
      tile->place = in_memory_.insert(in_memory_.end(), tile.get());
      tile->listed = true;
      throw;
    }
    Polyhedron dropped;  // outlives the lock
    const Lock lock(mutex_);
    counts_.bytes -= std::exchange(tile->bytes, 0);
    std::swap(dropped, tile->set);
  }
}

// It gets its name when it is locked, so that nobody takes it for one that was left.
const fs::path& TileStore::own_folder() {
  if (!folder_.empty()) return folder_;
  remove_folders_of_dead(parent_);
  std::string name = (parent_ / ".nef-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw FileError(FileProblem::kUnreadable,
                    parent_.string() + ": the folder for tiles cannot be created; check free space and permissions");
  }
  folder_ = name;
  folder_lock_ = lock_folder(folder_);
  const fs::path known = parent_ / (kFolderPrefix + name.substr(name.size() - 6));
  std::error_code error;
  fs::rename(folder_, known, error);  // fails if the name is taken, since that folder is not empty
  if (!error) folder_ = known;
  return folder_;
}

std::shared_ptr<const TileFile> TileStore::write(const Polyhedron& set) {
  const std::string bytes = native_binary(set);
  fs::path path;
  {
    // Each file is its own, even where tiles are equal: a name that is being removed is never written again.
    const Lock lock(mutex_);
    path = own_folder() / (hash_part(tile_file_name(bytes)) + "-" + std::to_string(next_number_++) + kExtension);
  }
  write_file(path.string(), bytes);
  const Lock lock(mutex_);
  ++counts_.written;
  return std::make_shared<const TileFile>(path, true);
}

}  // namespace nef
