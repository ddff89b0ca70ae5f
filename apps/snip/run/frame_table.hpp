/// @file
/// frames.csv: a line for each frame. In: a frame. Out: text, so that the table need not be kept in memory.
#pragma once
#include <string>

#include "snip/run/scene_run.hpp"

namespace snip {

/// The names of the columns, and one frame in their order; each ends with a line feed.
std::string frame_header();
std::string frame_row(const Frame& frame);

}  // namespace snip
