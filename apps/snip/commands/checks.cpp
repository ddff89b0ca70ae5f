// Checks of arguments, see the header. Those that CLI11 has let nan pass, and print the largest number in
// full.
#include "snip/commands/checks.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <string>

namespace snip {

CLI::Validator positive_number() {
  return {[](std::string& text) -> std::string {
            char* end = nullptr;
            const double value = std::strtod(text.c_str(), &end);
            const bool good = !text.empty() && *end == '\0' && value > 0 && std::isfinite(value);
            return good ? "" : "has to be a number greater than 0, not '" + text + "'";
          },
          "", "positive number"};
}

CLI::Validator a_name() {
  return {[](std::string& text) -> std::string { return text.empty() ? "the name is empty" : ""; }, "",
          "name"};
}

}  // namespace snip
