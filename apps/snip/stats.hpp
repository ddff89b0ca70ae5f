/// @file
/// What `--stats` writes: what a command did, as JSON.
#pragma once
#include <chrono>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "snip/pieces.hpp"

namespace snip {

using Json = nlohmann::ordered_json;

struct Counts {
  std::size_t nodes = 0;
  std::size_t edges = 0;
  std::size_t triangles = 0;
};

/// Names the parts of a command and remembers how long each took, in the order in which they were run.
class Stopwatch {
 public:
  /// Ends the part that has been running since the last call, or since the start.
  void lap(std::string_view name) {
    const auto now = Clock::now();
    add(name, std::chrono::duration<double, std::milli>(now - begin_).count());
    begin_ = now;
  }
  void add(std::string_view name, double milliseconds) { parts_.emplace_back(name, milliseconds); }
  [[nodiscard]] const std::vector<std::pair<std::string, double>>& parts() const { return parts_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
  std::vector<std::pair<std::string, double>> parts_;
};

Json to_json(const Counts& counts);
Json to_json(const Stopwatch& timings);
/// A list of {area, triangles, boundary_loops, euler_characteristic}.
Json to_json(const std::vector<Piece>& pieces);
double total_area(const std::vector<Piece>& pieces);

}  // namespace snip
