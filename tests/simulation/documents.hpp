/// @file
/// Pages of docs/ as text, for tests that compute the tables in them.
#pragma once
#include <fstream>
#include <sstream>
#include <string>

namespace testing {

/// @param name  relative to docs/
inline std::string page(const std::string& name) {
  std::ifstream file(std::string(SNIP_SOURCE_DIR) + "/docs/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace testing
