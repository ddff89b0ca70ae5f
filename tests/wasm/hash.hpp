/// @file
/// One number for a result, equal on every compiler, optimisation level and machine exactly when all its bits
/// are: what `hashes` prints and tests/golden/hashes.txt keeps.
///
/// A new result to watch: one more `Case` in any file of this folder.
#pragma once
#include <cstdint>
#include <cut/hybrid_mesh.hpp>
#include <cut/triangle_mesh.hpp>

namespace hashes {

/// FNV-1a over 64-bit words.
class Hash {
 public:
  void add(std::uint64_t word);
  void add(double number);
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// Points, to the last bit, and triangles.
std::uint64_t hash(const cut::TriangleMesh& mesh);

/// Lattice coordinates and topology: ancestors, buffers, arrangements and edge states.
std::uint64_t hash(const cut::HybridMesh& mesh);

/// A named result; a global `const Case` enters itself into the list that main() prints in order of names.
struct Case {
  Case(const char* name, std::uint64_t (*compute)());
};

}  // namespace hashes
