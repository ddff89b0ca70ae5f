// Sequences of operations of dictionaries from bytes, against a list; the body is that of the property test.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "../spatial/dictionary_operations.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::size_t done = 0;
  const char* wrong = operations::run_dictionary(data, size, done);
  if (wrong != nullptr) {
    std::fprintf(stderr, "%s\n", wrong);
    std::abort();
  }
  return 0;
}
