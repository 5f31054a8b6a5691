// SPDX-License-Identifier: Apache-2.0
//
// What every `main` does around the work: arguments, errors as one line, exit codes.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace nef {

/// A text as one line that no terminal takes for commands, whatever it quotes from a file.
std::string one_line(const std::string& text);

/// The lines of notes that are printed: all of them, or of many the first few and how many there are more, which the
/// report of --json lists.
std::vector<std::string> printed_notes(std::span<const std::string> notes);

/// Parses the command line and does `body`, whose value becomes the exit code. Help and version exit with 0. Bad usage,
/// every exception and an output that cannot be written to become one line (`complain`; stderr without it) and
/// the exit code 2. The name of `app` stands in front of the line.
int run_program(CLI::App& app, int argc, char** argv, const std::function<int()>& body,
                const std::function<void(const std::string&)>& complain = {});

}  // namespace nef
