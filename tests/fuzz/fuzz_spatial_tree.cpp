// Sequences of tree operations from bytes, against a list of boxes; the body is that of the property test.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "../spatial/operations.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const char* wrong = nullptr;
  switch (data[0] % 4) {
    case 0:
      wrong = operations::Run<float, 2>().run(data + 1, size - 1);
      break;
    case 1:
      wrong = operations::Run<double, 3>().run(data + 1, size - 1);
      break;
    case 2:
      wrong = operations::Run<std::int32_t, 2>().run(data + 1, size - 1);
      break;
    default:
      wrong = operations::Run<std::uint8_t, 1>().run(data + 1, size - 1);
      break;
  }
  if (wrong != nullptr) {
    std::fprintf(stderr, "%s\n", wrong);
    std::abort();
  }
  return 0;
}
