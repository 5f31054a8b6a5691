// SPDX-License-Identifier: Apache-2.0
//
// The frame of all programs: what a command line lacks, what an exception says, and the exit code.
//
// A word that is no subcommand or option is looked up among the names that other programs use, then among those that
// are spelled almost alike. What CLI11 says is put into the words of the other messages. Every error becomes one line
// on standard error.
#include "apps/program/run_program.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <new>
#include <regex>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "apps/program/nearest_word.h"
#include "apps/program/numbers.h"
#include "apps/program/stack.h"
#include "nef/base/error.h"
#include "nef/base/text/word_list.h"
#include "nef/number/memory.h"

namespace nef {
namespace {

constexpr int kBadExit = 2;

// What holds for the readers of all programs.
constexpr const char* kInputLimits =
    "Limits of input: regular files and standard input (-) of at most a quarter of the machine's memory. Devices and\n"
    "named pipes are refused, and so are files that unpack to more than 200 times their size or repeat an object very\n"
    "often. Files of OpenCV and MATLAB and shapes for Assimp are parsed in a separate process, limited to 512 MB plus\n"
    "256 times the file, and to 20 s plus 1 s per 256 KB (3MF: the same time). Images other than PNG: 6 GB and 120 s.";

// What an exception says to a user; broken invariants say so themselves.
std::string text_of(const std::exception& error) {
  if (dynamic_cast<const Error*>(&error) != nullptr) return error.what();
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return "out of memory";
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  const auto is = [system](std::errc code) { return system != nullptr && system->code() == code; };
  if (is(std::errc::resource_unavailable_try_again) || is(std::errc::too_many_files_open)) {
    return std::string("the system cannot provide another thread or file (") + error.what() +
           "); close other programs, or raise the limits (ulimit -u, -n, -v)";
  }
  const std::string what = error.what();
  return what.rfind("internal error", 0) == 0 ? what : "internal error: " + what;
}

std::vector<std::string> subcommand_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  return names;
}

// The long options of the program and of the subcommand that was given.
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  const auto add = [&names](const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
  };
  add(app);
  for (const CLI::App* command : app.get_subcommands()) add(*command);
  return names;
}

// What other programs call these subcommands.
constexpr std::array<std::pair<std::string_view, std::string_view>, 20> kOtherNames{{
    {"add", "union"},         {"combine", "union"},    {"cut", "difference"},      {"diff", "difference"},
    {"evaluate", "eval"},     {"export", "convert"},   {"fix", "repair"},          {"intersect", "intersection"},
    {"merge", "union"},       {"mirror", "transform"}, {"move", "transform"},      {"reduce", "decimate"},
    {"render", "picture"},    {"rotate", "transform"}, {"scale", "transform"},     {"show", "view"},
    {"simplify", "decimate"}, {"slice", "section"},    {"subtract", "difference"}, {"translate", "transform"},
}};

// What another program of the suite does.
constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kOfOtherPrograms{{
    {"decompose", "minkowski A --decompose -o B"},
    {"grow", "minkowski A --offset R -o B"},
    {"hull", "minkowski A --hull -o B"},
    {"minkowski", "minkowski A B -o C"},
    {"offset", "minkowski A --offset R -o B"},
    {"plan", "planner SCENE"},
    {"shrink", "minkowski A --offset -R -o B"},
    {"sum", "minkowski A B -o C"},
}};

std::string suggested_subcommand(const CLI::App& app, const std::string& word) {
  const std::vector<std::string> names = subcommand_names(app);
  for (const auto& [other, command] : kOfOtherPrograms) {
    if (word == other) return "; that is '" + std::string(command) + "'";
  }
  for (const auto& [other, name] : kOtherNames) {
    if (word != other || std::find(names.begin(), names.end(), name) == names.end()) continue;
    return "; did you mean '" + std::string(name) + "'?";
  }
  return did_you_mean(word, names);
}

// "--plane A,B,C,D is required": what the value of a missing option looks like.
std::string missing_option(const CLI::App& app, const CLI::ParseError& error) {
  std::string what = error.what();
  const std::string name = what.substr(0, what.find(' '));
  if (name.rfind("--", 0) != 0 || name == "--output") return what;
  for (const CLI::App* command : app.get_subcommands()) {
    const CLI::Option* option = command->get_option_no_throw(name);
    if (option == nullptr) continue;
    const std::string type = option->get_type_name();  // "UINT:POSITIVE", with what checks it
    return name + " " + type.substr(0, type.find(':')) + what.substr(name.size());
  }
  return what;
}

// An option without its value takes the next option for one: "--time -o path.txt". Nothing if there is none.
std::string taken_for_value(const CLI::App& app) {
  std::vector<const CLI::App*> commands{&app};
  for (const CLI::App* command : app.get_subcommands()) commands.push_back(command);
  const auto is_name = [&](const std::string& word) {
    return word.size() > 1 && word.front() == '-' &&
           std::any_of(commands.begin(), commands.end(),
                       [&](const CLI::App* command) { return command->get_option_no_throw(word) != nullptr; });
  };
  for (const CLI::App* command : commands) {
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_lnames().empty() && option->get_snames().empty()) continue;  // operands may follow "--"
      for (const std::string& value : option->results()) {
        if (is_name(value)) return option->get_name() + " needs a value, and '" + value + "' is an option";
      }
    }
  }
  return "";
}

// An option of no subcommand: misspelt, or before the subcommand that it belongs to.
std::string unknown_option(const CLI::App& app, const std::string& word) {
  const std::vector<std::string> options = option_names(app);
  const std::string name = word.substr(0, word.find('='));
  const std::string what = "there is no option '" + word + "'";
  if (std::find(options.begin(), options.end(), name) == options.end()) return what + did_you_mean(name, options);
  return what + " before the subcommand; write it behind '" + app.get_subcommands().front()->get_name() + "'";
}

// An argument that nothing takes. Numbers in a row are one value that was written in several words.
std::string unexpected(const CLI::App& app, const std::string& word) {
  const std::string what = "unexpected argument '" + word + "'";
  if (try_parse_rational(word)) return what + "; several numbers are one word with commas, 1,2,3";
  const std::vector<std::string> options = option_names(app);
  const bool writes = std::find(options.begin(), options.end(), "--output") != options.end();
  return what + (writes ? "; an output file is named with -o" : "");
}

// What CLI11 says, in other words.
std::string in_plain_words(const std::string& what) {
  static const std::regex one_of(R"((.*): (.*) not in \{(.*)\})");
  static const std::array<std::pair<std::regex, const char*>, 6> phrases{{
      {std::regex(R"((.*): Value (.*) not in range (-?\d+(?:\.\d*[1-9])?)\.?0* to (-?\d+(?:\.\d*[1-9])?)\.?0*)"),
       "$1: expected a number from $3 to $4, not '$2'"},
      {std::regex(R"((.*): At least (\d+) required but received (\d+))"), "give at least $2 $1, not $3"},
      {std::regex(R"((.*): At Most (\d+) required but received (\d+))"), "give at most $2 $1, not $3"},
      {std::regex(R"((.*): \d+ required ([^: ]+).* missing)"), "$1 needs a value: $2"},
      {std::regex(R"(Could not convert: (.*) = (.*))"), "$1: '$2' is not a number"},
      {std::regex("A subcommand is required"), "name a subcommand"},
  }};
  std::smatch match;
  if (std::regex_match(what, match, one_of)) {
    std::istringstream list(match[3]);
    std::vector<std::string> words;
    for (std::string word; std::getline(list, word, ',');) words.push_back(word);
    return match[1].str() + ": expected " + word_list(words, "or") + ", not '" + match[2].str() + "'";
  }
  for (const auto& [phrase, words] : phrases) {
    if (std::regex_match(what, match, phrase)) return match.format(words);
  }
  return what;
}

// What is wrong with a command line. An option that does not exist comes first: what is missing beside it may be what
// it was meant for.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error) {
  if (std::string taken = taken_for_value(app); !taken.empty()) return taken;
  const std::vector<std::string> left = app.remaining(true);
  if (!left.empty() && left.front() == "help") return "'help' is an option, --help";
  const bool lacks_command = !subcommand_names(app).empty() && app.get_subcommands().empty();
  if (lacks_command && !left.empty() && left.front().front() != '-') {
    return "there is no subcommand '" + left.front() + "'" + suggested_subcommand(app, left.front());
  }
  for (const std::string& word : left) {
    // After "--" nothing is an option.
    if (word == "--") break;
    if (word.size() < 2 || word.front() != '-') continue;
    return unknown_option(app, word);
  }
  const bool is_extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  const bool is_missing = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  if (!left.empty() && (is_extra || is_missing)) {
    return (is_missing ? missing_option(app, error) + "; " : "") + unexpected(app, left.front());
  }
  return in_plain_words(is_missing ? missing_option(app, error) : error.what());
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
    lines.push_back("note: and " + std::to_string(notes.size() - shown) + " more (--json lists all)");
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
    if (const std::string taken = taken_for_value(app); !taken.empty()) throw CLI::ArgumentMismatch(taken);
    const int code = body();
    std::cout.flush();
    return std::cout ? code : refuse("standard output cannot be written");
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
