// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/pages/page_table.h"

#include <algorithm>

#include "nef/base/error.h"

namespace nef::studio {

// Forgets the page that nobody used for the longest time, if there are too many.
PageTable::Page& PageTable::page_of(const std::string& name) {
  Page& page = pages_[name];
  page.used = ++clock_;
  if (pages_.size() > kMostPages) {
    auto oldest = pages_.end();
    for (auto at = pages_.begin(); at != pages_.end(); ++at) {
      if (!at->second.running && (oldest == pages_.end() || at->second.used < oldest->second.used)) oldest = at;
    }
    if (oldest != pages_.end() && oldest->first != name) pages_.erase(oldest);
  }
  return page;
}

void PageTable::compute(const std::string& name, const std::function<std::optional<Sets>(const Monitor&)>& work) {
  const auto computation = std::make_shared<Computation>(limits_);
  {
    std::unique_lock lock(mutex_);
    const std::uint64_t number = ++page_of(name).wanted;
    if (pages_[name].running) pages_[name].running->cancel();
    ended_.wait(lock, [&] { return closed_ || pages_[name].wanted != number || !pages_[name].running; });
    if (closed_ || pages_[name].wanted != number) throw Cancelled();
    if (computing_ >= kMostComputations) {
      throw Error("other pages compute already, " + std::to_string(kMostComputations) + " at once; wait or cancel one");
    }
    ++computing_;
    pages_[name].running = computation;
  }
  std::optional<Sets> sets;
  const auto end = [&] {
    const std::lock_guard lock(mutex_);
    Page& page = page_of(name);
    page.running.reset();
    if (sets) page.sets.swap(*sets);
    --computing_;
    ended_.notify_all();
  };
  try {
    computation->run(threads_, [&](const Monitor& monitor) { sets = work(monitor); });
  } catch (...) {
    end();
    throw;
  }
  end();
}

void PageTable::cancel(const std::string& name) {
  const std::lock_guard lock(mutex_);
  const auto found = pages_.find(name);
  if (found != pages_.end() && found->second.running) found->second.running->cancel();
}

void PageTable::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  for (auto& [name, page] : pages_) {
    if (page.running) page.running->cancel();
  }
  ended_.notify_all();
}

std::optional<Computation::Progress> PageTable::progress(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = pages_.find(name);
  if (found == pages_.end() || !found->second.running) return std::nullopt;
  return found->second.running->progress();
}

KeptSet PageTable::set(const std::string& name, const std::string& set) const {
  const std::lock_guard lock(mutex_);
  const auto page = pages_.find(name);
  if (page != pages_.end()) {
    if (const auto found = page->second.sets.find(set); found != page->second.sets.end()) return found->second;
  }
  throw InputError("there is no result '" + set + "' yet: compute it first");
}

void PageTable::keep_drawn(const std::string& name, std::uint64_t scene, std::vector<Polyhedron> sources) {
  const std::lock_guard lock(mutex_);
  Page& page = page_of(name);
  page.scene = scene;
  page.drawn.swap(sources);
}

Polyhedron PageTable::drawn(const std::string& name, std::uint64_t scene, std::size_t layer) const {
  const std::lock_guard lock(mutex_);
  const auto page = pages_.find(name);
  if (page == pages_.end() || page->second.scene != scene || layer >= page->second.drawn.size()) {
    throw InputError("the page shows another scene by now");
  }
  return page->second.drawn[layer];
}

}  // namespace nef::studio
