// SPDX-License-Identifier: Apache-2.0
//
// What was made of files and took long, kept for the keys that were used last.
#pragma once

#include <algorithm>
#include <cstddef>
#include <list>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "apps/studio/caches/file_state.h"

namespace nef::studio {

/// The values of the last used keys, `most` of them, as long as the files that they were made of stay as they are. Any
/// number of threads may call it; values are copied. O(most) and a look at each file.
template <typename Key, typename Value>
class RecentlyUsed {
 public:
  explicit RecentlyUsed(std::size_t most) : most_(most) {}

  /// The value of a key, which is the last used one then; nothing if it is not kept or a file has changed.
  std::optional<Value> find(const Key& key) {
    const std::lock_guard lock(mutex_);
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&key](const Entry& entry) { return entry.key == key; });
    if (found == entries_.end() || !still_hold(found->files)) return std::nullopt;
    entries_.splice(entries_.begin(), entries_, found);
    return found->value;
  }

  /// Keeps a value, in place of the one that the key has, with the states of its files before they were read.
  void keep(Key key, std::vector<FileState> files, Value value) {
    const std::lock_guard lock(mutex_);
    std::erase_if(entries_, [&key](const Entry& entry) { return entry.key == key; });
    entries_.push_front({std::move(key), std::move(files), std::move(value)});
    if (entries_.size() > most_) entries_.pop_back();
  }

 private:
  struct Entry {
    Key key;
    std::vector<FileState> files;
    Value value;
  };

  std::size_t most_;
  std::mutex mutex_;
  std::list<Entry> entries_;  // the last used one first
};

}  // namespace nef::studio
