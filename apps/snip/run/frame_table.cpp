// frames.csv, see frame_table.hpp. Numbers have as many digits as it takes to read the same bits back.
#include "snip/run/frame_table.hpp"

#include <fmt/format.h>

namespace snip {

std::string frame_header() {
  return "frame,time_s,pieces,physics_nodes,physics_edges,physics_triangles,render_nodes,render_triangles,"
         "kinetic_j,elastic_j,gravity_j,total_j,cut_ms,simulation_ms\n";
}

std::string frame_row(const Frame& f) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{:.4f},{:.4f}\n", f.number, f.time, f.pieces,
                     f.physics_nodes, f.physics_edges, f.physics_triangles, f.render_nodes,
                     f.render_triangles, f.energy.kinetic, f.energy.elastic, f.energy.gravity,
                     f.energy.total(), f.cut_ms, f.simulation_ms);
}

}  // namespace snip
