// SPDX-License-Identifier: Apache-2.0
#include "apps/nef_mpi/work_folder.h"

#include "nef/io/content_hash.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_parts.h"
#include "nef/tiles/storage/tile_folder.h"

namespace nef::mpi {
namespace fs = std::filesystem;

namespace {

constexpr const char* kJob = "job";

std::string without_slash(std::string path) {
  while (path.size() > 1 && path.ends_with('/')) path.pop_back();
  return path;
}

}  // namespace

WorkFolder::WorkFolder(const std::string& output) : path_(without_slash(output) + ".work") {}

void WorkFolder::prepare(const std::string& job) const {
  std::error_code error;
  if (fs::exists(path_ / kJob, error) && read_file((path_ / kJob).string()) == job) return;
  // Only what is known to be such a folder is removed.
  const bool foreign = fs::exists(path_, error) && !fs::exists(path_ / kJob, error) && !fs::is_empty(path_, error);
  if (!foreign) fs::remove_all(path_, error);
  fs::create_directories(path_, error);
  if (foreign || error) {
    throw FileError(
        FileProblem::kUnreadable,
        path_.string() + ": the work folder cannot be created; remove what is there, or name another output");
  }
  write_file((path_ / kJob).string(), job);
}

void WorkFolder::remove(const std::string& name) const {
  std::error_code ignored;
  fs::remove(path_ / name, ignored);
}

void WorkFolder::remove() const {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string file_identity(const std::string& path) {
  // The index of a folder of tiles names each of them by a hash of its bytes.
  const std::string bytes_in =
      names_tile_folder(path) ? (fs::path(path) / kTileFolderIndex).string() : part_path(path).file;
  return path + " " + content_hash_of_file(bytes_in) + "\n";
}

}  // namespace nef::mpi
