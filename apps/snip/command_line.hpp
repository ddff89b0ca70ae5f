/// @file
/// The command line of snip: which commands there are, and what their exit codes mean.
#pragma once

namespace snip {

/// Exit codes of the program.
enum ExitCode : int { exit_ok = 0, exit_bad_input = 1, exit_bad_usage = 2 };

/// Parses the command line and runs the command. Help and version go to stdout; errors are one line on
/// stderr, `snip: error: ...`. @return an ExitCode
int run_command_line(int argc, const char* const* argv);

}  // namespace snip
