/// @file
/// The mass-spring-damper simulation of the physics mesh (§3.1, equations 1 to 6). In: a hybrid mesh and its
/// material, then the change set of each cut. Out: the mesh's positions, moved on in time.
///
/// The mesh's positions are the truth: a step starts from them and writes them back. Everything else that
/// moves (velocities, masses, spring constants) lives here in flat arrays with the indices of the mesh's
/// buffers, so that a cut changes single entries of them.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "cut/changes.hpp"
#include "cut/error.hpp"
#include "cut/executor.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cut/implicit_work.hpp"
#include "cut/material.hpp"
#include "cut/padded_vector.hpp"
#include "cut/spring_blocks.hpp"
#include "cut/surroundings.hpp"

namespace cut {

struct Energy {
  double kinetic = 0;
  double elastic = 0;
  double gravity = 0;  ///< −Σ m g·p
  [[nodiscard]] double total() const { return kinetic + elastic + gravity; }
};

/// Numbers that begin where a line of a processor's cache does: what lies across two lines takes longer.
struct alignas(64) CacheLine {
  std::array<double, 8> values{};
  bool operator==(const CacheLine&) const = default;
};

struct VelocityUpdate;
struct NodeArrays;

class Obstacles;

/// Moves a hybrid mesh in time.
class Simulation {
 public:
  Surroundings surroundings;
  /// Runs the loops over blocks of nodes. Results are the same to the bit whatever it does.
  Executor executor;

  /// A simulation of the mesh as it is now, cut or not, at rest. Error: bad_parameter for a material that is
  /// not finite or out of range. O(mesh).
  [[nodiscard]] static Result<Simulation> build(const HybridMesh& mesh, const Material& material);

  /// Moves the mesh on by `count` steps of `time_step` seconds each, and the obstacles; calls mesh.moved().
  /// O(count · mesh), an implicit step times its iterations; allocates only work space, in the first step
  /// after a cut and where an implicit one meets more contacts than before. Nodes that start inside of an
  /// obstacle are put on its surface. The result is that of one call after the other, but large meshes take
  /// less time for explicit steps in one call.
  ///
  /// Errors: bad_parameter for a time step or surroundings out of range, and for a mesh with cuts that were
  /// not applied (nothing changes); unstable when a position or velocity stops being finite or a node goes
  /// further than `longest_way`, and not_converged when an implicit step finds no solution: mesh and
  /// simulation then stand as they were before the failing step, which the message names together with the
  /// node.
  [[nodiscard]] std::optional<Error> step(HybridMesh& mesh, double time_step, std::size_t count = 1);

  /// Takes over a cut: copies start with the velocity of their source, masses and springs follow the
  /// material's mode. `mesh` is the mesh right after that cut. Error: bad_parameter when `changes` is not the
  /// next change set of this simulation or not the last one of `mesh` (nothing changes). Cost: that of the
  /// triangles that changed and their neighbours; and O(mesh) for the cuts at which the mesh has grown by an
  /// eighth, twice that, four times that and so on, when whole arrays are moved.
  [[nodiscard]] std::optional<Error> apply(const Changes& changes, const HybridMesh& mesh);

  /// An anchored node is not accelerated: it goes on with its velocity, which anchoring sets to zero and
  /// `set_velocity` may change for a moving anchor. A copy of an anchored node is anchored in paper mode; in
  /// conserving mode those nodes stay anchored, of copies and source, whose fragment renders the node.
  void anchor(NodeId node);
  /// Anchors every copy of a node of the uncut mesh that renders it.
  void anchor(AncestorNodeId node, const HybridMesh& mesh);
  void release(NodeId node);
  [[nodiscard]] bool anchored(NodeId node) const { return anchored_[node.index()] != 0; }

  [[nodiscard]] Eigen::Vector3d velocity(NodeId node) const;
  void set_velocity(NodeId node, const Eigen::Vector3d& velocity);
  /// A force on one node that acts until it is set again [N]. When a cut splits the node, its copies share it
  /// as they share the mass (paper mode: each gets all of it).
  void set_force(NodeId node, const Eigen::Vector3d& force);
  [[nodiscard]] Eigen::Vector3d force(NodeId node) const;

  [[nodiscard]] double mass(NodeId node) const { return mass_[node.index()]; }
  [[nodiscard]] double stiffness(SpringId spring) const { return springs_.stiffness[spring.index()]; }
  [[nodiscard]] double damping(SpringId spring) const { return springs_.damping[spring.index()]; }
  /// Number of the mesh's springs in use.
  [[nodiscard]] std::size_t spring_count() const { return spring_count_; }
  /// The springs that resist bending (cut/bending.hpp). Entry e is for ancestor edge e; the further ones of
  /// edges that cuts have divided stand behind.
  [[nodiscard]] const SpringArrays& bending_springs() const { return bending_; }
  [[nodiscard]] std::size_t node_count() const { return mass_.size(); }
  [[nodiscard]] const Material& material() const { return material_; }
  /// Number of steps done so far: the paper's "updates" (§6).
  [[nodiscard]] std::uint64_t updates() const { return updates_; }

  /// The time step below which small motions around rest do not grow, from the largest Σ k / m of all nodes.
  /// An estimate from below for cloth that is stretched or little compressed: springs shorter than half their
  /// rest length need a smaller step. Zero for forward Euler without damping; infinite without springs and
  /// drag. O(mesh).
  [[nodiscard]] double stable_time_step(Integrator integrator) const;
  /// As `stable_time_step`, from the triangles of the uncut mesh one by one: smaller or equal, and valid
  /// after any number of cuts in conserving mode (docs/decisions.md, "Conserving material"). O(mesh).
  [[nodiscard]] double cut_proof_time_step(Integrator integrator, const HybridMesh& mesh) const;

  [[nodiscard]] double total_mass() const;
  [[nodiscard]] Eigen::Vector3d momentum() const;
  /// About the origin. @pre the mesh is the one simulated
  [[nodiscard]] Eigen::Vector3d angular_momentum(const HybridMesh& mesh) const;
  [[nodiscard]] Eigen::Vector3d centre_of_mass(const HybridMesh& mesh) const;
  [[nodiscard]] Energy energy(const HybridMesh& mesh) const;

 private:
  void resize(const HybridMesh& mesh);
  void set_mass(NodeId node, double mass);
  void set_spring(SpringId spring, const HybridMesh& mesh);
  void measure_weights(const HybridMesh& mesh, AncestorId ancestor);
  void divide_weights(const Changes& changes, const HybridMesh& mesh, std::size_t first_new);
  void update_copies(const HybridMesh& mesh, AncestorNodeId node);
  void update_springs(const HybridMesh& mesh, AncestorEdgeId edge);
  void update_bending(const HybridMesh& mesh, AncestorEdgeId edge);
  void reserve_bending(std::size_t entries);
  void copy_nodes(const Changes& changes);
  void settle_springs();
  void take_over_fragments(const Changes& changes, const HybridMesh& mesh, std::size_t first_new_triangle);
  [[nodiscard]] std::array<const SpringArrays*, 2> spring_lists() const { return {&springs_, &bending_}; }
  void find_air_forces(const HybridMesh& mesh);
  void for_each_run(const std::function<void(std::size_t first, std::size_t last)>& body) const;
  [[nodiscard]] NodeArrays node_arrays(bool moves);
  void load(const NodeArrays& nodes) const;
  void store(const NodeArrays& nodes);
  void take_next_velocities(const NodeArrays& nodes);
  [[nodiscard]] std::size_t steps_at_once() const;
  [[nodiscard]] bool go_through_blocks(const VelocityUpdate* update, const NodeArrays& nodes,
                                       std::size_t steps);
  [[nodiscard]] bool find_forces(const VelocityUpdate* update);
  [[nodiscard]] VelocityUpdate velocity_update(double time_step, double speed_limit) const;
  std::optional<Error> step_free(double time_step, double speed_limit, std::size_t count);
  std::optional<Error> explicit_velocities(const HybridMesh& mesh, double time_step, double speed_limit);
  std::optional<Error> implicit_velocities(const HybridMesh& mesh, double time_step, double speed_limit,
                                           const Obstacles& obstacles);
  void arrange_system(const HybridMesh& mesh);
  void set_up_system(const HybridMesh& mesh, double time_step);
  double multiply(const std::vector<PaddedVector>& vector);
  double find_residual();
  double advance(double way);
  double precondition();
  std::optional<Error> solve(double tolerance);
  bool find_contacts(const Obstacles& obstacles);
  std::optional<Error> settle_contacts(double tolerance);
  void keep_out(const Obstacles& obstacles, std::vector<PaddedVector>& velocities) const;
  [[nodiscard]] double contact_slack() const;
  [[nodiscard]] std::optional<Error> unsound_velocity(double speed_limit) const;
  [[nodiscard]] std::optional<Error> unsound_forces() const;
  [[nodiscard]] Error not_solved(std::size_t iterations) const;
  [[nodiscard]] double time_step_limit(Integrator integrator, double stiffness_ratio,
                                       double damping_ratio) const;

  Material material_;
  double diagonal_ = 0;  ///< of the tension-free mesh's bounding box
  std::uint64_t topology_version_ = 0;
  std::uint64_t updates_ = 0;
  std::size_t spring_count_ = 0;

  // Per physics node.
  std::vector<double> mass_;
  std::vector<double> inverse_mass_;  ///< 0: not accelerated, being anchored or without mass
  std::vector<std::uint8_t> anchored_;
  std::vector<PaddedVector> velocities_;
  std::vector<PaddedVector> external_forces_;  ///< empty while none is set
  std::vector<PaddedVector> air_forces_;       ///< work space of `step`
  std::vector<PaddedVector> positions_;        ///< work space of `step`
  std::vector<PaddedVector> forces_;           ///< work space of `step`
  /// Work space of `step` for positions and velocities and the next ones: for nodes with springs in diagonals
  /// x, y and z each in an array of its own, by slot vectors for the others and for what lists name.
  std::vector<CacheLine> columns_;
  std::vector<PaddedVector> vectors_;
  std::vector<double> inverse_mass_at_slots_;

  SpringArrays springs_;             ///< per spring of the mesh, padded to a multiple of 4 with free entries
  std::vector<SpringPlace> places_;  ///< per entry of `springs_`
  std::vector<std::uint32_t>
      touched_;                      ///< entries of `springs_` that were written to since they were settled
  SpringBlocks blocks_;              ///< what the step goes through
  std::vector<std::uint8_t> sound_;  ///< work space of `step`, per block
  SpringArrays bending_;             ///< padded likewise; empty without bending springs
  std::vector<SpringPlace> bending_places_;     ///< per entry of `bending_`
  std::vector<std::uint32_t> touched_bending_;  ///< as `touched_`
  std::vector<std::uint32_t> next_bending_;     ///< per entry of `bending_`: the edge's next one, or 0
  std::vector<std::uint32_t> free_bending_;     ///< entries that were further ones and are so no more
  /// Per physics triangle: w_i of its three corners. Conserving mode only.
  std::vector<std::array<double, 3>> weights_;
  ImplicitWork implicit_;  ///< empty while no implicit step was done
};

}  // namespace cut
