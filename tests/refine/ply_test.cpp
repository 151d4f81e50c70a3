// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/ply.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <sstream>

#include "tests/support/sample_result.h"

namespace rakelight {
namespace {

using test::kSampleHeight;
using test::kSampleJump;
using test::kSampleWidth;

template <class T>
T take(const std::string& bytes, std::size_t& at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  at += sizeof(T);
  return value;
}

/// A reader that knows nothing of the writer but the header's words.
struct ParsedPly {
  std::vector<std::string> properties;
  std::vector<MeshVertex> vertices;
  std::vector<std::array<int, 3>> triangles;
  std::size_t bytes_left = 0;
};

ParsedPly parse(const std::string& bytes) {
  ParsedPly ply;
  std::istringstream header(bytes);
  std::size_t vertex_count = 0, face_count = 0;
  for (std::string line; std::getline(header, line) && line != "end_header";) {
    std::istringstream words(line);
    std::string first, second;
    words >> first >> second;
    if (first == "element") words >> (second == "vertex" ? vertex_count : face_count);
    if (first == "property") ply.properties.push_back(line);
    if (first == "format") { EXPECT_EQ(line, "format binary_little_endian 1.0"); }
  }
  auto at = static_cast<std::size_t>(header.tellg());
  for (std::size_t i = 0; i < vertex_count; ++i) {
    MeshVertex vertex;
    for (float& value : vertex.position.val) value = take<float>(bytes, at);
    for (float& value : vertex.normal.val) value = take<float>(bytes, at);
    for (uchar& value : vertex.color.val) value = take<uchar>(bytes, at);
    vertex.delta_mm = take<float>(bytes, at);
    ply.vertices.push_back(vertex);
  }
  for (std::size_t i = 0; i < face_count; ++i) {
    EXPECT_EQ(take<uchar>(bytes, at), 3);
    ply.triangles.push_back({take<int>(bytes, at), take<int>(bytes, at), take<int>(bytes, at)});
  }
  ply.bytes_left = bytes.size() - at;
  return ply;
}

TEST(Ply, DeclaresWhatMeshProgramsExpect) {
  const std::vector<std::string> expected{"property float x",
                                          "property float y",
                                          "property float z",
                                          "property float nx",
                                          "property float ny",
                                          "property float nz",
                                          "property uchar red",
                                          "property uchar green",
                                          "property uchar blue",
                                          "property float delta_mm",
                                          "property list uchar int vertex_indices"};
  EXPECT_EQ(parse(ply_bytes(mesh_of(test::sample_result()))).properties, expected);
}

TEST(Ply, CarriesEveryPixelWithDepthAndNothingMore) {
  const RefineResult result = test::sample_result();
  const ParsedPly ply = parse(ply_bytes(mesh_of(result)));
  EXPECT_EQ(ply.vertices.size(), static_cast<std::size_t>((kSampleWidth - 2) * (kSampleHeight - 2)));
  EXPECT_EQ(ply.bytes_left, 0U);

  const MeshVertex& first = ply.vertices.front();  // pixel (1, 1)
  const double z = result.depth(1, 1);
  EXPECT_NEAR(first.position[0], (1 - 11.5) * z / 570.0, 1e-6);
  EXPECT_NEAR(first.position[1], (1 - 7.5) * z / 572.0, 1e-6);
  EXPECT_FLOAT_EQ(first.position[2], result.depth(1, 1));
  EXPECT_EQ(first.normal, result.normals(1, 1));
  EXPECT_NEAR(first.delta_mm, 1.0, 1e-4);
  EXPECT_GT(first.color[2], first.color[1]);  // blue is brightest at the upper left
  EXPECT_GT(first.color[1], first.color[0]);
}

TEST(Ply, HasNoFaceAcrossADepthJump) {
  const ParsedPly ply = parse(ply_bytes(mesh_of(test::sample_result())));
  const auto is_near = [&](int vertex) {
    return ply.vertices[static_cast<std::size_t>(vertex)].position[2] < 0.6f;
  };
  for (const auto& [a, b, c] : ply.triangles) {
    EXPECT_EQ(is_near(a), is_near(b));
    EXPECT_EQ(is_near(b), is_near(c));
  }
  const int squares = (kSampleJump - 2 + kSampleWidth - kSampleJump - 2) * (kSampleHeight - 3);
  EXPECT_EQ(ply.triangles.size(), static_cast<std::size_t>(2 * squares));
}

TEST(Ply, FacesLookAtTheCamera) {
  const ParsedPly ply = parse(ply_bytes(mesh_of(test::sample_result())));
  for (const auto& [a, b, c] : ply.triangles) {
    const auto at = [&](int vertex) { return ply.vertices[static_cast<std::size_t>(vertex)].position; };
    EXPECT_LT((at(b) - at(a)).cross(at(c) - at(a))[2], 0.0f);
  }
}

TEST(Mesh, FillsASquareThatLacksACornerWithOneTriangle) {
  for (const cv::Point missing : {cv::Point(1, 1), cv::Point(2, 1), cv::Point(1, 2), cv::Point(2, 2)}) {
    RefineResult result = test::sample_result();
    for (int y = 0; y < kSampleHeight; ++y) {
      for (int x = 0; x < kSampleWidth; ++x) {
        if (x > 2 || y > 2 || cv::Point(x, y) == missing) result.depth(y, x) = NAN;
      }
    }
    EXPECT_EQ(mesh_of(result).triangles.size(), 1U) << missing;
  }
}

}  // namespace
}  // namespace rakelight
