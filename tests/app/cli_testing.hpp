/// @file
/// Runs the program snip, as built, and catches what it says.
#pragma once
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
      "cd '" + directory.path().string() + "' && '" SNIP_PROGRAM "' " + arguments + " > .out 2> .err";
  const int status = std::system(command.c_str());
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, directory.read(".out"),
                  directory.read(".err")};
  std::filesystem::remove(directory / ".out");
  std::filesystem::remove(directory / ".err");
  return outcome;
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
    for (int x = 0; x <= n; ++x) {
      const std::string xy = std::to_string(x) + " " + std::to_string(y);
      text += "v " + xy + " 0 " + std::to_string(x / static_cast<double>(n)) + " " +
              std::to_string(y / static_cast<double>(n)) + " 0\nvt " + xy + "\n";
    }
  text += "vn 0 0 1\n";
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      text += "f";
      for (const int v :
           {y * (n + 1) + x, y * (n + 1) + x + 1, (y + 1) * (n + 1) + x + 1, (y + 1) * (n + 1) + x})
        text += " " + std::to_string(v + 1) + "/" + std::to_string(v + 1) + "/1";
      text += "\n";
    }
  return text;
}

/// A cutter: the wall over the line from (x0, y0) to (x1, y1).
inline std::string wall_off(double x0, double y0, double x1, double y1) {
  const std::string a = std::to_string(x0) + " " + std::to_string(y0);
  const std::string b = std::to_string(x1) + " " + std::to_string(y1);
  return "OFF\n4 1 0\n" + a + " -1\n" + b + " -1\n" + b + " 1\n" + a + " 1\n4 0 1 2 3\n";
}

}  // namespace cli_testing
