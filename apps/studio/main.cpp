// SPDX-License-Identifier: Apache-2.0
//
// nef-studio ROOT PORT THREADS SECONDS MEGABYTES BROWSER FILES...: the server; nef-studio --run OUTPUT ROOT THREADS
// SECONDS MEGABYTES FILE: a state computed without one. Both are what `nef studio` starts with what its options say
// (apps/nef/command/views/command_studio.cpp). A program of its own, so that `nef` does not load the libraries of
// servers and planners. Ends with SIGINT, SIGTERM and SIGHUP, which a page can cause, too.
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <charconv>
#include <filesystem>
#include <iostream>
#include <span>
#include <thread>

#include "apps/program/run_program.h"
#include "apps/program/stack.h"
#include "apps/studio/run_state.h"
#include "apps/studio/server/admission.h"
#include "apps/studio/studio.h"
#include "apps/studio/studio_page.h"
#include "nef/base/error.h"
#include "nef/base/freed_memory.h"

extern char** environ;

namespace nef::studio {
namespace {

std::size_t number(const char* text) {
  std::size_t value = 0;
  const std::string_view digits = text;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size()) {
    throw InputError("nef-studio is started by nef studio: '" + std::string(digits) + "' is not a number");
  }
  return value;
}

// A file that only the user may read and that leads a browser to an address: on the command line of a browser everybody
// on the machine could read the token. Removed in the end.
class Redirection {
 public:
  explicit Redirection(const std::string& address) {
    std::string name = (std::filesystem::temp_directory_path() / "nef-studio-XXXXXX.html").string();
    const int file = ::mkstemps(name.data(), 5);
    if (file < 0) return;
    const std::string page = "<!DOCTYPE html><meta http-equiv=\"refresh\" content=\"0; url=" + address +
                             "\"><title>nef studio</title><a href=\"" + address + "\">nef studio</a>\n";
    if (::write(file, page.data(), page.size()) == static_cast<ssize_t>(page.size())) path_ = name;
    ::close(file);
  }
  ~Redirection() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove(path_, ignored);
  }
  Redirection(const Redirection&) = delete;
  Redirection& operator=(const Redirection&) = delete;

  void open() const {
    if (path_.empty()) return;
    std::string program = "xdg-open";
    std::string path = path_;
    std::array<char*, 3> arguments{program.data(), path.data(), nullptr};
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    static_cast<void>(::posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ));
    ::posix_spawn_file_actions_destroy(&actions);
  }

 private:
  std::string path_;
};

int run(std::span<char*> arguments) {
  if (arguments.size() != 8) throw InputError("nef-studio is started by nef studio (nef studio --help)");
  StudioOptions options;
  options.root = arguments[3];
  options.threads = static_cast<unsigned>(number(arguments[4]));
  options.limits.seconds = static_cast<double>(number(arguments[5]));
  options.limits.bytes = number(arguments[6]) << 20U;
  options.files = {arguments[7]};
  run_state(options, arguments[2], std::cout);
  return 0;
}

int serve(std::span<char*> arguments) {
  if (arguments.size() < 7) throw InputError("nef-studio is started by nef studio (nef studio --help)");
  StudioOptions options;
  options.root = arguments[1];
  const std::size_t port = number(arguments[2]);
  options.threads = static_cast<unsigned>(number(arguments[3]));
  options.limits.seconds = static_cast<double>(number(arguments[4]));
  options.limits.bytes = number(arguments[5]) << 20U;
  const bool browser = number(arguments[6]) != 0;
  if (studio_page().empty()) {
    throw UnsupportedError(
        "the page was not built because CMake found no node, npm or network; install the packages nodejs and npm and "
        "configure again (cmake -B build)");
  }
  options.files.assign(arguments.begin() + 7, arguments.end());

  sigset_t ends;
  sigemptyset(&ends);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ends, signal);
  Studio studio(options, [] { ::kill(::getpid(), SIGTERM); });
  LoopbackServer server(static_cast<std::uint16_t>(port), random_token(), {},
                        [&studio](const WebRequest& request) { return studio.answer(request); });
  std::cout << server.address() << std::endl;
  const Redirection redirection(server.address());
  if (browser) redirection.open();
  ::signal(SIGPIPE, SIG_IGN);
  // Of this thread and of those that it starts: the signals go to the one that waits for them.
  ::pthread_sigmask(SIG_BLOCK, &ends, nullptr);
  std::thread waiting([&] {
    int signal = 0;
    ::sigwait(&ends, &signal);
    studio.close();
    server.stop();
  });
  server.run();
  ::kill(::getpid(), SIGTERM);  // where the server ended by itself
  waiting.join();
  return 0;
}

}  // namespace
}  // namespace nef::studio

int main(int argc, char** argv) {
  nef::keep_freed_memory();
  try {
    nef::require_stack();
    const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
    const bool runs = argc > 1 && std::string_view(argv[1]) == "--run";
    return runs ? nef::studio::run(arguments) : nef::studio::serve(arguments);
  } catch (const std::exception& error) {
    std::cerr << "nef studio: " << nef::one_line(error.what()) << '\n';
    return 2;
  }
}
