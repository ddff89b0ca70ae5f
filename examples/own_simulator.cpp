// libcut with a simulator of one's own: position-based dynamics on the springs of the physics mesh. The mesh
// has the positions; velocities and inverse masses are here, and a cut's change set tells which nodes are new
// and whose copies.
#include <cstdio>
#include <cut/cutter.hpp>
#include <cut/pieces.hpp>

struct PositionBased {
  std::vector<Eigen::Vector3d> velocities;
  std::vector<double> inverse_masses;  // 0 holds a node in place

  explicit PositionBased(std::size_t nodes)
      : velocities(nodes, Eigen::Vector3d::Zero()), inverse_masses(nodes, 1.0) {}

  void apply(const cut::Changes& changes) {
    for (const cut::NodeCopy& copy : changes.node_copies) {  // in the order of their numbers
      velocities.push_back(Eigen::Vector3d(velocities[copy.source.index()]));
      inverse_masses.push_back(1.0);
    }
  }

  void step(cut::HybridMesh& mesh, double seconds) {
    const std::vector<Eigen::Vector3d> before = mesh.positions;
    for (std::size_t n = 0; n < velocities.size(); ++n)
      if (inverse_masses[n] > 0)
        mesh.positions[n] += seconds * (velocities[n] + seconds * Eigen::Vector3d(0, 0, -9.81));
    for (int iteration = 0; iteration < 20; ++iteration)
      for (const cut::Spring& spring : mesh.buffers.springs) {
        if (!spring.edge.valid()) continue;  // removed by a cut
        const std::size_t a = spring.nodes[0].index(), b = spring.nodes[1].index();
        const double weight = inverse_masses[a] + inverse_masses[b];
        if (weight == 0) continue;
        const Eigen::Vector3d way = mesh.positions[b] - mesh.positions[a];
        const Eigen::Vector3d excess =
            way.normalized() * ((way.norm() - mesh.ancestors.rest_length(spring.edge)) / weight);
        mesh.positions[a] += inverse_masses[a] * excess;
        mesh.positions[b] -= inverse_masses[b] * excess;
      }
    for (std::size_t n = 0; n < velocities.size(); ++n)
      velocities[n] = (mesh.positions[n] - before[n]) / seconds;
    mesh.moved();
  }
};

int main() {
  cut::TriangleMesh cloth;  // a strip that hangs by its upper corners
  for (int i = 0; i <= 20; ++i)
    for (const double x : {0.0, 0.1}) cloth.positions.emplace_back(x, 0, -0.1 * i);
  for (std::uint32_t i = 0; i < 40; i += 2) {
    cloth.triangles.push_back({i, i + 2, i + 3});
    cloth.triangles.push_back({i, i + 3, i + 1});
  }
  auto mesh = cut::HybridMesh::build(cloth);
  cut::Cutter cutter(cut::default_merge_distances(*mesh));
  PositionBased simulator(mesh->positions.size());
  simulator.inverse_masses[0] = simulator.inverse_masses[1] = 0;
  const cut::TriangleMesh blade{{{-1, -1, -1.03}, {2, -1, -0.97}, {0, 2, -1}}, {{0, 1, 2}}};
  for (int frame = 0; frame < 60; ++frame) {
    if (frame == 20) {
      const auto changes = cutter.cut(*mesh, blade);
      if (!changes) return std::puts(changes.error().message.c_str());
      simulator.apply(*changes);
    }
    simulator.step(*mesh, 1.0 / 60);
  }
  const auto lowest = [&](std::size_t from, std::size_t to) {
    double z = 0;
    for (std::size_t n = from; n < to; ++n) z = std::min(z, mesh->positions[n].z());
    return z;
  };
  std::printf("%zu pieces; the cloth's lower end is at %.1f m\n", cut::pieces(*mesh).list.size(),
              lowest(0, mesh->positions.size()));
  return cut::pieces(*mesh).list.size() == 2 && lowest(0, mesh->positions.size()) < -2.5 ? 0 : 1;
}
