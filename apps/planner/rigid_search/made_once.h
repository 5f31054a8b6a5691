// SPDX-License-Identifier: Apache-2.0
//
// A table of values that are made when they are asked for, on several threads.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>

namespace nef::planner {

/// Values by keys, each made once and then kept where it is. Several threads may ask at once; if they ask for the same
/// value, one makes it, and the others wait.
template <typename Key, typename Value>
class MadeOnce {
 public:
  /// The value of a key, which `make()` returns unless it is there. If that throws, the next one who asks makes it.
  /// While another thread makes it, this one calls `meanwhile()` as long as that returns true.
  template <typename Make>
  Value& at(const Key& key, const Make& make, const std::function<bool()>& meanwhile = {}) {
    Entry& entry = entry_of(key);
    std::unique_lock lock(entry.making, std::try_to_lock);
    while (!lock.owns_lock() && meanwhile && meanwhile()) (void)lock.try_lock();
    if (!lock.owns_lock()) lock.lock();
    if (!entry.value) entry.value = make();
    return *entry.value;
  }

  /// What is known of a value without waiting.
  struct Known {
    const Value* value = nullptr;  ///< null if it is not there
    bool is_being_made = false;
  };
  [[nodiscard]] Known known(const Key& key) {
    Entry& entry = entry_of(key);
    const std::unique_lock lock(entry.making, std::try_to_lock);
    if (!lock.owns_lock()) return {nullptr, true};
    return {entry.value ? &*entry.value : nullptr, false};
  }

 private:
  struct Entry {
    std::mutex making;  // held by the thread that makes the value
    std::optional<Value> value;
  };
  Entry& entry_of(const Key& key) {
    const std::scoped_lock lock(mutex_);
    return entries_[key];
  }

  std::mutex mutex_;  // of the table, not of the values
  std::map<Key, Entry> entries_;
};

}  // namespace nef::planner
