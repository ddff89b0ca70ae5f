// Pictures of a scene, see scene_picture.hpp.
#include "snip/run/scene_picture.hpp"

#include <algorithm>
#include <cmath>
#include <scenes/cutters.hpp>
#include <scenes/surfaces.hpp>

namespace snip {
namespace {

using Eigen::Vector3d;

constexpr Colour physics_green{36, 140, 60};
constexpr Colour anchor_blue{25, 60, 150};
constexpr Colour cut_red{170, 40, 30};
constexpr Colour cutter_red{205, 60, 60};
constexpr Colour blade_blue{60, 90, 190};
constexpr Colour obstacle_grey{190, 190, 195};

/// For how long a cutter that cuts at once is shown before and after, seconds.
constexpr double shown_before = 0.1, shown_after = 0.2;

void add_surface(const SceneRun& run, Drawing& drawing) {
  const cut::HybridMesh& mesh = run.mesh();
  Surface& surface = drawing.surface;
  for (const cut::RenderVertex& v : mesh.buffers.render_vertices)
    surface.positions.push_back(v.triangle.valid() ? mesh.position(v) : Vector3d::Zero());
  for (const cut::RenderTriangle& t : mesh.buffers.render_triangles) {
    if (!t.triangle.valid()) continue;
    surface.triangles.push_back({t.vertices[0].value, t.vertices[1].value, t.vertices[2].value});
    surface.colours.push_back(
        piece_colour(run.scene().output.colour_pieces ? run.colours().of(t.triangle) : 0));
  }
}

void add_solid(const cut::TriangleMesh& mesh, Surface& surface) {
  const auto first = static_cast<std::uint32_t>(surface.positions.size());
  surface.positions.insert(surface.positions.end(), mesh.positions.begin(), mesh.positions.end());
  for (const auto& [a, b, c] : mesh.triangles) {
    surface.triangles.push_back({first + a, first + b, first + c});
    surface.colours.push_back(obstacle_grey);
  }
}

/// Where they are now, a little smaller: only nodes are kept out, so that cloth dips in between them.
void add_obstacles(const SceneRun& run, Surface& surface) {
  Eigen::AlignedBox3d cloth;
  for (const Vector3d& p : run.cloth().positions) cloth.extend(p);
  const double size = cloth.diagonal().stableNorm();
  for (const cut::Sphere& ball : run.simulation().surroundings.spheres)
    add_solid(scenes::moved(scenes::sphere(4, 0.98 * ball.radius), ball.centre), surface);
  for (const cut::HalfSpace& half_space : run.simulation().surroundings.half_spaces) {
    const Vector3d normal = half_space.normal.stableNormalized(), u = normal.unitOrthogonal();
    const double height = (cloth.center() - half_space.point).dot(normal) + 0.005 * size;
    const Vector3d middle = cloth.center() - height * normal;
    add_solid(scenes::plane(middle, 3 * size * u, 3 * size * normal.cross(u)), surface);
  }
}

void add_physics(const SceneRun& run, double width, Drawing& drawing) {
  const cut::HybridMesh& mesh = run.mesh();
  for (const cut::Spring& spring : mesh.buffers.springs)
    if (spring.edge.valid())
      drawing.lines.push_back({mesh.positions[spring.nodes[0].index()],
                               mesh.positions[spring.nodes[1].index()], physics_green, width});
  const double diameter = 3.2 * width;
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    const bool anchored = run.simulation().anchored(cut::NodeId{n});
    if (anchored || diameter > 3)
      drawing.dots.push_back({mesh.positions[n], anchored ? anchor_blue : physics_green,
                              anchored ? std::max(1.4 * diameter, 3.0) : diameter});
  }
}

Vector3d position(const cut::HybridMesh& mesh, cut::TriangleId triangle, cut::LatticePoint point) {
  return mesh.position({triangle, mesh.buffers.triangles[triangle.index()].nodes, point});
}

/// Both lips of every cut, opened or not.
void add_cuts(const cut::HybridMesh& mesh, double width, Drawing& drawing) {
  const auto add = [&](cut::TriangleId triangle, cut::LatticePoint from, cut::LatticePoint to) {
    drawing.lines.push_back({position(mesh, triangle, from), position(mesh, triangle, to), cut_red, width});
  };
  for (std::size_t t = 0; t < mesh.ancestors.triangles.size(); ++t) {
    const cut::AncestorId ancestor{t};
    if (const cut::Arrangement* a = mesh.arrangement(ancestor))
      for (const cut::CutEdge& edge : a->edges) {
        const cut::LatticePoint from = a->nodes[edge.from].point, to = a->nodes[edge.to].point;
        add(a->polygons[edge.left].triangle, from, to);
        if (edge.right != edge.left) add(a->polygons[edge.right].triangle, from, to);
      }
    for (std::size_t i = 0; i < 3; ++i) {
      const cut::EdgeState* state = mesh.edge_state(mesh.ancestors.triangles[t].edges[i]);
      if (!state) continue;
      const bool reversed = mesh.ancestors.reversed(ancestor, i);
      const std::size_t sections = state->cut.size();
      for (std::size_t k = 0; k < sections; ++k) {
        if (!state->cut[k]) continue;
        const auto along = [&](std::size_t node) {  // lattice units from the start of the ancestor edge
          return node == 0 ? 0 : node == sections ? cut::lattice_size : state->nodes[node - 1].t;
        };
        const auto point = [&](std::size_t node) {
          return cut::lattice_point_on_edge(i, reversed ? cut::lattice_size - along(node) : along(node));
        };
        const cut::Arrangement* a = mesh.arrangement(ancestor);
        const std::size_t section = reversed ? sections - 1 - k : k;
        add(mesh.fragment(ancestor, a ? a->section_polygons[i][section] : 0), point(k), point(k + 1));
      }
    }
  }
}

void add_mesh(const cut::TriangleMesh& mesh, Colour colour, double opacity, Drawing& drawing) {
  for (const auto& [a, b, c] : mesh.triangles)
    drawing.panes.push_back({{mesh.positions[a], mesh.positions[b], mesh.positions[c]}, colour, opacity});
}

void add_cutters(const SceneRun& run, double width, Drawing& drawing) {
  const Scene& scene = run.scene();
  const double now = run.frame().time, frame_time = scene.frame_time();
  for (std::size_t i = 0; i < scene.cutters.size(); ++i) {
    const StaticCutter& cutter = scene.cutters[i];
    const double before = std::max(shown_before, frame_time), after = std::max(shown_after, frame_time);
    for (const std::size_t repetition : repetitions_between(cutter, now - after, now + before)) {
      const Vector3d offset = static_cast<double>(repetition) * cutter.step;
      add_mesh(scenes::moved(run.cutter_meshes()[i], offset), cutter_red, 0.4, drawing);
    }
  }
  for (const MovingBlade& blade : scene.blades) {
    if (now < blade.keyframes.front().at || now > blade.keyframes.back().at + frame_time) continue;
    const scenes::Path edge = blade_at(blade, now);
    // The way of the last tenth of a second as a trace behind the blade.
    const double trace = std::max(0.1, 2 * frame_time);
    add_mesh(scenes::swept(blade_at(blade, now - trace), edge), blade_blue, 0.35, drawing);
    for (std::size_t k = 1; k < edge.size(); ++k)
      drawing.lines.push_back({edge[k - 1], edge[k], blade_blue, 2 * width});
  }
}

}  // namespace

Camera scene_camera(const SceneRun& run) {
  const OutputSettings& output = run.scene().output;
  Eigen::AlignedBox3d box;
  if (output.view_box) {
    box = *output.view_box;
  } else {
    for (const Vector3d& p : run.cloth().positions) box.extend(p);
    const Vector3d down = run.scene().surroundings.gravity;
    if (const double size = box.diagonal().norm(); down.norm() > 0) {
      const Eigen::AlignedBox3d lower = box.translated(down.normalized() * size / 4);
      box.extend(lower);
    }
  }
  return {output.view, box, output.width, output.height};
}

double pixels_per_edge(const SceneRun& run, const Camera& camera) {
  const cut::AncestorMesh& ancestors = run.mesh().ancestors;
  double length = 0;
  for (std::size_t e = 0; e < ancestors.edges.size(); ++e)
    length += ancestors.rest_length(cut::AncestorEdgeId{e});
  length /= static_cast<double>(ancestors.edges.size());
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : ancestors.rest_positions)
    middle += p / static_cast<double>(ancestors.rest_positions.size());
  const Vector3d in_view = camera.to_view(middle);
  if (in_view.z() < camera.near_limit()) return length;
  return std::abs(camera.to_screen(in_view + Vector3d(length, 0, 0)).x - camera.to_screen(in_view).x);
}

Drawing scene_drawing(const SceneRun& run, double pixels_per_edge) {
  // In a fine cloth the lines would hide the cloth: they fade faster than the triangles shrink.
  const double share = pixels_per_edge / 15, width = std::clamp(share < 1 ? share * share : share, 0.05, 2.0);
  Drawing drawing;
  add_surface(run, drawing);
  add_obstacles(run, drawing.surface);
  if (run.scene().output.show_physics) {
    add_physics(run, width, drawing);
    add_cuts(run.mesh(), std::max(0.8 * width, 0.8), drawing);
  }
  if (run.scene().output.show_cutters) add_cutters(run, std::max(width, 1.0), drawing);
  return drawing;
}

}  // namespace snip
