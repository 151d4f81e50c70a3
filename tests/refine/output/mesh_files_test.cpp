// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// mesh.ply and mesh.glb as a program sees them that knows nothing of Rakelight.
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gtest/gtest.h>
#include <assimp/Importer.hpp>

#include "refine/output/glb.h"
#include "refine/output/ply.h"
#include "stack/color_response.h"
#include "tests/support/sample_result.h"

namespace rakelight {
namespace {

/// What assimp reads; empty meshes on failure, which is reported.
class Imported {
 public:
  Imported(const std::string& bytes, const char* kind) {
    scene_ = importer_.ReadFileFromMemory(bytes.data(), bytes.size(), aiProcess_ValidateDataStructure, kind);
    EXPECT_NE(scene_, nullptr) << importer_.GetErrorString();
  }
  unsigned meshes() const { return scene_ ? scene_->mNumMeshes : 0; }
  const aiMesh& mesh() const { return *scene_->mMeshes[0]; }

 private:
  Assimp::Importer importer_;
  const aiScene* scene_ = nullptr;
};

cv::Vec3f vec(const aiVector3D& v) { return {v.x, v.y, v.z}; }

void expect_near(const cv::Vec3f& a, const cv::Vec3f& b, double tolerance) {
  EXPECT_LE(cv::norm(a - b), tolerance);
}

void expect_faces(const aiMesh& read, const Mesh& written) {
  ASSERT_EQ(read.mNumFaces, written.triangles.size());
  for (unsigned k = 0; k < read.mNumFaces; ++k) {
    ASSERT_EQ(read.mFaces[k].mNumIndices, 3U);
    for (std::size_t corner = 0; corner < 3; ++corner)
      EXPECT_EQ(static_cast<int>(read.mFaces[k].mIndices[corner]), written.triangles[k][corner]);
  }
}

TEST(MeshFiles, PlyKeepsNormalsAndColours) {
  const Mesh written = mesh_of(test::sample_result());
  const Imported ply(ply_bytes(written), "ply");
  ASSERT_EQ(ply.meshes(), 1U);
  const aiMesh& read = ply.mesh();
  ASSERT_EQ(read.mNumVertices, written.vertices.size());
  ASSERT_TRUE(read.HasNormals() && read.HasVertexColors(0));
  for (unsigned k = 0; k < read.mNumVertices; ++k) {
    const MeshVertex& vertex = written.vertices[k];
    expect_near(vec(read.mVertices[k]), vertex.position, 1e-7);
    expect_near(vec(read.mNormals[k]), vertex.normal, 1e-6);
    const aiColor4D& color = read.mColors[0][k];
    expect_near({color.r, color.g, color.b}, cv::Vec3f(vertex.color) / 255, 1e-5);
  }
  expect_faces(read, written);
}

TEST(MeshFiles, GlbKeepsNormalsAndLinearColoursInTheFrameOfGltf) {
  const Mesh written = mesh_of(test::sample_result());
  const Imported glb(glb_bytes(written), "glb");
  ASSERT_EQ(glb.meshes(), 1U);
  const aiMesh& read = glb.mesh();
  ASSERT_EQ(read.mNumVertices, written.vertices.size());
  ASSERT_TRUE(read.HasNormals() && read.HasVertexColors(0));
  const ColorResponse srgb{ColorResponse::Kind::srgb, 1.0};
  for (unsigned k = 0; k < read.mNumVertices; ++k) {
    const MeshVertex& vertex = written.vertices[k];
    const auto y_up = [](const cv::Vec3f& v) { return cv::Vec3f(v[0], -v[1], -v[2]); };
    expect_near(vec(read.mVertices[k]), y_up(vertex.position), 1e-7);
    expect_near(vec(read.mNormals[k]), y_up(vertex.normal), 1e-6);
    const aiColor4D& color = read.mColors[0][k];
    EXPECT_NEAR(color.g, decode(srgb, vertex.color[1] / 255.0), 1e-4);
    EXPECT_NEAR(color.b, decode(srgb, vertex.color[2] / 255.0), 1e-4);
    EXPECT_FLOAT_EQ(color.a, 1.0f);
  }
  expect_faces(read, written);
}

TEST(MeshFiles, GlbFacesLookAtTheViewer) {
  const Imported glb(glb_bytes(mesh_of(test::sample_result())), "glb");
  ASSERT_EQ(glb.meshes(), 1U);
  for (unsigned k = 0; k < glb.mesh().mNumFaces; ++k) {
    const unsigned* index = glb.mesh().mFaces[k].mIndices;
    const auto at = [&](int corner) { return vec(glb.mesh().mVertices[index[corner]]); };
    EXPECT_GT((at(1) - at(0)).cross(at(2) - at(0))[2], 0.0f);
  }
}

TEST(MeshFiles, GlbOfNoSurfaceIsAnEmptyScene) {
  const std::string bytes = glb_bytes({});
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(bytes.find("accessors"), std::string::npos);
}

TEST(Mesh, TakesEveryStridethPixelAndStillCutsAtJumps) {
  const RefineResult result = test::sample_result();
  const Mesh all = mesh_of(result), coarse = mesh_of(result, 2);
  EXPECT_NEAR(static_cast<double>(coarse.vertices.size()), static_cast<double>(all.vertices.size()) / 4, 12);
  ASSERT_FALSE(coarse.triangles.empty());
  for (const auto& [a, b, c] : coarse.triangles) {
    const auto is_near = [&](int k) {
      return coarse.vertices[static_cast<std::size_t>(k)].position[2] < 0.6f;
    };
    EXPECT_EQ(is_near(a), is_near(b));
    EXPECT_EQ(is_near(b), is_near(c));
  }
}

TEST(Mesh, ThinsOnlyWhatIsTooLarge) {
  const cv::Mat1f depth(100, 100, 1.0f);
  EXPECT_EQ(stride_for(depth, 10'000), 1);
  EXPECT_EQ(stride_for(depth, 9'999), 2);
  EXPECT_EQ(stride_for(depth, 1'000), 4);
}

}  // namespace
}  // namespace rakelight
