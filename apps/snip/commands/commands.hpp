/// @file
/// The commands of snip. Each function adds one to the command line; when the command is given, it runs and
/// leaves its exit code in `exit_code`.
#pragma once
#include <CLI/App.hpp>

namespace snip {

void add_cut_command(CLI::App& app, int& exit_code);
void add_run_command(CLI::App& app, int& exit_code);
void add_weld_command(CLI::App& app, int& exit_code);
void add_validate_command(CLI::App& app, int& exit_code);

}  // namespace snip
