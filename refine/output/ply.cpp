// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/ply.h"

#include <cstdint>
#include <cstring>

namespace rakelight {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
              "PLY is written as the memory of a little-endian machine");

constexpr std::size_t kVertexBytes = 6 * sizeof(float) + 3 + sizeof(float);
constexpr std::size_t kTriangleBytes = 1 + 3 * sizeof(std::int32_t);

std::string header(const Mesh& mesh) {
  return "ply\nformat binary_little_endian 1.0\n"
         "comment Rakelight: metres, camera coordinates (x right, y down, z forward)\n"
         "comment delta_mm: refined minus sensor depth\n"
         "element vertex " +
         std::to_string(mesh.vertices.size()) +
         "\n"
         "property float x\nproperty float y\nproperty float z\n"
         "property float nx\nproperty float ny\nproperty float nz\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\n"
         "property float delta_mm\n"
         "element face " +
         std::to_string(mesh.triangles.size()) +
         "\n"
         "property list uchar int vertex_indices\nend_header\n";
}

template <class T>
void append(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

}  // namespace

std::string ply_bytes(const Mesh& mesh) {
  std::string bytes = header(mesh);
  bytes.reserve(bytes.size() + mesh.vertices.size() * kVertexBytes + mesh.triangles.size() * kTriangleBytes);
  for (const MeshVertex& vertex : mesh.vertices) {
    append(bytes, vertex.position.val);
    append(bytes, vertex.normal.val);
    append(bytes, vertex.color.val);
    append(bytes, vertex.delta_mm);
  }
  for (const auto& triangle : mesh.triangles) {
    append(bytes, static_cast<std::uint8_t>(triangle.size()));
    for (const int index : triangle) append(bytes, static_cast<std::int32_t>(index));
  }
  return bytes;
}

}  // namespace rakelight
