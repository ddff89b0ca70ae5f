// The command line; see the header. Each command has a file of its own in commands/.
#include "snip/command_line.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <new>

#include "snip/commands/commands.hpp"
#include "snip/commands/report.hpp"

namespace snip {

int run_command_line(int argc, const char* const* argv) {
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
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    report_error({std::string(error.what()) + " (see snip --help)"});
    return exit_bad_usage;
  } catch (const std::bad_alloc&) {
    report_error({"not enough memory"});
    return exit_bad_input;
  }
}

}  // namespace snip
