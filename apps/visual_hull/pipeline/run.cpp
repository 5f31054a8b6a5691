// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/pipeline/run.h"

#include <atomic>

#include "nef/base/threads/parallel.h"

namespace nef::visual_hull {
namespace {

std::string step(Phase phase, const std::string& view) {
  return view.empty() ? phase_name(phase) : phase_name(phase) + (" " + view);
}

}  // namespace

Run::Run(const Options& its_options, const nef::Monitor& monitor)
    : options(its_options), show([monitor](const char* phase, std::size_t done, std::size_t total) {
        monitor.tell_progress(phase, done, total);
      }) {}

void Run::tell(Phase phase, const std::string& view, std::size_t done, std::size_t total) const {
  show(step(phase, view).c_str(), done, total);
}

void Run::each_view(Phase phase, const Views& views, const nef::Monitor& monitor,
                    const std::function<void(std::size_t, const nef::Monitor& own)>& body) const {
  std::atomic<std::size_t> begun = 0;
  nef::parallel_for(views.size(), monitor.telling(show), [&](std::size_t i, const nef::Monitor& own) {
    own.tell_progress(step(phase, views[i].name).c_str(), begun++, views.size());
    body(i, own.quiet());
  });
}

}  // namespace nef::visual_hull
