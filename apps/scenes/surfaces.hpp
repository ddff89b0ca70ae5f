/// @file
/// Curved cloths: sheets, closed surfaces, and one that has only one side. Used by the app, tests and
/// benchmarks. Every function gives the same bits on every compiler and machine.
#pragma once
#include <cstddef>
#include <cut/triangle_mesh.hpp>

namespace scenes {

/// A square sheet of cells × cells squares over [0, side]², 2 · cells² triangles, with smooth bumps in z
/// between -height and height: one and a half waves along x, one along y.
cut::TriangleMesh curved_sheet(std::size_t cells, double side = 1, double height = 0.1);

/// An icosahedron whose triangles are split in four `level` times: 20 · 4^level triangles, wound
/// counterclockwise seen from outside.
cut::TriangleMesh sphere(std::size_t level, double radius = 1);

/// A torus round the z axis, 2 · around · through triangles. @pre around, through > 2
cut::TriangleMesh torus(std::size_t around, std::size_t through, double radius = 1, double tube_radius = 0.4);

/// An open tube round the z axis from z = 0 to z = height, 2 · around · along triangles. @pre around > 2
cut::TriangleMesh cylinder(std::size_t around, std::size_t along, double radius = 1, double height = 2);

/// A band round the z axis with half a twist, 2 · around · across triangles. It has one border and no
/// consistent winding: the triangles of the last column meet those of the first turned over. @pre around > 4
cut::TriangleMesh moebius_strip(std::size_t around, std::size_t across, double radius = 1,
                                double width = 0.6);

}  // namespace scenes
