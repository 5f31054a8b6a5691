// SPDX-License-Identifier: Apache-2.0
//
// Rank 0 keeps the queue. Its first thread answers the other ranks, and a second one works on tasks as they do, because
// MPI is initialized for calls from one thread only (MPI_THREAD_FUNNELED). A rank sends its result and thereby asks for
// the next task. All waiting is polling with short sleeps, as blocking calls of MPI keep a core busy. A task whose
// needs are not done waits outside the queue, and enters it at the front when the last of them is done.
#include "apps/nef_mpi/task_dealer.h"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <deque>
#include <future>
#include <map>
#include <new>
#include <optional>
#include <set>
#include <thread>

#include "nef/base/timing/stopwatch.h"

namespace nef::mpi {
namespace {

enum Tag : int { kResult = 1, kTask = 2 };

constexpr std::int64_t kNone = -1;  // no task: a rank asks for its first one, or there is none left

// What a rank sends: the task, whether it succeeded, and what it gave or why it failed.
struct Outcome {
  std::int64_t task = kNone;
  bool good = true;
  double seconds = 0;  // on the clock
  std::string text;

  [[nodiscard]] std::string bytes() const {
    std::string result(kHead, '\0');
    std::memcpy(result.data(), &task, sizeof(task));
    std::memcpy(result.data() + sizeof(task), &seconds, sizeof(seconds));
    return result + (good ? '+' : '-') + text;
  }
  static Outcome from(const std::string& bytes) {
    Outcome result;
    std::memcpy(&result.task, bytes.data(), sizeof(result.task));
    std::memcpy(&result.seconds, bytes.data() + sizeof(task), sizeof(seconds));
    result.good = bytes[kHead] == '+';
    result.text = bytes.substr(kHead + 1);
    return result;
  }

 private:
  static constexpr std::size_t kHead = sizeof(std::int64_t) + sizeof(double);
};

Outcome attempt(const Task& task, std::int64_t number) {
  Outcome outcome;
  outcome.task = number;
  const Stopwatch watch;
  try {
    outcome.text = task(static_cast<std::size_t>(number));
  } catch (const std::bad_alloc&) {
    outcome.good = false;
    outcome.text = "out of memory";
  } catch (const std::exception& error) {
    outcome.good = false;
    outcome.text = error.what();
  }
  outcome.seconds = watch.seconds();
  return outcome;
}

// Waiting in MPI keeps a core busy.
void rest() { std::this_thread::sleep_for(std::chrono::microseconds(200)); }

void wait_for(MPI_Request request) {
  int done = 0;
  while (done == 0) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done == 0) rest();
  }
}

void broadcast(void* data, std::uint64_t bytes) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibcast(data, static_cast<int>(bytes), MPI_BYTE, 0, MPI_COMM_WORLD, &request);
  wait_for(request);
}

void send(const std::string& bytes, int to, Tag tag) {
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD);
}

std::optional<std::string> receive(int from, Tag tag, int* sender = nullptr) {
  int there = 0;
  MPI_Status status;
  MPI_Iprobe(from, tag, MPI_COMM_WORLD, &there, &status);
  if (there == 0) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  MPI_Recv(bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  if (sender != nullptr) *sender = status.MPI_SOURCE;
  return bytes;
}

void work(const Task& task) {
  send(Outcome{}.bytes(), 0, kResult);
  while (true) {
    const std::optional<std::string> bytes = receive(0, kTask);
    if (!bytes) {
      rest();
      continue;
    }
    std::int64_t number = kNone;
    std::memcpy(&number, bytes->data(), sizeof(number));
    if (number == kNone) return;
    send(attempt(task, number).bytes(), 0, kResult);
  }
}

// Rank 0. It works itself, in a second thread, since the first one answers the others.
class Dealer {
 public:
  Dealer(int ranks, const std::vector<std::size_t>& todo, const Task& task, const TaskDone& done,
         const TaskNeeds& needs, int attempts)
      : task_(task), done_(done), attempts_(attempts) {
    const std::set<std::size_t> to_come(todo.begin(), todo.end());
    for (const std::size_t number : todo) {
      for (const std::size_t need : needs ? needs(number) : std::vector<std::size_t>()) {
        if (!to_come.contains(need)) continue;
        ++missing_[number];
        needed_by_[need].push_back(number);
      }
      if (!missing_.contains(number)) waiting_.push_back(static_cast<std::int64_t>(number));
    }
    idle_.push_back(0);
    asking_ = ranks - 1;
  }

  std::vector<TaskFailure> run() {
    // Every other rank asks once at the beginning, so that all of them hear the end.
    while (!waiting_.empty() || under_way_ > 0 || asking_ > 0) {
      while (!waiting_.empty() && !idle_.empty()) assign();
      if (!hear()) rest();
    }
    for (const int rank : idle_) {
      if (rank != 0) tell(rank, kNone);
    }
    std::sort(failures_.begin(), failures_.end(),
              [](const TaskFailure& a, const TaskFailure& b) { return a.task < b.task; });
    return std::move(failures_);
  }

 private:
  static void tell(int rank, std::int64_t number) {
    std::string bytes(sizeof(number), '\0');
    std::memcpy(bytes.data(), &number, sizeof(number));
    send(bytes, rank, kTask);
  }

  void assign() {
    const int rank = idle_.front();
    idle_.pop_front();
    const std::int64_t number = waiting_.front();
    waiting_.pop_front();
    ++under_way_;
    if (rank == 0) {
      own_ = std::async(std::launch::async, [this, number] { return attempt(task_, number); });
    } else {
      tell(rank, number);
    }
  }

  bool hear() {
    int sender = 0;
    if (const std::optional<std::string> bytes = receive(MPI_ANY_SOURCE, kResult, &sender)) {
      take(Outcome::from(*bytes), sender);
      return true;
    }
    if (own_.valid() && own_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
      take(own_.get(), 0);
      return true;
    }
    return false;
  }

  void take(Outcome outcome, int rank) {
    idle_.push_back(rank);
    if (outcome.task == kNone) {
      --asking_;
      return;
    }
    --under_way_;
    const auto number = static_cast<std::size_t>(outcome.task);
    if (outcome.good) {
      done_(number, outcome.text, outcome.seconds);
      for (const std::size_t next : needed_by_[number]) {
        // The rank that asks next is the one that has made what it needs, if all are busy.
        if (--missing_[next] == 0) waiting_.push_front(static_cast<std::int64_t>(next));
      }
    } else if (++tried_[number] < attempts_) {
      waiting_.push_back(outcome.task);
    } else {
      failures_.push_back({number, std::move(outcome.text)});
    }
  }

  const Task& task_;
  const TaskDone& done_;
  int attempts_;
  std::deque<std::int64_t> waiting_;
  std::deque<int> idle_;  // ranks without a task, the one that has waited longest first
  int asking_ = 0;        // ranks that have not been heard of
  std::size_t under_way_ = 0;
  std::map<std::size_t, int> tried_;
  std::map<std::size_t, std::size_t> missing_;                 // how many tasks a task waits for
  std::map<std::size_t, std::vector<std::size_t>> needed_by_;  // which ones wait for a task
  std::vector<TaskFailure> failures_;
  std::future<Outcome> own_;
};

}  // namespace

Environment::Environment(int& argc, char**& argv, bool alone) : alone_(alone) {
  if (alone) return;
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
}

Environment::~Environment() {
  if (alone_) return;
  // Until rank 0 has written the output.
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  wait_for(request);
  MPI_Finalize();
}

void Environment::share(std::string& text) const {
  std::uint64_t size = text.size();
  broadcast(&size, sizeof(size));
  text.resize(size);
  // A message has 2^31 - 1 bytes at most.
  constexpr std::uint64_t kPart = std::uint64_t{1} << 30U;
  for (std::uint64_t at = 0; at < size; at += kPart) {
    broadcast(text.data() + at, std::min(kPart, size - at));
  }
}

void Environment::abort(int code) const {
  MPI_Abort(MPI_COMM_WORLD, code);
  std::abort();
}

std::vector<TaskFailure> deal_tasks(const Environment& mpi, const std::vector<std::size_t>& todo, const Task& task,
                                    const TaskDone& done, const TaskNeeds& needs, int attempts) {
  std::vector<TaskFailure> failures;
  std::string text;
  if (mpi.first()) {
    failures = Dealer(mpi.ranks(), todo, task, done, needs, attempts).run();
    for (const TaskFailure& failure : failures) {
      text += std::to_string(failure.task) + ' ' + std::to_string(failure.error.size()) + ' ' + failure.error;
    }
  } else {
    work(task);
  }
  mpi.share(text);
  if (mpi.first()) return failures;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t used = 0;
    TaskFailure& failure = failures.emplace_back();
    failure.task = std::stoul(text.substr(at), &used);
    at += used + 1;
    const std::size_t length = std::stoul(text.substr(at), &used);
    at += used + 1;
    failure.error = text.substr(at, length);
    at += length;
  }
  return failures;
}

}  // namespace nef::mpi
