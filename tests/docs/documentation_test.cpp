// What README.md and docs/ say and show is so: code, output, links, pictures and the names of rules.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <regex>
#include <set>

#include "docs/page_testing.hpp"
#include "docs/svg.hpp"

namespace fs = std::filesystem;
using docs::output_of;
using docs::root;
using docs::text_of;

namespace {

/// The fenced block that follows the comment <!-- name --> in README.md.
std::string block(const std::string& name) {
  const std::string readme = text_of(root / "README.md");
  const std::size_t comment = readme.find("<!-- " + name + " -->\n```");
  REQUIRE_MESSAGE(comment != std::string::npos, name);
  const std::size_t begin = readme.find('\n', readme.find("```", comment)) + 1;
  return readme.substr(begin, readme.find("```", begin) - begin);
}

std::vector<fs::path> pages() {
  std::vector<fs::path> found{root / "README.md", root / "CONTRIBUTING.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  return found;
}

}  // namespace

TEST_CASE("the README's samples are the files in examples, and print what it says") {
  for (const std::string name : {"spatial", "cut"}) {
    CHECK(block("examples/" + name + ".cpp") == text_of(root / "examples" / (name + ".cpp")));
    CHECK(block("output of examples/" + name + ".cpp") == output_of("example_" + name));
  }
}

TEST_CASE("the README's session with snip prints what it says") {
  const fs::path folder = fs::temp_directory_path() / ("snip_docs_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  fs::create_directory_symlink(root / "examples", folder / "examples");
  std::istringstream session(block("session"));
  std::string line, command, expected;
  const auto check = [&] {
    if (!command.empty())
      CHECK_MESSAGE(output_of("cd " + folder.string() + " && " + command) == expected, command);
  };
  while (std::getline(session, line)) {
    if (line.starts_with("$ ")) {
      check();
      command = line.substr(2);
      expected.clear();
    } else {
      expected += line + "\n";
    }
  }
  check();
  fs::remove_all(folder);
}

TEST_CASE("links lead to files that are there, and every picture is shown") {
  const std::regex link(R"(\]\(([^)#:\s]+)(#[^)]*)?\))");
  std::set<fs::path> targets;
  for (const fs::path& page : pages()) {
    const std::string text = text_of(page);
    for (auto m = std::sregex_iterator(text.begin(), text.end(), link); m != std::sregex_iterator(); ++m) {
      const fs::path target = (page.parent_path() / (*m)[1].str()).lexically_normal();
      CHECK_MESSAGE(fs::exists(target), page.filename().string() << ": " << target.string());
      targets.insert(target);
    }
  }
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs/pictures"))
    if (entry.is_regular_file())
      CHECK_MESSAGE(targets.contains(entry.path().lexically_normal()), entry.path().string()
                                                                           << " is not shown");
}

TEST_CASE("docs/data_model.md lists the rules that validate reports, and no others") {
  std::set<std::string> reported, listed;
  const auto collect = [](const std::string& text, const std::regex& pattern, std::set<std::string>& names) {
    for (auto m = std::sregex_iterator(text.begin(), text.end(), pattern); m != std::sregex_iterator(); ++m)
      names.insert((*m)[1].str());
  };
  for (const auto& entry : fs::directory_iterator(root / "libcut/src/validate"))
    collect(text_of(entry.path()), std::regex(R"re((?:add\(|fail\(|rule = )\s*"([a-z_]+)")re"), reported);
  const std::string page = text_of(root / "docs/data_model.md");
  collect(page.substr(page.find("## Rules")), std::regex(R"(\n\| `([a-z_]+)` \|)"), listed);
  std::vector<std::string> odd;
  std::set_symmetric_difference(reported.begin(), reported.end(), listed.begin(), listed.end(),
                                std::back_inserter(odd));
  for (const std::string& rule : odd) FAIL_CHECK(rule);
  CHECK(reported.size() > 10);
}

TEST_CASE("the drawings in docs/pictures are what comes out") {
  // SNIP_WRITE_PICTURES=1 test_docs writes them anew: look at them, and at the text around them.
  for (const auto& [name, svg] : docs::pictures()) {
    const fs::path path = root / "docs/pictures" / name;
    if (std::getenv("SNIP_WRITE_PICTURES") != nullptr) std::ofstream(path, std::ios::binary) << svg;
    const bool same = text_of(path) == svg;
    CHECK_MESSAGE(same, name << " has changed; if so on purpose: SNIP_WRITE_PICTURES=1 test_docs");
  }
}
