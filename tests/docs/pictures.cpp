// The pictures of docs/: small cuts on flat cloth, drawn as they come out.
#include <algorithm>
#include <cmath>
#include <cut/cutter.hpp>
#include <scenes/cloths.hpp>
#include <scenes/cutters.hpp>
#include <utility>

#include "docs/svg.hpp"

namespace docs {
namespace {

using Lines = std::vector<std::pair<Point, Point>>;

/// Two equilateral triangles A B C and B D C with sides of length 1 (the paper's Figure 3).
const cut::TriangleMesh two_triangles{{{0, 0, 0}, {1, 0, 0}, {0.5, 0.866, 0}, {1.5, 0.866, 0}},
                                      {{0, 1, 2}, {1, 3, 2}}};
/// Larger than the default ones, so that they can be seen.
const cut::MergeDistances distances{0.16, 0.08, 0.04};
constexpr const char* blue = "#3060c0";

struct Cloth {
  cut::HybridMesh mesh = cut::HybridMesh::build(two_triangles).value();
  cut::Cutter cutter{distances};

  /// Cuts along all lines at once.
  void cut(const Lines& lines) {
    std::vector<cut::TriangleMesh> walls;
    for (const auto& [a, b] : lines)
      walls.push_back(scenes::ribbon({{a.x(), a.y(), 0}, {b.x(), b.y(), 0}}, {0, 0, 1}));
    (void)cutter.cut(mesh, scenes::joined(walls));
  }
};

void draw_lines(Svg& svg, const Lines& lines) {
  for (const auto& [a, b] : lines) svg.line(a, b, blue, 2, true);
}

Lines chain(const std::vector<Point>& points) {
  Lines lines;
  for (std::size_t i = 1; i < points.size(); ++i) lines.emplace_back(points[i - 1], points[i]);
  return lines;
}

std::string element_names() {
  Cloth cloth;
  cloth.cut({{{0.2, -0.2}, {0.62, 0.45}}, {{0.62, 0.45}, {0.9, 0.55}}});
  cloth.cut({{{0.3, 0.6}, {0.48, 0.23}}});
  Svg svg(640, 400, 330);
  svg.panel(60, 320, "");
  svg.mesh(cloth.mesh);
  const auto name = [&](const Point& at, double dx, double dy, const std::string& words) {
    svg.text(at, dx, dy, words, "#222");
  };
  name({0, 0}, -30, 26, "physics node");
  name({0.33, 0}, -30, 26, "boundary node");
  name({0.45, 0.2}, 22, 22, "cut with two sides: contour edges");
  name({0.75, 0.433}, 28, 24, "shared edge");
  name({0.9, 0.55}, 10, 4, "inner node");
  name({0.8, 0.5}, -32, -24, "internal edge");
  name({0.1, 0.3}, -70, 0, "contour edge");
  return svg.str();
}

std::string merge_ends() {
  Cloth cloth;
  const Lines lines{{{0.35, 0.25}, {0.94, 0.05}}, {{0.45, 0.45}, {0.69, 0.47}}, {{0.95, 0.7}, {1.2, 0.6}}};
  Svg svg(860, 330, 240);
  svg.panel(30, 250, "lines as detected; rings: δn of the nodes");
  svg.mesh(cloth.mesh);
  for (const auto& p : two_triangles.positions) svg.ring({p.x(), p.y()}, distances.node);
  draw_lines(svg, lines);
  svg.panel(450, 250, "one end on node, one on edge, others free");
  cloth.cut(lines);
  svg.mesh(cloth.mesh);
  return svg.str();
}

std::string merge_nodes() {
  Cloth cloth;
  cloth.cut({{{0.42, 0.36}, {0.37, 0.6}}, {{0.6, 0.31}, {0.62, 0.08}}});
  const Lines line{{{0.1, 0.34}, {1.3, 0.34}}};
  Svg svg(860, 330, 240);
  svg.panel(30, 250, "a line passes two nodes within δe");
  svg.mesh(cloth.mesh);
  draw_lines(svg, line);
  svg.panel(450, 250, "it is led through them");
  cloth.cut(line);
  svg.mesh(cloth.mesh);
  return svg.str();
}

std::string join_intersections() {
  Cloth cloth;
  const Lines lines{{{0.3, 0.12}, {0.55, 0.55}}, {{0.22, 0.3}, {0.7, 0.2}}, {{1.0, 0.4}, {1.05, 0.8}}};
  cloth.cut(lines);
  const Lines later{{{0.85, 0.6}, {1.3, 0.66}}};
  Svg svg(860, 330, 240);
  svg.panel(30, 250, "lines that cross each other and an old cut");
  draw_lines(svg, {lines[0], lines[1]});
  Cloth old;
  old.cut({lines[2]});
  svg.mesh(old.mesh);
  draw_lines(svg, {lines[0], lines[1], later[0]});
  svg.panel(450, 250, "a node at each crossing");
  cloth.cut(later);
  svg.mesh(cloth.mesh);
  return svg.str();
}

std::string cut_along() {
  Cloth cloth;
  const Lines line{{{1.05, -0.087}, {0.45, 0.953}}};
  Svg svg(900, 330, 240);
  svg.panel(30, 250, "along the common edge");
  svg.mesh(cloth.mesh);
  draw_lines(svg, line);
  svg.panel(450, 250, "shared becomes contour: no new triangle");
  cloth.cut(line);
  svg.mesh(cloth.mesh, {{0, 0}, {0.15, 0}});
  return svg.str();
}

/// A blade on a curve through both triangles, a call to cut for each step of this length.
void draw_blade(Svg& svg, double x, double step, const cut::MergeDistances& merge, const std::string& title) {
  Cloth cloth;
  cloth.cutter = cut::Cutter(merge);
  const auto way = [](double along) {
    const double turn = 2.2 * along;
    return Point{0.02 + 1.03 * along, 0.3 + 0.28 * std::sin(turn * turn - 0.6)};
  };
  svg.panel(x, 250, title);
  Lines steps;
  Point last = way(0);
  for (double along = 0; along < 1.2; along += 0.001)
    if (const Point here = way(along); (here - last).norm() >= step) {
      steps.emplace_back(last, here);
      last = here;
    }
  for (const auto& s : steps) cloth.cut({s});
  svg.mesh(cloth.mesh);
  for (const auto& [a, b] : steps) svg.line(a, b, blue, 1);
  for (const auto& s : steps) svg.dot(s.second, 1.5, blue, blue);
}

std::string merge_adjacent() {
  Svg svg(860, 330, 240);
  draw_blade(svg, 30, 0.05, {0.002, 0.002, 0.001}, "δe = 0.001");
  draw_blade(svg, 450, 0.05, {0.04, 0.04, 0.02}, "δe = 0.02");
  return svg.str();
}

std::string small_steps() {
  const cut::MergeDistances paper{0.1, 0.05, 0.025};
  Svg svg(1280, 330, 240);
  draw_blade(svg, 30, 0.12, paper, "steps of 0.12");
  draw_blade(svg, 450, 0.06, paper, "steps of 0.06, less than δc = 0.1");
  draw_blade(svg, 870, 0.02, paper, "steps of 0.02");
  return svg.str();
}

std::string faces() {
  Cloth cloth;
  cloth.cut(chain({{0.35, 0.15}, {0.65, 0.15}, {0.7, 0.3}, {0.5, 0.45}, {0.35, 0.3}, {0.35, 0.15}}));
  cloth.cutter = cut::Cutter(distances);  // it does not know the nodes of the ring as those of its last cut
  cloth.cut({{{0.45, 0.22}, {0.56, 0.3}}, {{0.2, 0.5}, {0.55, 0.6}}, {{0.55, 0.6}, {0.8, 1}}});
  Svg svg(1180, 330, 190);
  svg.panel(30, 220, "a ring, a slit in it, a cut through");
  svg.mesh(cloth.mesh);
  svg.panel(340, 220, "three pieces, moved apart: each fragment has a whole physics triangle");
  svg.mesh(cloth.mesh, {{0, 0}, {1.6, 0}, {2.75, 0}});
  return svg.str();
}

/// Writes beside each node how many there are of it.
void count_copies(Svg& svg, const cut::HybridMesh& mesh) {
  const std::vector<std::string> names{"A", "B", "C", "D"};
  const std::vector<Point> shift{{-24, 20}, {8, 20}, {-24, -10}, {-4, -10}};
  for (std::size_t n = 0; n < names.size(); ++n) {
    const auto copies =
        std::count(mesh.buffers.nodes.begin(), mesh.buffers.nodes.end(), cut::AncestorNodeId{n});
    const auto& p = mesh.ancestors.rest_positions[n];
    svg.text({p.x(), p.y()}, shift[n].x(), shift[n].y(), names[n] + " × " + std::to_string(copies),
             "#248c3c");
  }
}

std::string reconnect() {
  Cloth cloth;
  Svg svg(1120, 350, 200);
  svg.panel(40, 250, "through the left triangle only");
  cloth.cut({{{0.5, -0.2}, {0.7, 0.52}}});
  svg.mesh(cloth.mesh);
  count_copies(svg, cloth.mesh);
  svg.panel(410, 250, "through both");
  cloth.cut({{{0.7, 0.52}, {0.9, 1.1}}});
  svg.mesh(cloth.mesh);
  count_copies(svg, cloth.mesh);
  svg.panel(750, 250, "the two pieces moved apart");
  svg.mesh(cloth.mesh, {{0, 0}, {0.25, 0}});
  return svg.str();
}

/// The physics mesh after a slit: ours, and that of element refinement, in which each triangle that is drawn
/// is one of the simulation (the paper's Figure 1).
std::string slit() {
  cut::HybridMesh mesh = cut::HybridMesh::build(scenes::hexagon(3)).value();
  cut::Cutter cutter(cut::default_merge_distances(mesh));
  const double angle = 17 * std::acos(-1.0) / 180;
  (void)cutter.cut(
      mesh, scenes::plane({0.23, 0.31, 0}, {3.5 * std::cos(angle), 3.5 * std::sin(angle), 0}, {0, 0, 1}));
  cut::TriangleMesh triangles;
  for (const cut::RenderVertex& vertex : mesh.buffers.render_vertices)
    triangles.positions.push_back(mesh.position(vertex));
  for (const cut::RenderTriangle& triangle : mesh.buffers.render_triangles)
    if (triangle.triangle.valid())
      triangles.triangles.push_back(
          {triangle.vertices[0].value, triangle.vertices[1].value, triangle.vertices[2].value});
  Svg svg(760, 340, 56);
  svg.panel(190, 165, "");
  svg.mesh(mesh);
  svg.text({-1.5, -2.6}, 0, 24, "ours", "#333");
  svg.panel(570, 165, "");
  svg.mesh(cut::HybridMesh::build(triangles).value());
  svg.text({-1.5, -2.6}, 0, 24, "element refinement", "#333");
  return svg.str();
}

}  // namespace

std::vector<std::pair<std::string, std::string>> pictures() {
  return {{"hybrid_mesh.svg", element_names()},
          {"merge_cut_endpoints.svg", merge_ends()},
          {"merge_existing_nodes.svg", merge_nodes()},
          {"join_edge_intersections.svg", join_intersections()},
          {"cut_along_segments.svg", cut_along()},
          {"merge_adjacent_edges.svg", merge_adjacent()},
          {"small_steps.svg", small_steps()},
          {"detect_disjoint_polygons.svg", faces()},
          {"reconnect.svg", reconnect()},
          {"slit.svg", slit()}};
}

}  // namespace docs
