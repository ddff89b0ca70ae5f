// The command line: help, exit codes, one line for each error.
#include "cli_testing.hpp"

using cli_testing::is_one_error;
using mesh_testing::TemporaryDirectory;

TEST_CASE("cli: help for the program and for every command, version") {
  const TemporaryDirectory directory;
  const auto help = cli_testing::snip(directory, "--help");
  CHECK(help.exit_code == 0);
  CHECK(help.err.empty());
  for (const char* command : {"cut", "run", "weld", "validate"}) {
    CHECK(help.out.find(command) != std::string::npos);
    const auto own = cli_testing::snip(directory, std::string(command) + " --help");
    CHECK(own.exit_code == 0);
    CHECK(own.err.empty());
    CHECK(own.out.find("Usage: snip " + std::string(command)) != std::string::npos);
  }
  const auto version = cli_testing::snip(directory, "--version");
  CHECK(version.exit_code == 0);
  CHECK(version.out.starts_with("snip "));
}

TEST_CASE("cli: a command that there is not is named") {
  const TemporaryDirectory directory;
  const auto run = cli_testing::snip(directory, "fold a.obj");
  CHECK(run.exit_code == 2);
  CHECK(run.err == "snip: error: there is no command fold (see snip --help)\n");
}

TEST_CASE("cli: bad usage is one line and exit code 2") {
  const TemporaryDirectory directory;
  for (const char* arguments : {"",
                                "fold",
                                "cut",
                                "cut a.obj",
                                "cut a.obj b.obj",
                                "cut a.obj b.obj -o",
                                "cut a.obj b.obj -o c.obj d.obj",
                                "cut a.obj b.obj -o c.obj --merge-cut wide",
                                "cut a.obj b.obj -o c.obj --unknown",
                                "weld a.obj -o b.obj",
                                "weld a.obj -d 0 -o b.obj",
                                "weld a.obj -d -1 -o b.obj",
                                "weld a.obj -d x -o b.obj",
                                "weld a.obj -d 1",
                                "validate",
                                "validate a.obj b.obj",
                                "run",
                                "run s.json --frames 0",
                                "run s.json --frames 10000001",
                                "run s.json --frames 1e3",
                                "weld a.obj -d inf -o b.obj",
                                "weld a.obj -d nan -o b.obj",
                                "weld a.obj -d '' -o b.obj",
                                "weld a.obj -d 1,5 -o b.obj",
                                "weld '' -d 1 -o b.obj",
                                "weld a.obj -d 1 -o ''",
                                "weld a.obj -d 1 -o b.obj --stats ''",
                                "validate ''",
                                "run ''",
                                "run s.json -o ''",
                                "cut '' b.obj -o c.obj",
                                "cut a.obj '' -o c.obj",
                                "cut a.obj b.obj -o ''",
                                "cut a.obj b.obj -o c.obj --merge-edge 0",
                                "cut a.obj b.obj -o c.obj --merge-cut nan",
                                "cut a.obj b.obj -o c.obj --merge-node -1",
                                "cut a.obj b.obj -o c.obj --merge-node inf"}) {
    const auto outcome = cli_testing::snip(directory, arguments);
    CHECK_MESSAGE(outcome.exit_code == 2, arguments);
    CHECK_MESSAGE(is_one_error(outcome.err), arguments << ": " << outcome.err);
    CHECK_MESSAGE(outcome.err.size() < 120, arguments << ": " << outcome.err);
    CHECK_MESSAGE(outcome.out.empty(), arguments);
  }
  CHECK(directory.file_count() == 0);
}

TEST_CASE("cli: bad input is one line and exit code 1, and nothing is written") {
  const TemporaryDirectory directory;
  directory.write("good.obj", cli_testing::sheet_obj(2));
  directory.write("empty.obj", "");
  directory.write("cut_off.ply", "ply\nformat ascii 1.0\nelement vertex 3\n");
  directory.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 2 1\n");
  const std::size_t files = directory.file_count();
  const std::pair<const char*, const char*> cases[] = {
      {"cut no.obj good.obj -o out.obj", "snip: error: no.obj: no such file\n"},
      {"cut good.obj no.obj -o out.obj", "snip: error: no.obj: no such file\n"},
      {"cut good.obj good.obj -o no/out.obj",
       "snip: error: no/out.obj: cannot be written: No such file or directory\n"},
      {"cut good.obj good.obj -o out.xyz",
       "snip: error: out.xyz: unknown kind of mesh file: the name must end in .obj, .ply, .stl or .off\n"},
      {"weld empty.obj -d 1 -o out.obj", "snip: error: empty.obj: the file is empty\n"},
      {"weld cut_off.ply -d 1 -o out.obj",
       "snip: error: cut_off.ply:3: the header ends without 'end_header'\n"},
      {"weld good.obj -d 1e-300 -o out.obj", nullptr},
      {"weld good.obj -d 10 -o out.obj", "snip: error: good.obj: no triangle is left: 8 without area\n"},
      {"run no.json", "snip: error: no.json: no such file\n"},
      {"validate line.obj", "snip: error: line.obj: no triangle is left: 2 without area\n"},
      {"cut good.obj good.obj -o out.obj --merge-cut 1 --merge-node 2", nullptr},
      {"cut good.obj good.obj -o out.obj --merge-edge 1e-300", nullptr},
  };
  for (const auto& [arguments, message] : cases) {
    const auto outcome = cli_testing::snip(directory, arguments);
    CHECK_MESSAGE(outcome.exit_code == 1, arguments);
    CHECK_MESSAGE(is_one_error(outcome.err), arguments << ": " << outcome.err);
    if (message) CHECK(outcome.err == message);
    CHECK_MESSAGE(directory.file_count() == files, arguments);
  }
}

TEST_CASE("cli: validate says what a mesh consists of, or the first reason why it cannot be cut") {
  const TemporaryDirectory directory;
  directory.write("sheet.obj", cli_testing::sheet_obj(3));
  const auto good = cli_testing::snip(directory, "validate sheet.obj");
  CHECK(good.exit_code == 0);
  CHECK(good.err.empty());
  CHECK(good.out ==
        "sheet.obj: 16 vertices, 18 triangles, 1 piece\n"
        "piece_0: area 9, 18 triangles, 1 boundary loop, Euler characteristic 1\n");

  directory.write("book.obj",
                  "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 1 2\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
  const auto book = cli_testing::snip(directory, "validate book.obj");
  CHECK(book.exit_code == 1);
  CHECK(
      book.err.starts_with("snip: warning: book.obj: dropped triangles: 1 without area\n"
                           "snip: error: book.obj: the edge between points 0 and 1 belongs to 3 triangles"));
  CHECK(book.err.find("face 1 of the file") != std::string::npos);
}
