// SPDX-License-Identifier: Apache-2.0
//
// How Python calls what may take long: without the interpreter's lock, and so that Ctrl-C is answered at once.
//
// Signals reach Python in its main thread only. A call from there runs in a thread of its own while the main one waits
// for it and looks for signals every few milliseconds. If a handler raises, KeyboardInterrupt usually, the call is told
// to stop (nef/base/monitor.h) and its result is thrown away, whenever it comes; the exception goes on at once.
// Operands are immutable and are held by the call, so nothing that Python sees is ever half done. Calls from other
// threads, and small ones, which are over sooner than anybody could interrupt them, run where they are.
#pragma once

#include <pybind11/functional.h>
#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "binding/base/interpreter_lock.h"
#include "nef/base/error.h"
#include "nef/base/monitor.h"

namespace nef::python {

namespace py = pybind11;

/// A call of fewer items than this takes some milliseconds at most.
inline constexpr std::size_t kSmallCall = 2000;

/// Whether signals are handled in the calling thread. Needs the interpreter's lock.
bool in_main_thread();

/// How many calls were told to stop and have not ended yet.
std::atomic<int>& abandoned_calls();

/// Waits some seconds for the abandoned calls to end. For the end of the interpreter; needs its lock.
void wait_for_abandoned_calls();

/// A Python function that is told how far a call has come: function(done, total). Copies share the function; it is
/// called and released with the interpreter's lock held, in whatever thread. An exception in it ends the call and goes
/// on to the caller.
class ProgressFunction {
 public:
  /// None for no progress.
  explicit ProgressFunction(const py::object& function);

  explicit operator bool() const { return function_ != nullptr; }
  /// Calls the function for a call that is watched by `monitor`; throws Interrupted if that was abandoned meanwhile.
  template <typename... Arguments>
  void operator()(const Monitor& monitor, const Arguments&... arguments) const {
    monitor.check_interruption();
    if (!function_) return;
    const LockHeld locked;
    const py::tuple given = py::make_tuple(arguments...);
    owned(outliving_python([&] { return PyObject_Call(function_->ptr(), given.ptr(), nullptr); }));
  }

 private:
  std::shared_ptr<py::object> function_;
};

/// The contextvars.ContextVar that holds what calls are to tell of their progress, from `with nef.progress(...)`; each
/// extension module has one of its own. Needs the interpreter's lock.
py::object progress_variable();

/// What it holds in the current context; empty outside of such blocks. Needs the interpreter's lock.
ProgressFunction progress_of_context();

/// Tells `progress` of a call that `monitor` watches, as long as that lasts; empty if `progress` is.
nef::ProgressFunction told_by(const ProgressFunction& progress, const Monitor& monitor);

namespace detail {

template <typename Result>
struct Job {
  std::mutex mutex;
  std::condition_variable changed;
  bool done = false;
  std::optional<Result> result;
  std::exception_ptr failure;
  std::atomic<bool> stop{false};
};

}  // namespace detail

/// A thread that calls a function. Throws Error where the system has no room for one.
template <typename Function>
std::thread started(Function function) {
  try {
    return std::thread(std::move(function));
  } catch (const std::system_error& failure) {
    throw Error(std::string("no thread could be started (") + failure.what() +
                "); end other work, or raise the limits of processes and memory (ulimit -u, -v)");
  }
}

/// The value of work(monitor), which must not touch anything of Python unless it takes the lock, and must own what it
/// needs. `items` is about the size of the operands.
template <typename Work>
auto call(std::size_t items, Work work) -> decltype(work(Monitor())) {
  using Result = decltype(work(Monitor()));
  using Job = detail::Job<Result>;
  ProgressFunction progress = progress_of_context();
  if (items < kSmallCall || !in_main_thread()) {
    const LockReleased unlocked;
    const nef::ProgressFunction told = told_by(progress, {});
    return work(Monitor().telling(told));
  }
  const auto job = std::make_shared<Job>();
  std::thread worker = started([job, work = std::move(work), progress = std::move(progress)]() mutable {
    std::optional<Result> result;
    std::exception_ptr failure;
    try {
      const Monitor stopped = Monitor().stopped_by(&job->stop);
      const nef::ProgressFunction told = told_by(progress, stopped);
      result.emplace(work(stopped.telling(told)));
    } catch (...) {
      failure = std::current_exception();
    }
    {
      // What the work held goes before anybody hears that it is done.
      const Work ended(std::move(work));
      const ProgressFunction silent(std::move(progress));
    }
    const std::scoped_lock lock(job->mutex);
    job->result = std::move(result);
    job->failure = failure;
    job->done = true;
    job->changed.notify_all();
    if (job->stop) --abandoned_calls();
  });
  constexpr std::chrono::milliseconds kPatience{20};
  for (;;) {
    {
      const LockReleased unlocked;
      std::unique_lock lock(job->mutex);
      if (job->changed.wait_for(lock, kPatience, [&] { return job->done; })) break;
    }
    if (PyErr_CheckSignals() == 0) continue;
    const std::scoped_lock lock(job->mutex);
    if (!job->done) ++abandoned_calls();
    job->stop = true;
    worker.detach();
    throw py::error_already_set();
  }
  {
    const LockReleased unlocked;
    worker.join();
  }
  if (job->failure) std::rethrow_exception(job->failure);
  return std::move(*job->result);
}

}  // namespace nef::python
