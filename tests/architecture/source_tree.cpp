#include "architecture/source_tree.hpp"

#include <array>
#include <fstream>
#include <iterator>
#include <sstream>

namespace architecture {
namespace {

constexpr std::array<std::string_view, 6> top_folders{"libspatial", "libcut", "apps",
                                                      "tests",      "bench",  "examples"};
constexpr std::array<std::string_view, 6> include_folders{
    "libspatial/include", "libcut/include", "libcut/src", "apps", "tests", "bench"};

std::string resolve(const SourceTree& tree, const std::string& path, const Include& include) {
  namespace fs = std::filesystem;
  const auto found = [&](const fs::path& folder) -> std::string {
    std::string candidate = (folder / include.name).lexically_normal().generic_string();
    return tree.contains(candidate) ? candidate : "";
  };
  if (include.quoted)
    if (std::string target = found(fs::path(path).parent_path()); !target.empty()) return target;
  for (const std::string_view folder : include_folders)
    if (std::string target = found(folder); !target.empty()) return target;
  return {};
}

}  // namespace

SourceTree read_source_tree(const std::filesystem::path& root) {
  namespace fs = std::filesystem;
  SourceTree tree;
  for (const std::string_view top : top_folders) {
    if (!fs::exists(root / top)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top)) {
      const fs::path extension = entry.path().extension();
      if (!entry.is_regular_file() || (extension != ".hpp" && extension != ".cpp")) continue;
      std::ifstream file(entry.path(), std::ios::binary);
      tree[fs::relative(entry.path(), root).generic_string()] = {std::istreambuf_iterator<char>(file), {}};
    }
  }
  return tree;
}

std::vector<Include> includes_of(const SourceTree& tree, const std::string& path) {
  std::vector<Include> includes;
  std::istringstream lines(tree.at(path));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    // "#  include" with any space, outside of comments: only a directive starts its line with #.
    std::istringstream words(line);
    std::string name;
    char hash = 0;
    if (!(words >> hash) || hash != '#' || !(words >> std::ws) || !std::getline(words, name)) continue;
    if (!name.starts_with("include")) continue;
    const std::size_t open = name.find_first_of("\"<");
    if (open == std::string::npos) continue;
    const std::size_t close = name.find_first_of("\">", open + 1);
    Include include{name.substr(open + 1, close - open - 1), "", number, name[open] == '"'};
    include.target = resolve(tree, path, include);
    includes.push_back(std::move(include));
  }
  return includes;
}

}  // namespace architecture
