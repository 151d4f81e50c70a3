// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/glb.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "stack/color_response.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

/// Camera frame (y down, z forward) to glTF's (y up, z backward): half a turn about x, which keeps faces' order.
cv::Vec3f gltf_frame(const cv::Vec3f& v) { return {v[0], -v[1], -v[2]}; }

/// 16-bit linear values of 8-bit sRGB ones.
std::array<std::uint16_t, 256> linear_table() {
  const ColorResponse srgb{ColorResponse::Kind::srgb, 1.0};
  std::array<std::uint16_t, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = static_cast<std::uint16_t>(std::lround(65535 * decode(srgb, static_cast<double>(i) / 255)));
  return table;
}

/// Fills a model whose one buffer holds an accessor after the other.
class ModelBuilder {
 public:
  ModelBuilder() { model_.buffers.emplace_back(); }

  /// @param values plain arrays of numbers  @return index of the accessor
  template <class T>
  int add(const std::vector<T>& values, int type, int component, int target) {
    std::vector<unsigned char>& data = model_.buffers.front().data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = values.size() * sizeof(T);
    view.target = target;
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    data.insert(data.end(), bytes, bytes + view.byteLength);
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size());
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = values.size();
    model_.bufferViews.push_back(std::move(view));
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  tinygltf::Model& model() { return model_; }

 private:
  tinygltf::Model model_;
};

int add_positions(const Mesh& mesh, ModelBuilder& builder) {
  constexpr float kFar = std::numeric_limits<float>::max();
  cv::Vec3f low = cv::Vec3f::all(kFar), high = cv::Vec3f::all(-kFar);
  std::vector<cv::Vec3f> positions;
  positions.reserve(mesh.vertices.size());
  for (const MeshVertex& vertex : mesh.vertices) {
    const cv::Vec3f p = gltf_frame(vertex.position);
    positions.push_back(p);
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  const int index =
      builder.add(positions, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TARGET_ARRAY_BUFFER);
  tinygltf::Accessor& accessor = builder.model().accessors.back();
  accessor.minValues.assign(low.val, low.val + 3);  // required of positions
  accessor.maxValues.assign(high.val, high.val + 3);
  return index;
}

int add_normals(const Mesh& mesh, ModelBuilder& builder) {
  std::vector<cv::Vec3f> normals;
  normals.reserve(mesh.vertices.size());
  for (const MeshVertex& vertex : mesh.vertices) normals.push_back(gltf_frame(vertex.normal));
  return builder.add(normals, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT,
                     TINYGLTF_TARGET_ARRAY_BUFFER);
}

int add_colors(const Mesh& mesh, ModelBuilder& builder) {
  const std::array<std::uint16_t, 256> linear = linear_table();
  std::vector<cv::Vec4w> colors;  // four values, since glTF wants every element on a multiple of four bytes
  colors.reserve(mesh.vertices.size());
  for (const MeshVertex& vertex : mesh.vertices) {
    const cv::Vec3b& c = vertex.color;
    colors.emplace_back(linear[c[0]], linear[c[1]], linear[c[2]], std::uint16_t{65535});
  }
  const int index = builder.add(colors, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                                TINYGLTF_TARGET_ARRAY_BUFFER);
  builder.model().accessors.back().normalized = true;
  return index;
}

int add_triangles(const Mesh& mesh, ModelBuilder& builder) {
  const int index = builder.add(mesh.triangles, TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  builder.model().accessors.back().count *= 3;
  return index;
}

/// Matt, since vertex colours are albedo; seen from behind as well, since a scan is open there.
tinygltf::Material matt_material() {
  tinygltf::Material material;
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.roughnessFactor = 1;
  material.doubleSided = true;
  return material;
}

void add_surface(const Mesh& mesh, ModelBuilder& builder) {
  tinygltf::Primitive primitive;
  primitive.attributes["POSITION"] = add_positions(mesh, builder);
  primitive.attributes["NORMAL"] = add_normals(mesh, builder);
  primitive.attributes["COLOR_0"] = add_colors(mesh, builder);
  primitive.material = 0;
  primitive.mode = mesh.triangles.empty() ? TINYGLTF_MODE_POINTS : TINYGLTF_MODE_TRIANGLES;
  if (!mesh.triangles.empty()) primitive.indices = add_triangles(mesh, builder);
  tinygltf::Model& model = builder.model();
  model.materials.push_back(matt_material());
  model.meshes.emplace_back();
  model.meshes.back().primitives.push_back(std::move(primitive));
  model.nodes.emplace_back();
  model.nodes.back().name = "refined surface";
  model.nodes.back().mesh = 0;
}

}  // namespace

std::string glb_bytes(const Mesh& mesh) {
  ModelBuilder builder;
  tinygltf::Model& model = builder.model();
  model.asset.version = "2.0";
  model.asset.generator = "Rakelight";
  model.scenes.emplace_back();
  model.defaultScene = 0;
  if (mesh.vertices.empty()) {
    model.buffers.clear();  // glTF knows no empty accessor: the scene has no node
  } else {
    add_surface(mesh, builder);
    model.scenes.front().nodes.push_back(0);
  }
  std::ostringstream bytes;
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, bytes, false, true))
    throw IoError("cannot encode the surface as glTF");
  return bytes.str();
}

}  // namespace rakelight
