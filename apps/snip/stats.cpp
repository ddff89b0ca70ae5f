// Statistics as JSON; see the header.
#include "snip/stats.hpp"

namespace snip {

Json to_json(const Counts& counts) {
  return {{"nodes", counts.nodes}, {"edges", counts.edges}, {"triangles", counts.triangles}};
}

Json to_json(const Stopwatch& timings) {
  Json json = Json::object();
  for (const auto& [name, milliseconds] : timings.parts()) json[name] = milliseconds;
  return json;
}

Json to_json(const std::vector<Piece>& pieces) {
  Json json = Json::array();
  for (const Piece& piece : pieces)
    json.push_back({{"area", piece.area},
                    {"triangles", piece.triangles},
                    {"boundary_loops", piece.boundary_loops},
                    {"euler_characteristic", piece.euler_characteristic}});
  return json;
}

double total_area(const std::vector<Piece>& pieces) {
  double area = 0;
  for (const Piece& piece : pieces) area += piece.area;
  return area;
}

}  // namespace snip
