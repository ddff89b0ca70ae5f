/// @file
/// The sources of the project as text, and who includes whom. In: the project's folder. Out: a graph that
/// rules.hpp judges. Trees written in a test work as well as those on disk.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace architecture {

/// Path relative to the project's folder, with /, to content.
using SourceTree = std::map<std::string, std::string>;

/// One #include.
struct Include {
  std::string name;    ///< as written between the quotes or brackets
  std::string target;  ///< path in the tree, empty when it names nothing there
  int line = 0;
  bool quoted = false;
};

/// All .hpp and .cpp files of the libraries, programs, tests, benchmarks and examples.
SourceTree read_source_tree(const std::filesystem::path& root);

/// The includes of one file of the tree. A quoted name is sought beside the file, then every name in the
/// folders that the build names to the compiler.
std::vector<Include> includes_of(const SourceTree& tree, const std::string& path);

}  // namespace architecture
