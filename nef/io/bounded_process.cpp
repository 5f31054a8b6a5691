// SPDX-License-Identifier: Apache-2.0
#include "nef/io/bounded_process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <string_view>
#include <utility>

#include "nef/base/error.h"

namespace nef {
namespace {

// What the child sends: one of these, then text.
constexpr char kResult = 'r';
constexpr char kInputError = 'i';

void limit(decltype(RLIMIT_AS) resource, rlim_t value) {
  rlimit now{};
  if (getrlimit(resource, &now) != 0) return;
  now.rlim_cur = now.rlim_max == RLIM_INFINITY ? value : std::min(value, now.rlim_max);
  setrlimit(resource, &now);
}

// At most so many bytes more than there are now.
void limit_memory(std::size_t bytes) {
#ifndef NEF_SANITIZED
  std::ifstream pages("/proc/self/statm");
  rlim_t count = 0;
  pages >> count;
  limit(RLIMIT_AS, count * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + bytes);
#else
  static_cast<void>(bytes);  // sanitizers reserve terabytes of address space
#endif
}

void set_bounds(const ParserLimits& limits) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.seconds);
  limit_memory(limits.bytes);
  // An alarm ends the process unless somebody handles or blocks it.
  constexpr unsigned kWaiting = 4;
  sigset_t alarm_only;
  sigemptyset(&alarm_only);
  sigaddset(&alarm_only, SIGALRM);
  static_cast<void>(signal(SIGALRM, SIG_DFL));
  pthread_sigmask(SIG_UNBLOCK, &alarm_only, nullptr);
  alarm(kWaiting * limits.seconds);
}

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

[[noreturn]] void be_child(int out, const ParserLimits& limits, const std::function<std::string()>& work) {
  set_bounds(limits);
  bool sent = false;
  try {
    sent = write_all(out, kResult + work());
  } catch (const InputError& error) {
    sent = write_all(out, kInputError + std::string(error.what()));
  } catch (...) {  // out of memory, most likely
  }
  _exit(sent ? 0 : 1);
}

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 65536> block{};
  for (;;) {
    const ssize_t got = read(descriptor, block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
    text.append(block.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace

std::string limits_text(const ParserLimits& limits) {
  return std::to_string(limits.bytes >> 20U) + " MB and " + std::to_string(limits.seconds) + " s";
}

std::optional<std::string> run_bounded(const ParserLimits& limits, const std::function<std::string()>& work) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw InputError("no pipe to another process could be created");
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    be_child(ends[1], limits, work);
  }
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    throw InputError("no process could be started");
  }
  const std::string text = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || text.empty()) return std::nullopt;
  if (text[0] == kInputError) throw InputError(text.substr(1));
  return text.substr(1);
}

}  // namespace nef
