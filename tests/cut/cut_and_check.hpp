/// @file
/// A mesh that is cut again and again, with every check after each cut: `validate`, and the change set
/// applied to a copy of the old buffers, and what it says of where things come from.
#pragma once
#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "cut/cutter.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cut/validate.hpp"
#include "provenance.hpp"

/// All violations as one text; empty when there is none.
inline std::string violations(const cut::HybridMesh& mesh) {
  std::string text;
  for (const cut::Violation& v : cut::validate(mesh, 5)) text += v.rule + ": " + v.message + "\n";
  return text;
}

struct Session {
  cut::HybridMesh mesh;
  cut::Cutter cutter;

  explicit Session(const cut::TriangleMesh& cloth) : Session(build(cloth)) {}
  Session(const cut::TriangleMesh& cloth, const cut::MergeDistances& distances)
      : mesh(build(cloth)), cutter(distances) {}
  explicit Session(cut::HybridMesh built)
      : mesh(std::move(built)), cutter(cut::default_merge_distances(mesh)) {}

  /// Cuts, checks everything that must hold, and returns what changed.
  cut::Changes cut(const cut::TriangleMesh& blade) {
    cut::Buffers copy = mesh.buffers;
    const auto bending = provenance::all_bending_pairs(mesh);
    auto result = cutter.cut(mesh, blade);
    REQUIRE(result.has_value());
    const cut::Changes back = cut::inverse(*result, copy);
    const cut::Buffers before = copy;
    REQUIRE(provenance::fault(*result, before, bending, mesh) == "");
    cut::apply(*result, copy);
    REQUIRE(copy == mesh.buffers);
    cut::apply(back, copy);
    REQUIRE(copy == before);
    REQUIRE(violations(mesh) == "");
    return std::move(result).value();
  }

 private:
  static cut::HybridMesh build(const cut::TriangleMesh& cloth) {
    auto result = cut::HybridMesh::build(cloth);
    REQUIRE(result.has_value());
    return std::move(result).value();
  }
};
