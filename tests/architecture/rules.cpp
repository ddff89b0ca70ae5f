#include "architecture/rules.hpp"

#include <algorithm>
#include <array>
#include <regex>
#include <set>

namespace architecture {
namespace {

using Names = std::vector<std::string_view>;

struct Layer {
  std::string_view name;
  Names sees;            // besides itself
  Names public_headers;  // in libcut/include/cut, without .hpp
};

/// From left to right: no layer sees one that stands to its right, and `simulation` stands beside the ladder.
/// A new public header gets its place here.
const std::vector<Layer> layers{
    {"spatial", {}, {}},
    {"base", {"spatial"}, {"error", "executor", "ids", "tbb", "threads", "triangle_mesh"}},
    {"lattice", {"spatial", "base"}, {"lattice_point"}},
    {"mesh",
     {"spatial", "base", "lattice"},
     {"arrangement", "bending", "buffers", "hybrid_mesh", "merge_distances", "pieces"}},
    {"changes", {"spatial", "base", "lattice", "mesh"}, {"changes"}},
    {"validate", {"spatial", "base", "lattice", "mesh", "changes"}, {"validate"}},
    {"cutting", {"spatial", "base", "lattice", "mesh", "changes", "validate"}, {"blade", "cutter"}},
    {"simulation",
     {"spatial", "base", "lattice", "mesh", "changes"},
     {"implicit_work", "material", "padded_vector", "simulation", "spring_blocks", "surroundings",
      "tearing"}},
};

bool contains(const Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

/// Test folders that test a step from within, and so may see libcut/src.
const std::set<std::string_view> step_tests{"tests/lattice", "tests/cut", "tests/simulation"};
/// README.md shows these as they are, and says around them what they are for.
const std::set<std::string_view> shown_in_readme{"examples/cut.cpp", "examples/spatial.cpp"};
/// Test folders that may see the sources of the command line tool.
const std::set<std::string_view> app_tests{"tests/app", "tests/fuzz"};

std::string_view stem(std::string_view path) {
  path.remove_prefix(path.rfind('/') + 1);
  return path.substr(0, path.find('.'));
}

/// The first `count` parts of a path: its folder as far as the rules care.
std::string_view first_parts(std::string_view path, int count) {
  std::size_t end = 0;
  for (; count > 0 && end != std::string_view::npos; --count) end = path.find('/', end == 0 ? 0 : end + 1);
  return path.substr(0, end);
}

/// The layer of a file of the libraries; empty when no rule gives it one.
std::string_view layer_of(std::string_view path) {
  constexpr std::string_view sources = "libcut/src/";
  if (path.starts_with("libspatial/")) return "spatial";
  if (path.starts_with(sources)) {
    const std::string_view inner = path.substr(sources.size());
    const std::string_view folder = inner.substr(0, inner.find('/'));
    const bool known = std::ranges::any_of(layers, [&](const Layer& layer) { return layer.name == folder; });
    if (known && folder != "spatial") return folder;
    if (folder != inner) return {};
  }
  // A public header, or a source in libcut/src that has its name.
  for (const Layer& layer : layers)
    if (contains(layer.public_headers, stem(path))) return layer.name;
  return {};
}

/// Whether the first line of a file is a comment, which tells what the file is for. A source may leave that
/// to the header of its name beside it.
bool says_what_it_is_for(const SourceTree& tree, const std::string& path) {
  if (tree.at(path).starts_with("//") || shown_in_readme.contains(path)) return true;
  return path.ends_with(".cpp") && tree.contains(path.substr(0, path.rfind('.')) + ".hpp");
}

bool in_library(std::string_view path) {
  return path.starts_with("libspatial/") || path.starts_with("libcut/");
}

/// What a file of the libraries may take from elsewhere: the standard library, and Eigen in libcut.
bool may_use_external(std::string_view path, std::string_view name) {
  // Files and logging belong to the programs.
  const std::set<std::string_view> not_in_libraries{"fstream", "iostream", "filesystem", "print"};
  if (not_in_libraries.contains(name)) return false;
  if (name.find_first_of("/.") == std::string_view::npos) return true;
  if (name.ends_with("intrin.h")) return true;
  if (path.starts_with("libspatial/include/spatial/adapt/"))
    return name.starts_with("Eigen/") || name.starts_with("boost/geometry");
  if (path.starts_with("libcut/include/cut/adapt/")) return name.starts_with("oneapi/tbb/");
  return path.starts_with("libcut/") && name.starts_with("Eigen/");
}

/// The rule that an include breaks, in words; empty when it breaks none.
std::string broken_rule(const std::string& path, const Include& include) {
  const std::string_view target = include.target;
  if (target.empty()) {
    if (include.quoted) return "names no file of the project";
    if (in_library(path) && !may_use_external(path, include.name))
      return "is not for the libraries: they use the standard library without files and streams, and libcut "
             "Eigen";
    return {};
  }
  if (in_library(path)) {
    if (!in_library(target)) return "the libraries know nothing of programs, tests and benchmarks";
    if (target.starts_with("libspatial/include/spatial/adapt/") ||
        target.starts_with("libcut/include/cut/adapt/"))
      return "the adapters are for users to include, nothing else does";
    const std::string_view from = layer_of(path);
    const std::string_view to = layer_of(target);
    if (from.empty() || to.empty() || from == to) return {};  // a file without layer is reported on its own
    const auto layer = std::ranges::find(layers, from, &Layer::name);
    if (contains(layer->sees, to)) return {};
    return "layer " + std::string(from) + " does not see " + std::string(to);
  }
  const std::string_view folder = first_parts(path, 2);
  const std::string_view top = first_parts(path, 1);
  if (target.starts_with("libcut/src/") && !step_tests.contains(folder))
    return "only the tests of a step see libcut/src, everybody else the public headers";
  if (target.starts_with("apps/snip/") && folder != "apps/snip" && !app_tests.contains(folder))
    return "only the command line tool and its tests see apps/snip";
  for (const std::string_view other : {"tests", "bench", "examples"})
    if (first_parts(target, 1) == other && top != other)
      return "nothing outside of " + std::string(other) + " sees it";
  return {};
}

/// Depth-first search; `state` is 1 while a file is on the way from the root, 2 when it is done.
void find_circles(const std::map<std::string, std::vector<Include>>& graph, const std::string& path,
                  std::map<std::string, int>& state, std::vector<std::string>& way,
                  std::vector<std::string>& found) {
  state[path] = 1;
  way.push_back(path);
  for (const Include& include : graph.at(path)) {
    if (include.target.empty()) continue;
    if (state[include.target] == 1) {
      std::string circle = "include circle: ";
      for (auto step = std::ranges::find(way, include.target); step != way.end(); ++step)
        circle += *step + " -> ";
      found.push_back(circle + include.target);
    } else if (state[include.target] == 0) {
      find_circles(graph, include.target, state, way, found);
    }
  }
  way.pop_back();
  state[path] = 2;
}

/// The types that a header defines outside of other types, with the namespace of its first line that has one.
std::vector<std::string> types_of(const std::string& content) {
  static const std::regex space("(^|\\n)namespace ([a-z:]+) \\{");
  static const std::regex type(
      "(^|\\n)(struct|class) (alignas\\([0-9]+\\) )?(\\w+)( final)?( : [^{;]*)?( \\{)");
  std::smatch found;
  const std::string in = std::regex_search(content, found, space) ? found[2].str() + "::" : "";
  std::vector<std::string> names;
  for (std::sregex_iterator i(content.begin(), content.end(), type), end; i != end; ++i)
    names.push_back(in + (*i)[4].str());
  return names;
}

}  // namespace

std::vector<std::string> violations(const SourceTree& tree) {
  std::vector<std::string> found;
  std::map<std::string, std::vector<Include>> graph;
  for (const auto& [path, content] : tree) {
    graph[path] = includes_of(tree, path);
    if (in_library(path) && layer_of(path).empty())
      found.push_back(path +
                      ": has no layer. Enter it into the table `layers` of tests/architecture/rules.cpp, "
                      "or put it into the folder of its layer below libcut/src");
    if (!says_what_it_is_for(tree, path))
      found.push_back(path + ": begins without a comment that says what it is for");
    for (const Include& include : graph[path])
      if (const std::string rule = broken_rule(path, include); !rule.empty())
        found.push_back(path + ":" + std::to_string(include.line) + ": includes " + include.name + ": " +
                        rule);
  }
  // A linker takes one of two functions of the same name, also where they belong to different types.
  std::map<std::string, std::string> header_of;
  for (const auto& [path, content] : tree) {
    if (!in_library(path) || !path.ends_with(".hpp")) continue;
    for (const std::string& type : types_of(content))
      if (const auto [first, added] = header_of.try_emplace(type, path); !added && first->second != path)
        found.push_back(path + ": defines " + type + ", as " + first->second + " does");
  }
  std::map<std::string, int> state;
  std::vector<std::string> way;
  for (const auto& [path, includes] : graph)
    if (state[path] == 0) find_circles(graph, path, state, way, found);
  return found;
}

}  // namespace architecture
