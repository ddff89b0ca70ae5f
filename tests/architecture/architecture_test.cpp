// The include graph keeps to the layers, and files say what they are for; and the check that says so finds
// what is planted for it.
#include <doctest/doctest.h>

#include "architecture/rules.hpp"

using architecture::SourceTree;
using architecture::violations;

TEST_CASE("the project keeps to its layers") {
  const SourceTree tree = architecture::read_source_tree(SNIP_SOURCE_DIR);
  REQUIRE(tree.contains("libcut/include/cut/ids.hpp"));  // the right folder, and it was read
  for (const std::string& violation : violations(tree)) FAIL_CHECK(violation);
}

namespace {

/// A small tree in which every include is allowed and every file says what it is for.
SourceTree sound_tree() {
  SourceTree tree{
      {"libspatial/include/spatial/box.hpp", "#include <array>\n"},
      {"libspatial/include/spatial/adapt/eigen.hpp", "#include <Eigen/Core>\n#include \"spatial/box.hpp\"\n"},
      {"libcut/include/cut/ids.hpp", "#include <cstdint>\n"},
      {"libcut/include/cut/adapt/tbb.hpp", "#include <oneapi/tbb/parallel_for.h>\n"},
      {"libcut/include/cut/hybrid_mesh.hpp", "#include <Eigen/Core>\n#include \"cut/ids.hpp\"\n"},
      {"libcut/include/cut/changes.hpp", "#include \"cut/hybrid_mesh.hpp\"\n"},
      {"libcut/include/cut/validate.hpp", "#include \"cut/hybrid_mesh.hpp\"\n"},
      {"libcut/include/cut/cutter.hpp", "#include \"cut/changes.hpp\"\n"},
      {"libcut/include/cut/simulation.hpp", "#include \"cut/changes.hpp\"\n"},
      {"libcut/src/lattice/walk.hpp", "#include <cut/ids.hpp>\n#include <spatial/box.hpp>\n"},
      {"libcut/src/validate.cpp", "#include \"cut/validate.hpp\"\n"},
      {"libcut/src/cutting/detect.cpp", "#include \"cut/cutter.hpp\"\n#include \"lattice/walk.hpp\"\n"},
      {"apps/scenes/cloths.hpp", "#include \"cut/hybrid_mesh.hpp\"\n"},
      {"apps/snip/cut_command.hpp", "#include <fstream>\n#include \"scenes/cloths.hpp\"\n"},
      {"tests/cut/detect_test.cpp", "#include \"lattice/walk.hpp\"\n#include \"scenes/cloths.hpp\"\n"},
      {"tests/app/cut_command_test.cpp", "#include \"snip/cut_command.hpp\"\n"},
      {"bench/progressive.cpp", "#include \"scenes/cloths.hpp\"\n"},
  };
  for (auto& [path, content] : tree) content.insert(0, "// For a test.\n");
  return tree;
}

/// Adds a line to one file of the sound tree and expects a violation with these words in it.
void expect_violation(const std::string& path, const std::string& line, const std::string& words) {
  SourceTree tree = sound_tree();
  tree[path] += line + "\n";
  std::string all;
  for (const std::string& violation : violations(tree)) all += violation + "\n";
  INFO(path << " with " << line << " gives: " << all);
  CHECK_MESSAGE(all.find(words) != std::string::npos, "expected: " << words);
}

}  // namespace

TEST_CASE("a sound tree has no violation") { CHECK(violations(sound_tree()).empty()); }

TEST_CASE("planted violations of the layers are found") {
  const auto plant = [](const std::string& path, const std::string& header, const std::string& words) {
    expect_violation(path, "#include \"" + header + "\"", words);
  };
  plant("libcut/src/lattice/walk.hpp", "cut/hybrid_mesh.hpp", "lattice does not see mesh");
  plant("libcut/include/cut/hybrid_mesh.hpp", "cut/validate.hpp", "mesh does not see validate");
  plant("libcut/include/cut/changes.hpp", "cut/cutter.hpp", "changes does not see cutting");
  plant("libcut/src/validate.cpp", "cut/cutter.hpp", "validate does not see cutting");
  plant("libcut/src/simulation/step.cpp", "cut/cutter.hpp", "simulation does not see cutting");
  plant("libcut/src/cutting/detect.cpp", "cut/simulation.hpp", "cutting does not see simulation");
  plant("libspatial/include/spatial/box.hpp", "cut/ids.hpp", "spatial does not see base");
  plant("libspatial/include/spatial/box.hpp", "spatial/adapt/eigen.hpp", "nothing else does");
  plant("libcut/src/cutting/detect.cpp", "cut/adapt/tbb.hpp", "nothing else does");
  plant("libcut/src/cutting/detect.cpp", "scenes/cloths.hpp", "the libraries know nothing of");
}

TEST_CASE("planted violations outside of the libraries are found") {
  const auto plant = [](const std::string& path, const std::string& header, const std::string& words) {
    expect_violation(path, "#include \"" + header + "\"", words);
  };
  plant("apps/snip/cut_command.hpp", "lattice/walk.hpp", "only the tests of a step see libcut/src");
  plant("bench/progressive.cpp", "lattice/walk.hpp", "only the tests of a step see libcut/src");
  plant("tests/app/cut_command_test.cpp", "lattice/walk.hpp", "only the tests of a step see libcut/src");
  plant("bench/progressive.cpp", "snip/cut_command.hpp", "only the command line tool");
  plant("apps/scenes/cloths.hpp", "snip/cut_command.hpp", "only the command line tool");
  plant("apps/scenes/cloths.hpp", "cut/detect_test.cpp", "nothing outside of tests");
  plant("bench/progressive.cpp", "no_such_file.hpp", "names no file of the project");
}

TEST_CASE("planted dependencies of the libraries are found") {
  const auto plant = [](const std::string& path, const std::string& header) {
    expect_violation(path, "  #  include <" + header + ">", "is not for the libraries");
  };
  plant("libspatial/include/spatial/box.hpp", "Eigen/Core");
  plant("libspatial/include/spatial/box.hpp", "boost/geometry.hpp");
  plant("libcut/src/validate.cpp", "boost/geometry.hpp");
  plant("libcut/src/validate.cpp", "iostream");
  plant("libcut/src/validate.cpp", "fstream");
}

TEST_CASE("a planted circle is found and named") {
  expect_violation("libcut/include/cut/ids.hpp", "#include \"cut/changes.hpp\"",
                   "include circle: libcut/include/cut/hybrid_mesh.hpp -> libcut/include/cut/ids.hpp -> "
                   "libcut/include/cut/changes.hpp -> libcut/include/cut/hybrid_mesh.hpp");
}

TEST_CASE("a file without a layer is told where to get one") {
  for (const std::string path : {"libcut/include/cut/unheard_of.hpp", "libcut/src/unheard_of/step.cpp"})
    expect_violation(path, "", path + ": has no layer. Enter it into the table `layers`");
}

TEST_CASE("a file that does not say what it is for is named") {
  const auto count = [](const std::string& path, const std::string& content) {
    SourceTree tree = sound_tree();
    tree[path] = content;
    const auto found = violations(tree);
    for (const std::string& violation : found)
      CHECK(violation == path + ": begins without a comment that says what it is for");
    return found.size();
  };
  CHECK(count("bench/silent.cpp", "#include <array>\n// Too late.\n") == 1);
  CHECK(count("libcut/src/lattice/silent.hpp", "#pragma once\n") == 1);
  CHECK(count("libcut/src/lattice/walk.hpp", "#pragma once\n") == 1);
  CHECK(count("libcut/src/lattice/silent.cpp", "") == 1);
  CHECK(count("libcut/src/lattice/walk.cpp", "#include \"lattice/walk.hpp\"\n") == 0);  // its header says it
  CHECK(count("libcut/src/mesh/walk.cpp", "#include \"lattice/walk.hpp\"\n") == 1);     // not beside it
  CHECK(count("examples/cut.cpp", "#include <cut/ids.hpp>\n") == 0);
}

TEST_CASE("a type that two headers define is found, unless their namespaces differ") {
  const std::string path = "libcut/src/lattice/twin.hpp";
  const auto count = [&](const std::string& space, const std::string& type) {
    SourceTree tree = sound_tree();
    const auto in = [](const std::string& name, const std::string& body) {
      return "/// A type.\nnamespace " + name + " {\n" + body + "\n}\n";
    };
    tree["libcut/src/mesh/original.hpp"] =
        in("cut", "struct Walk {\n  struct Gate {};\n};\nclass Way;\nclass Door : Walk {};");
    tree[path] = in(space, type);
    const auto found = violations(tree);
    for (const std::string& violation : found) CHECK(violation.find(": defines cut::") != std::string::npos);
    return found.size();
  };
  CHECK(count("cut", "class Walk {};") == 1);
  CHECK(count("cut", "struct alignas(32) Door final {};") == 1);
  CHECK(count("cut", "class Walk;") == 0);
  CHECK(count("cut", "class Gate {};\nclass Way {};") == 0);
  CHECK(count("cut::lattice", "class Walk {};") == 0);
}

TEST_CASE("what a comment says is no include") {
  SourceTree tree = sound_tree();
  tree["bench/progressive.cpp"] += "// #include \"lattice/walk.hpp\"\n";
  CHECK(violations(tree).empty());
}
