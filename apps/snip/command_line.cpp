// The command line; see the header. Each command has a file of its own in commands/.
#include "snip/command_line.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <sstream>

#include "snip/commands/commands.hpp"
#include "snip/commands/report.hpp"
#include "snip/console.hpp"

namespace snip {
namespace {

int run(int argc, const char* const* argv) {
  CLI::App app{"Cuts cloth and other thin surfaces", "snip"};
  app.set_version_flag("--version", "snip " SNIP_VERSION);
  app.require_subcommand(1);
  app.footer("snip COMMAND --help explains a command. Exit codes: 0 done, 1 bad input, 2 bad usage.");
  int exit_code = exit_ok;
  add_cut_command(app, exit_code);
  add_run_command(app, exit_code);
  add_weld_command(app, exit_code);
  add_validate_command(app, exit_code);
  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::Success& help_or_version) {
    std::ostringstream text;
    const int code = app.exit(help_or_version, text, text);
    print_out(text.str());
    return code;
  } catch (const CLI::ParseError& error) {
    const auto unknown = app.remaining();
    const bool no_command = app.get_subcommands().empty() && !unknown.empty() && !unknown[0].starts_with('-');
    report_error({(no_command ? "there is no command " + unknown[0] : std::string(error.what())) +
                  " (see snip --help)"});
    return exit_bad_usage;
  }
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
  prepare_standard_streams();
  int exit_code = exit_bad_input;
  try {
    exit_code = run(argc, argv);
  } catch (const std::bad_alloc&) {
    report_error({"not enough memory"});
  } catch (const std::exception& error) {
    report_error({std::string("stopped by an unexpected error: ") + error.what()});
  }
  if (const Result<> flushed = flush_stdout(); !flushed && exit_code == exit_ok) {
    report_error(flushed.error());
    exit_code = exit_bad_input;
  }
  return exit_code;
}

}  // namespace snip
