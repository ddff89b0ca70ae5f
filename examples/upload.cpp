// A renderer of one's own: after a cut only the ranges that changed are uploaded. The "device" is a plain
// array here; `upload` is where glBufferSubData or vkCmdUpdateBuffer would be.
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <cut/cutter.hpp>

struct DeviceBuffer {
  std::vector<std::byte> bytes;
  std::size_t uploaded = 0;

  void upload(std::size_t offset, const void* data, std::size_t size) {
    if (bytes.size() < offset + size) bytes.resize(offset + size);
    std::memcpy(bytes.data() + offset, data, size);
    uploaded += size;
  }
};

template <class T>
void upload_all(DeviceBuffer& device, const std::vector<T>& items) {
  device.upload(0, items.data(), items.size() * sizeof(T));
}

/// Entries come by increasing index: neighbours go in one call.
template <class T>
void upload_changes(DeviceBuffer& device, const cut::ArrayChanges<T>& changes, const std::vector<T>& items) {
  for (std::size_t i = 0; i < changes.entries.size();) {
    std::size_t end = i + 1;
    while (end < changes.entries.size() && changes.entries[end].index == changes.entries[end - 1].index + 1)
      ++end;
    const std::size_t first = changes.entries[i].index;
    device.upload(first * sizeof(T), &items[first], (end - i) * sizeof(T));
    i = end;
  }
}

template <class T>
bool equal(const DeviceBuffer& device, const std::vector<T>& items) {
  return device.bytes.size() == items.size() * sizeof(T) &&
         std::memcmp(device.bytes.data(), items.data(), device.bytes.size()) == 0;
}

int main() {
  constexpr std::uint32_t side = 100;
  cut::TriangleMesh cloth;
  for (std::uint32_t y = 0; y <= side; ++y)
    for (std::uint32_t x = 0; x <= side; ++x) cloth.positions.emplace_back(x, y, 0);
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t i = y * (side + 1) + x;
      cloth.triangles.push_back({i, i + 1, i + side + 2});
      cloth.triangles.push_back({i, i + side + 2, i + side + 1});
    }
  auto mesh = cut::HybridMesh::build(cloth);
  cut::Cutter cutter(cut::default_merge_distances(*mesh));
  DeviceBuffer vertices, triangles;
  upload_all(vertices, mesh->buffers.render_vertices);
  upload_all(triangles, mesh->buffers.render_triangles);
  const std::size_t all = vertices.uploaded + triangles.uploaded;

  for (int step = 0; step < 20; ++step) {
    vertices.uploaded = triangles.uploaded = 0;
    const double x = 3.1 * step;
    const cut::TriangleMesh blade{{{x, 40.3, -1}, {x + 3.1, 41, -1}, {x + 3.1, 41, 1}, {x, 40.3, 1}},
                                  {{0, 1, 2}, {0, 2, 3}}};
    const auto changes = cutter.cut(*mesh, blade);
    if (!changes) return std::puts(changes.error().message.c_str());
    upload_changes(vertices, changes->render_vertices, mesh->buffers.render_vertices);
    upload_changes(triangles, changes->render_triangles, mesh->buffers.render_triangles);
    if (!equal(vertices, mesh->buffers.render_vertices) || !equal(triangles, mesh->buffers.render_triangles))
      return std::puts("the device has something else than the mesh");
  }
  std::printf("the last step uploaded %zu of %zu bytes\n", vertices.uploaded + triangles.uploaded, all);
}
