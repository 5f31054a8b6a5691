// SPDX-License-Identifier: Apache-2.0
#include "apps/program/run_program.h"

#include <iostream>
#include <new>
#include <string_view>
#include <system_error>

#include "apps/program/stack.h"
#include "nef/base/error.h"
#include "nef/number/memory.h"

namespace nef {
namespace {

constexpr int kBadExit = 2;

// What holds for the readers of all programs.
constexpr const char* kInputLimits =
    "Input: regular files, and standard input (-), of at most a quarter of the machine's memory; other devices and "
    "named\n"
    "pipes are refused, and so are files that unfold to very many copies or unpack to more than 200 times their size.\n"
    "What other libraries parse (OpenCV's and MATLAB's files, shapes that Assimp reads) is read in a process of\n"
    "its own, within 512 MB and 256 times the file, and 20 s and 1 s more for each 256 KB of it, 3MF within the same\n"
    "time; images other than PNG are read within 6 GB and 120 s.";

// What an exception says to a user; broken invariants say so themselves.
std::string text_of(const std::exception& error) {
  if (dynamic_cast<const Error*>(&error) != nullptr) return error.what();
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return "out of memory";
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  const auto is = [system](std::errc code) { return system != nullptr && system->code() == code; };
  if (is(std::errc::resource_unavailable_try_again) || is(std::errc::too_many_files_open)) {
    return std::string("the system has no room for another thread or file (") + error.what() +
           "); end other work, or raise its limits (ulimit -u, -n, -v)";
  }
  const std::string what = error.what();
  return what.rfind("internal error", 0) == 0 ? what : "internal error: " + what;
}

}  // namespace

namespace {

// What is wrong with a command line. An option that does not exist comes first: what is missing beside it may be what
// it was meant for.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error) {
  for (const std::string& left : app.remaining(true)) {
    // What stands behind "--" is none, whatever it looks like.
    if (left == "--") break;
    if (left.size() > 1 && left.front() == '-') return "there is no option '" + left + "'";
  }
  return error.what();
}

}  // namespace

std::string one_line(const std::string& text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string line;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\n' || c == '\r') {
      line += ' ';
    } else if (byte < 0x20 || byte == 0x7f) {
      line += "\\x";
      line += kDigits[byte >> 4U];
      line += kDigits[byte & 0xfU];
    } else {
      line += c;
    }
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

std::vector<std::string> printed_notes(std::span<const std::string> notes) {
  // A mesh of thousands of bent faces has a note for each.
  constexpr std::size_t kMost = 10;
  constexpr std::size_t kShown = 5;
  const std::size_t shown = notes.size() > kMost ? kShown : notes.size();
  std::vector<std::string> lines;
  for (const std::string& note : notes.first(shown)) lines.push_back("note: " + one_line(note));
  if (shown < notes.size()) {
    lines.push_back("note: and " + std::to_string(notes.size() - shown) + " more of them (--json lists all)");
  }
  return lines;
}

int run_program(CLI::App& app, int argc, char** argv, const std::function<int()>& body,
                const std::function<void(const std::string&)>& complain) {
  const auto refuse = [&](const std::string& line) {
    if (complain) {
      complain(line);
    } else {
      std::cerr << app.get_name() << ": " << one_line(line) << '\n';
    }
    return kBadExit;
  };
  let_gmp_throw_bad_alloc();
  try {
    require_stack();
    const std::string footer = app.get_footer();
    app.footer(footer + (footer.empty() ? "" : "\n") + kInputLimits);
    app.parse(argc, argv);
    const int code = body();
    std::cout.flush();
    return std::cout ? code : refuse("stdout cannot be written to");
  } catch (const CLI::ParseError& error) {
    // Help and version are "errors" with the code 0.
    if (error.get_exit_code() == 0) return app.exit(error, std::cout, std::cerr);
    std::string program = app.get_name();
    for (const CLI::App* command : app.get_subcommands()) program += " " + command->get_name();
    return refuse(usage_error(app, error) + " (see " + program + " --help)");
  } catch (const std::exception& error) {
    return refuse(text_of(error));
  }
}

}  // namespace nef
