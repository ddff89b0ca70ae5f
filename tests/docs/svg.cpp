// Drawing of hybrid meshes, see svg.hpp.
#include "docs/svg.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace docs {
namespace {

const std::array<std::string, 4> piece_fills{"#f7e29a", "#a9cbe8", "#f2a99b", "#b5dba4"};

std::string number(double v) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", std::abs(v) < 0.05 ? 0.0 : v);
  return text.data();
}

}  // namespace

std::string Svg::pixels(const Point& p) const {
  return number(origin_.x() + scale_ * p.x()) + "," + number(origin_.y() - scale_ * p.y());
}

void Svg::panel(double x, double y, const std::string& title) {
  origin_ = {x, y};
  text({0, 0}, 0, 40, title, "#333");
}

void Svg::line(const Point& from, const Point& to, const std::string& colour, double width, bool dashed) {
  body_ += "<path d=\"M" + pixels(from) + " L" + pixels(to) + "\" stroke=\"" + colour + "\" stroke-width=\"" +
           number(width) + "\"" + (dashed ? " stroke-dasharray=\"6 4\"" : "") + "/>\n";
}

void Svg::ring(const Point& middle, double radius) {
  const std::string at = pixels(middle);
  const std::size_t comma = at.find(',');
  body_ += "<circle cx=\"" + at.substr(0, comma) + "\" cy=\"" + at.substr(comma + 1) + "\" r=\"" +
           number(radius * scale_) +
           "\" fill=\"none\" stroke=\"#888\" stroke-width=\"1\" stroke-dasharray=\"3 3\"/>\n";
}

void Svg::dot(const Point& middle, double radius, const std::string& fill, const std::string& stroke) {
  const std::string at = pixels(middle);
  const std::size_t comma = at.find(',');
  body_ += "<circle cx=\"" + at.substr(0, comma) + "\" cy=\"" + at.substr(comma + 1) + "\" r=\"" +
           number(radius) + "\" fill=\"" + fill + "\" stroke=\"" + stroke + "\" stroke-width=\"1.5\"/>\n";
}

void Svg::text(const Point& at, double dx, double dy, const std::string& words, const std::string& colour) {
  const std::string where = pixels({at.x() + dx / scale_, at.y() - dy / scale_});
  const std::size_t comma = where.find(',');
  body_ += "<text x=\"" + where.substr(0, comma) + "\" y=\"" + where.substr(comma + 1) + "\" fill=\"" +
           colour + "\">" + words + "</text>\n";
}

void Svg::mesh(const cut::HybridMesh& mesh, const std::vector<Point>& offsets) {
  const cut::Pieces pieces = cut::pieces(mesh);
  const auto& vertices = mesh.buffers.render_vertices;
  const auto& triangles = mesh.buffers.render_triangles;
  std::vector<std::uint32_t> piece_of(mesh.buffers.triangles.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (triangles[t].triangle.valid()) piece_of[triangles[t].triangle.index()] = pieces.of_triangle[t];
  const auto offset = [&](std::uint32_t piece) {
    return piece < offsets.size() ? offsets[piece] : Point{0, 0};
  };
  const auto flat = [&](const Eigen::Vector3d& p) { return Point{p.x(), p.y()}; };
  const auto place = [&](cut::TriangleId t, cut::LatticePoint p) -> Point {
    return flat(mesh.position({t, mesh.buffers.triangles[t.index()].nodes, p})) + offset(piece_of[t.index()]);
  };
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!triangles[t].triangle.valid()) continue;
    const std::uint32_t piece = pieces.of_triangle[t];
    std::string d;
    for (const cut::RenderVertexId v : triangles[t].vertices)
      d += (d.empty() ? "M" : " L") + pixels(flat(mesh.position(vertices[v.index()])) + offset(piece));
    const std::string& fill = piece_fills[piece % piece_fills.size()];
    // The stroke hides the seams between triangles of one polygon.
    body_ += "<path d=\"" + d + " Z\" fill=\"" + fill + "\" stroke=\"" + fill + "\" stroke-width=\"0.8\"/>\n";
  }
  for (std::size_t t = 0; t < mesh.ancestors.triangles.size(); ++t)
    for (std::size_t p = 0; p < mesh.fragment_count(cut::AncestorId{t}); ++p) {
      const cut::TriangleId id = mesh.fragment(cut::AncestorId{t}, p);
      for (std::size_t i = 0; i < 3; ++i)
        line(place(id, cut::lattice_corner(i)), place(id, cut::lattice_corner(cut::next_corner(i))),
             "#248c3c", 1.6);
    }
  for (std::size_t t = 0; t < mesh.ancestors.triangles.size(); ++t) {
    const cut::Arrangement* a = mesh.arrangement(cut::AncestorId{t});
    if (a == nullptr) continue;
    for (const cut::CutEdge& e : a->edges)
      for (const std::uint32_t polygon : {e.left, e.right})
        line(place(a->polygons[polygon].triangle, a->nodes[e.from].point),
             place(a->polygons[polygon].triangle, a->nodes[e.to].point),
             e.left == e.right ? "#d03020" : "#703020", 2);
    for (const cut::CutEdge& e : a->edges)
      for (const std::uint32_t polygon : {e.left, e.right})
        for (const std::uint32_t n : {e.from, e.to})
          if (n >= a->first_inner_node())
            dot(place(a->polygons[polygon].triangle, a->nodes[n].point), 3, "#d03020", "#d03020");
    for (std::size_t i = 0; i < 3; ++i)
      for (std::uint32_t k = 1; k <= a->boundary_counts[i]; ++k)
        for (const std::uint32_t section : {k - 1, k})
          dot(place(a->polygons[a->section_polygons[i][section]].triangle,
                    a->nodes[a->edge_node(i, k)].point),
              3.5, "white", "#222");
  }
  for (std::size_t t = 0; t < mesh.buffers.triangles.size(); ++t)
    if (mesh.buffers.triangles[t].ancestor.valid())
      for (std::size_t i = 0; i < 3; ++i)
        dot(place(cut::TriangleId{t}, cut::lattice_corner(i)), 4.5, "#248c3c", "#248c3c");
}

std::string Svg::str() const {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width_) + " " + number(height_) +
         "\" width=\"" + number(width_) + "\" height=\"" + number(height_) +
         "\" font-family=\"sans-serif\" font-size=\"14\" stroke-linecap=\"round\">\n"
         "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" +
         body_ + "</svg>\n";
}

}  // namespace docs
