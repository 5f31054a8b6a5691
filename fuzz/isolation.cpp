// SPDX-License-Identifier: Apache-2.0
#include "fuzz/isolation.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>

#include "nef/base/timing/stopwatch.h"

namespace nef::fuzz {

// Lives in memory that parent and child share, so it survives the child.
struct SharedNotes {
  static constexpr std::size_t kChoices = 1U << 18U;
  static constexpr std::size_t kStory = 1U << 18U;
  static constexpr std::size_t kCounters = 96;

  struct Counter {
    char what[56];
    std::uint64_t times;
  };

  std::uint64_t cases;
  double slowest;  // CPU seconds
  std::uint32_t choice_count;
  std::uint32_t story_length;
  bool failed;
  char complaint[2048];
  Counter counters[kCounters];
  std::uint32_t choices[kChoices];
  char story[kStory];
};

namespace {

constexpr int kExitFailed = 3;

template <std::size_t kSize>
void copy_text(char (&to)[kSize], std::string_view from) {
  const std::size_t length = std::min(from.size(), kSize - 1);
  std::memcpy(to, from.data(), length);
  to[length] = '\0';
}

class SharedJournal : public Journal {
 public:
  explicit SharedJournal(SharedNotes& notes) : notes_(notes) {}
  void tell(std::string_view line) override {
    const std::size_t room = SharedNotes::kStory - notes_.story_length;
    if (line.size() + 1 > room) return;
    std::memcpy(notes_.story + notes_.story_length, line.data(), line.size());
    notes_.story[notes_.story_length + line.size()] = '\n';
    notes_.story_length += static_cast<std::uint32_t>(line.size() + 1);
  }
  void count(std::string_view what, std::uint64_t times) override {
    for (SharedNotes::Counter& counter : notes_.counters) {
      if (counter.what[0] == '\0') copy_text(counter.what, what);
      if (what.substr(0, sizeof counter.what - 1) != counter.what) continue;
      counter.times += times;
      return;
    }
  }

 private:
  SharedNotes& notes_;
};

// After so much CPU time the process ends by a signal.
void set_alarm(unsigned seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = seconds;
  setitimer(ITIMER_PROF, &timer, nullptr);
}

bool run_one(const Fuzzer& fuzzer, Choices choices, SharedNotes& notes) {
  notes.choice_count = 0;
  notes.story_length = 0;
  choices.on_draw([&notes](std::uint32_t value) {
    if (notes.choice_count < SharedNotes::kChoices) notes.choices[notes.choice_count++] = value;
  });
  SharedJournal journal(notes);
  set_alarm(fuzzer.seconds_a_case);
  const ProcessStopwatch watch;
  std::string complaint;
  try {
    fuzzer.run(Case(choices, journal));
  } catch (const Failure& failure) {
    complaint = failure.what();
  } catch (const std::exception& error) {
    complaint = std::string("unexpected exception: ") + error.what();
  }
  ++notes.cases;
  notes.slowest = std::max(notes.slowest, watch.seconds());
  if (complaint.empty()) return true;
  std::replace(complaint.begin(), complaint.end(), '\n', ' ');
  copy_text(notes.complaint, complaint);
  notes.failed = true;
  return false;
}

void limit_resources() {
  rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
#ifndef NEF_SANITIZED
  const rlimit memory{std::size_t{4} << 30U, std::size_t{4} << 30U};
  setrlimit(RLIMIT_AS, &memory);
#endif
}

SharedNotes* new_notes() {
  void* memory = mmap(nullptr, sizeof(SharedNotes), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  return new (memory) SharedNotes();
}

template <typename Work>
pid_t in_child(const Work& work) {
  std::fflush(nullptr);
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error("fork failed");
  if (pid > 0) return pid;
  limit_resources();
  const bool passed = work();
  std::fflush(nullptr);
  _exit(passed ? 0 : kExitFailed);
}

std::string end_of(int status, const Fuzzer& fuzzer) {
  if (WIFSIGNALED(status)) {
    if (WTERMSIG(status) == SIGPROF) {
      return "hang: more than " + std::to_string(fuzzer.seconds_a_case) + " s of CPU";
    }
    return std::string("crash: ") + strsignal(WTERMSIG(status));
  }
  return "crash: exit code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

Worker::Worker(const Fuzzer& fuzzer, std::uint64_t seed, std::uint64_t first, double seconds, std::uint64_t most)
    : fuzzer_(fuzzer), notes_(new_notes()) {
  pid_ = in_child([&] {
    using Clock = std::chrono::steady_clock;
    const std::chrono::time_point end = Clock::now() + std::chrono::duration<double>(seconds);
    for (std::uint64_t i = 0; i < most && (i == 0 || Clock::now() < end); ++i) {
      if (!run_one(fuzzer, Choices(mixed(seed, first + i)), *notes_)) return false;
    }
    return true;
  });
}

Worker::Worker(const Fuzzer& fuzzer, const std::vector<std::uint32_t>& choices) : fuzzer_(fuzzer), notes_(new_notes()) {
  pid_ = in_child([&] { return run_one(fuzzer, Choices(choices), *notes_); });
}

Worker::~Worker() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  munmap(notes_, sizeof(SharedNotes));
}

std::optional<Finding> Worker::wait() {
  int status = 0;
  waitpid(pid_, &status, 0);
  return ended(status);
}

std::optional<Finding> Worker::ended(int status) {
  pid_ = -1;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return std::nullopt;
  Finding finding;
  finding.fuzzer = fuzzer_.name;
  finding.complaint = notes_->failed ? notes_->complaint : end_of(status, fuzzer_);
  finding.story.assign(notes_->story, notes_->story_length);
  finding.choices.assign(notes_->choices, notes_->choices + notes_->choice_count);
  return finding;
}

double Worker::slowest() const { return notes_->slowest; }

Counters Worker::counters() const {
  Counters result;
  if (notes_->cases > 0) result["cases"] = notes_->cases;
  for (const SharedNotes::Counter& counter : notes_->counters) {
    if (counter.what[0] != '\0') result[counter.what] += counter.times;
  }
  return result;
}

}  // namespace nef::fuzz
