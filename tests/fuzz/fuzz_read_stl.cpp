// Any bytes as STL: the reader gives a sound mesh or one line that says what is wrong.
#include "read_mesh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::read_mesh(data, size, snip::MeshFormat::stl);
}
