// The union of all lines in GEOS nodes them on a grid; polygonize finds the faces; those outside of the sheet
// are dropped.
#include "oracle/flat_oracle.hpp"

#define GEOS_USE_ONLY_R_API
#include <geos_c.h>

#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>

namespace oracle {
namespace {

class Geos {
 public:
  Geos() : handle_(GEOS_init_r()) {}
  ~Geos() { GEOS_finish_r(handle_); }
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;
  operator GEOSContextHandle_t() const { return handle_; }

 private:
  GEOSContextHandle_t handle_;
};

/// Owns a geometry; a null pointer from GEOS is an error.
auto owned(const Geos& geos, GEOSGeometry* geometry) {
  if (!geometry) throw std::runtime_error("GEOS failed");
  const auto destroy = [handle = GEOSContextHandle_t(geos)](GEOSGeometry* g) {
    GEOSGeom_destroy_r(handle, g);
  };
  return std::unique_ptr<GEOSGeometry, decltype(destroy)>(geometry, destroy);
}

Eigen::Vector2d flat(const Eigen::Vector3d& p) { return p.head<2>(); }

/// Sides with one triangle.
std::vector<Segment> outline(const cut::TriangleMesh& sheet) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (const auto& t : sheet.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++count[std::minmax({t[i], t[(i + 1) % 3]})];
  std::vector<Segment> result;
  for (const auto& [ends, triangles] : count)
    if (triangles == 1)
      result.push_back({flat(sheet.positions[ends.first]), flat(sheet.positions[ends.second])});
  return result;
}

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool covers(const cut::TriangleMesh& sheet, const Eigen::Vector2d& p) {
  return std::any_of(sheet.triangles.begin(), sheet.triangles.end(), [&](const auto& t) {
    const auto at = [&](std::size_t i) { return flat(sheet.positions[t[i]]); };
    return turn(at(0), at(1), p) >= 0 && turn(at(1), at(2), p) >= 0 && turn(at(2), at(0), p) >= 0;
  });
}

GEOSGeometry* line(const Geos& geos, const Segment& s) {
  GEOSCoordSequence* points = GEOSCoordSeq_create_r(geos, 2, 2);
  for (unsigned i = 0; i < 2; ++i) GEOSCoordSeq_setXY_r(geos, points, i, s[i].x(), s[i].y());
  return GEOSGeom_createLineString_r(geos, points);
}

}  // namespace

std::vector<double> flat_pieces(const cut::TriangleMesh& sheet, const std::vector<Segment>& segments,
                                double grid) {
  const Geos geos;
  std::vector<GEOSGeometry*> lines;
  for (const Segment& s : outline(sheet)) lines.push_back(line(geos, s));
  for (const Segment& s : segments)
    if (s[0] != s[1]) lines.push_back(line(geos, s));
  const auto all = owned(geos, GEOSGeom_createCollection_r(geos, GEOS_MULTILINESTRING, lines.data(),
                                                           static_cast<unsigned>(lines.size())));
  const auto noded = owned(geos, GEOSUnaryUnionPrec_r(geos, all.get(), grid));
  const GEOSGeometry* const input = noded.get();
  const auto faces = owned(geos, GEOSPolygonize_r(geos, &input, 1));

  std::vector<double> areas;
  for (int i = 0; i < GEOSGetNumGeometries_r(geos, faces.get()); ++i) {
    const GEOSGeometry* face = GEOSGetGeometryN_r(geos, faces.get(), i);
    const auto point = owned(geos, GEOSPointOnSurface_r(geos, face));
    Eigen::Vector2d inside;
    GEOSGeomGetX_r(geos, point.get(), &inside.x());
    GEOSGeomGetY_r(geos, point.get(), &inside.y());
    if (!covers(sheet, inside)) continue;
    GEOSArea_r(geos, face, &areas.emplace_back());
  }
  std::sort(areas.rbegin(), areas.rend());
  return areas;
}

}  // namespace oracle
