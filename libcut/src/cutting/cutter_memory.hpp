/// @file
/// What a Cutter remembers between its calls.
#pragma once
#include <cstdint>
#include <vector>

#include "cut/cutter.hpp"
#include "cutting/broad_phase.hpp"
#include "cutting/detect_cutting_lines.hpp"
#include "cutting/state.hpp"

namespace cut {

struct Cutter::Memory {
  MergeDistances distances;
  BroadPhase broad_phase;
  std::uint32_t previous_cut = 0;  ///< number of the last call that met the cloth
  ClusterCentres centres;
  std::vector<DetectedLine> lines;  ///< of the previous call
  StepTimings timings;
};

}  // namespace cut
