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
#include <optional>
#include <vector>

#include "cut/changes.hpp"
#include "cut/error.hpp"
#include "cut/executor.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cut/material.hpp"
#include "cut/spring_blocks.hpp"

namespace cut {

enum class Integrator : std::uint8_t {
  forward_euler,       ///< equations 5 and 6: positions move on with the old velocity
  semi_implicit_euler  ///< positions move on with the new velocity: conserves energy far better
};

/// What acts on the whole cloth; may change between any two steps.
struct Surroundings {
  Integrator integrator = Integrator::semi_implicit_euler;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< acceleration [m/s²]
  /// Force per area and speed relative to the air [N·s/m³], >= 0.
  double air_drag = 0;
  Eigen::Vector3d wind = Eigen::Vector3d::Zero();  ///< velocity of the air [m/s]
  /// The longest way that a node may go in one step along x, y or z [m]; more is a blow-up. 0: the diagonal
  /// of the tension-free mesh's bounding box.
  double longest_way = 0;
};

struct Energy {
  double kinetic = 0;
  double elastic = 0;
  double gravity = 0;  ///< −Σ m g·p
  [[nodiscard]] double total() const { return kinetic + elastic + gravity; }
};

/// A vector in space, padded so that a processor loads it whole. w stays zero.
struct alignas(32) PaddedVector {
  double x = 0, y = 0, z = 0, w = 0;
};

struct VelocityUpdate;

/// Moves a hybrid mesh in time.
class Simulation {
 public:
  Surroundings surroundings;
  /// Runs the loops over blocks of nodes. Results are the same to the bit whatever it does.
  Executor executor;

  /// A simulation of the mesh as it is now, cut or not, at rest. Error: bad_parameter for a material that is
  /// not finite or out of range. O(mesh).
  [[nodiscard]] static Result<Simulation> build(const HybridMesh& mesh, const Material& material);

  /// Moves the mesh on by `count` steps of `time_step` seconds each; calls mesh.moved(). O(count · mesh), no
  /// allocation. Errors: bad_parameter for a time step that is not positive and finite, and for a mesh with
  /// cuts that were not applied (nothing changes); unstable when a velocity stops being finite or a node goes
  /// further than `longest_way`: the mesh then stands as it was before the failing step, which the message
  /// names together with the node.
  [[nodiscard]] std::optional<Error> step(HybridMesh& mesh, double time_step, std::size_t count = 1);

  /// Takes over a cut: copies start with the velocity of their source, masses and springs follow the
  /// material's mode. `mesh` is the mesh right after that cut. Error: bad_parameter when `changes` is not the
  /// next change set of this simulation or not the last one of `mesh` (nothing changes). Cost: that of the
  /// triangles that changed and their neighbours.
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
  /// Number of springs in use.
  [[nodiscard]] std::size_t spring_count() const { return spring_count_; }
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
  void copy_nodes(const Changes& changes);
  void settle_springs();
  [[nodiscard]] bool add_forces_and_replace_by_velocities(const VelocityUpdate& update);
  void take_over_fragments(const Changes& changes, const HybridMesh& mesh, std::size_t first_new_triangle);
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
  std::vector<PaddedVector> positions_;        ///< work space of `step`
  std::vector<PaddedVector> forces_;           ///< work space of `step`

  SpringArrays springs_;             ///< per spring of the mesh, padded to a multiple of 4 with free entries
  std::vector<SpringPlace> places_;  ///< per entry of `springs_`
  std::vector<std::uint32_t>
      touched_;                      ///< entries of `springs_` that were written to since they were settled
  SpringBlocks blocks_;              ///< what the step goes through
  std::vector<std::uint8_t> sound_;  ///< work space of `step`, per block
  /// Per physics triangle: w_i of its three corners. Conserving mode only.
  std::vector<std::array<double, 3>> weights_;
};

}  // namespace cut
