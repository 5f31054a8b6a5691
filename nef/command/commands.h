// SPDX-License-Identifier: Apache-2.0
//
// The subcommands of `nef`, one function for each file of them.
#pragma once

#include "nef/command/run_command.h"
#include "nef/program/report.h"
#include "nef/program/session.h"

namespace nef {

/// Adds a subcommand with the flags that all programs have.
CLI::App* add_subcommand(CLI::App& app, Session& session, const std::string& name, const std::string& description);

void add_boolean_commands(CLI::App& app, Session& session);
void add_unary_commands(CLI::App& app, Session& session);
void add_transform_command(CLI::App& app, Session& session);
void add_info_commands(CLI::App& app, Session& session);
void add_check_command(CLI::App& app, Session& session);
void add_repair_command(CLI::App& app, Session& session);
void add_decimate_command(CLI::App& app, Session& session);
void add_subdivide_command(CLI::App& app, Session& session);
void add_query_commands(CLI::App& app, Session& session);
void add_parts_commands(CLI::App& app, Session& session);
void add_eval_command(CLI::App& app, Session& session, const CommandExtensions& extensions);
void add_apply_command(CLI::App& app, Session& session, const CommandExtensions& extensions);
void add_view_commands(CLI::App& app, Session& session);

}  // namespace nef
