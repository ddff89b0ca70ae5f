// Random cut sequences: every check of random_cuts::run after every cut.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "../cut/random_cuts.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string failure = random_cuts::run(data, size);
  if (!failure.empty()) {
    std::fprintf(stderr, "%s\n", failure.c_str());
    std::abort();
  }
  return 0;
}
