/// @file
/// Runs the program snip, as built, and catches what it says.
#pragma once
#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "mesh_testing.hpp"

namespace cli_testing {

struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs `snip ARGUMENTS` in the directory.
inline Outcome snip(const mesh_testing::TemporaryDirectory& directory, const std::string& arguments) {
  const std::string command =
      fmt::format("cd '{}' && '{}' {} > .out 2> .err", directory.path().string(), SNIP_PROGRAM, arguments);
  const int status = std::system(command.c_str());
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, directory.read(".out"),
                  directory.read(".err")};
  std::filesystem::remove(directory / ".out");
  std::filesystem::remove(directory / ".err");
  return outcome;
}

/// The exit code of a line for the shell that is run in the directory, where `snip` is the program as built.
/// 128 and more when a signal ended it.
inline int shell(const mesh_testing::TemporaryDirectory& directory, const std::string& line) {
  const std::string program = SNIP_PROGRAM;
  const int status = std::system(fmt::format("cd '{}' && PATH='{}':$PATH; {}", directory.path().string(),
                                             program.substr(0, program.rfind('/')), line)
                                     .c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

/// The text is one line that begins as errors do.
inline bool is_one_error(const std::string& text) {
  return text.starts_with("snip: error: ") && text.find('\n') == text.size() - 1;
}

/// An OBJ of a flat sheet of n by n unit squares, each a quadrilateral, with UV equal to x and y, normals,
/// and colours that are x / n, y / n, 0.
inline std::string sheet_obj(int n) {
  std::string text;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x)
      text += fmt::format("v {0} {1} 0 {2} {3} 0\nvt {0} {1}\n", x, y, 1.0 * x / n, 1.0 * y / n);
  text += "vn 0 0 1\n";
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int v = y * (n + 1) + x + 1;
      text += fmt::format("f {0}/{0}/1 {1}/{1}/1 {2}/{2}/1 {3}/{3}/1\n", v, v + 1, v + n + 2, v + n + 1);
    }
  return text;
}

/// A cutter: the wall over the line from (x0, y0) to (x1, y1).
inline std::string wall_off(double x0, double y0, double x1, double y1) {
  return fmt::format("OFF\n4 1 0\n{0} {1} -1\n{2} {3} -1\n{2} {3} 1\n{0} {1} 1\n4 0 1 2 3\n", x0, y0, x1, y1);
}

}  // namespace cli_testing
