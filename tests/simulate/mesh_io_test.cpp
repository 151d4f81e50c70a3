// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/mesh_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "stack/errors.h"
#include "tests/support/message_of.h"
#include "tests/support/shared_data.h"
#include "tests/support/temporary_folder.h"

namespace rakelight {
namespace {

using test::message_of;
using testing::HasSubstr;

class MeshFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
    return folder_.path() / name;
  }
  SceneMesh read(const std::string& name, const std::string& bytes) const {
    return read_mesh(write(name, bytes));
  }
  std::string refusal(const std::string& name, const std::string& bytes) const {
    const auto file = write(name, bytes);
    const std::string message = message_of<InputError>([&] { read_mesh(file); });
    EXPECT_THAT(message, HasSubstr(file.string()));
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message;
  }

 private:
  test::TemporaryFolder folder_;
};

const std::string kAsciiHeader =
    "ply\nformat ascii 1.0\ncomment a tent\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
    "float z\n"
    "property uchar red\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kAsciiBody = "-1 -1 0 7\n1 -1 0 7\n1 1 1 7\n-1 1 1 7\n3 0 1 2\n3 0 2 3\n";

template <typename T>
void put(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof raw);
}

/// The same four vertices with a strip of two triangles, binary.
std::string binary_strips() {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty double y\nproperty "
      "float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
  const double corners[4][3] = {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 1}, {1, 1, 1}};
  for (const auto& c : corners) {
    put(bytes, static_cast<float>(c[0]));
    put(bytes, c[1]);
    put(bytes, static_cast<float>(c[2]));
  }
  for (const int value : {5, 0, 1, 2, 3, -1}) put(bytes, value);
  return bytes;
}

void expect_tent(const SceneMesh& mesh) {
  ASSERT_EQ(mesh.vertices.size(), 4U);
  ASSERT_EQ(mesh.triangles.size(), 2U);
  ASSERT_EQ(mesh.normals.size(), 4U);
  ASSERT_EQ(mesh.texture.size(), 4U);
  // y up and z to the viewer become y down and z away; the box's centre (0, 0, 0.5) becomes the origin.
  EXPECT_TRUE(mesh.vertices[0].isApprox(Eigen::Vector3f(-1, 1, 0.5f)));
  const Eigen::Vector3f normal = Eigen::Vector3f(0, 1, -2).normalized();
  for (const auto& n : mesh.normals) EXPECT_NEAR(std::abs(n.dot(normal)), 1, 1e-5);
}

TEST_F(MeshFile, AsciiPlyIsRead) { expect_tent(read("tent.ply", kAsciiHeader + kAsciiBody)); }

TEST_F(MeshFile, BinaryTriangleStripsAreRead) { expect_tent(read("tent.ply", binary_strips())); }

TEST_F(MeshFile, ObjIsReadWithAnyFormOfFaces) {
  const std::string vertices = "# a tent\nv -1 -1 0\nv 1 -1 0\nv 1 1 1\nv -1 1 1\nvn 0 0 1\n";
  expect_tent(read("tent.obj", vertices + "f 1 2 3\nf 1 3 4\n"));
  expect_tent(read("tent.obj", vertices + "o part\ns off\nf 1/1 2//1 3/1/1 -1\r\n"));
}

TEST_F(MeshFile, VerticesWithoutAFaceDoNotCount) {
  expect_tent(read("tent.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 1\nv -1 1 1\nv 900 0 0\nf 1 2 3 4\n"));
}

TEST_F(MeshFile, EveryTruncationOfAPlyIsRefused) {
  const std::string binary = binary_strips();
  for (std::size_t size = 0; size + 4 < binary.size(); ++size) refusal("cut.ply", binary.substr(0, size));
  const std::string ascii = kAsciiHeader + kAsciiBody;
  for (std::size_t size = 0; size + 2 < ascii.size(); ++size) refusal("cut.ply", ascii.substr(0, size));
}

TEST_F(MeshFile, NoFlippedByteOfAPlyDoesMoreThanAnError) {
  const std::string whole = binary_strips();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const char flip : {'\x01', '\x80', '\xff'}) {
      std::string spoilt = whole;
      spoilt[at] = static_cast<char>(spoilt[at] ^ flip);
      const auto file = write("flipped.ply", spoilt);
      try {
        for (const auto& v : read_mesh(file).vertices) ASSERT_TRUE(v.allFinite());
      } catch (const InputError&) {  // as it should be
      }
    }
  }
}

TEST_F(MeshFile, HugeCountsAreRefusedBeforeAllocation) {
  const auto with_count = [](const std::string& count) {
    return "ply\nformat binary_little_endian 1.0\nelement vertex " + count +
           "\nproperty float x\nproperty float y\nproperty float z\nend_header\n0123456789ab";
  };
  EXPECT_THAT(refusal("huge.ply", with_count("4000000000")), HasSubstr("ends too early"));
  EXPECT_THAT(refusal("huge.ply", with_count("18446744073709551615")), HasSubstr("ends too early"));
  EXPECT_THAT(refusal("huge.ply", with_count("99999999999999999999999")), HasSubstr("no number"));
  EXPECT_THAT(refusal("huge.ply", with_count("-1")), HasSubstr("no number"));
  std::string list = binary_strips();
  const int count = 2000000000;
  std::memcpy(&list[list.size() - 24], &count, sizeof count);
  EXPECT_THAT(refusal("huge.ply", list), HasSubstr("ends too early"));
}

TEST_F(MeshFile, AnElementWithoutPropertiesIsRefused) {
  EXPECT_THAT(refusal("empty.ply", "ply\nformat ascii 1.0\nelement vertex 99999999999\nend_header\n"),
              HasSubstr("without properties"));
}

TEST_F(MeshFile, IndicesBeyondTheLastVertexAreRefused) {
  EXPECT_THAT(
      refusal("beyond.ply", kAsciiHeader + "-1 -1 0 7\n1 -1 0 7\n1 1 1 7\n-1 1 1 7\n3 0 1 2\n3 0 2 4\n"),
      HasSubstr("beyond the last"));
  EXPECT_THAT(
      refusal("beyond.ply", kAsciiHeader + "-1 -1 0 7\n1 -1 0 7\n1 1 1 7\n-1 1 1 7\n3 0 1 2\n3 0 2 -7\n"),
      HasSubstr("names no vertex"));
  EXPECT_THAT(refusal("beyond.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"), HasSubstr("line 4"));
  EXPECT_THAT(refusal("zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"), HasSubstr("beyond the last"));
}

TEST_F(MeshFile, VerticesThatAreNotFiniteAreRefused) {
  EXPECT_THAT(
      refusal("nan.ply", kAsciiHeader + "nan -1 0 7\n1 -1 0 7\n1 1 1 7\n-1 1 1 7\n3 0 1 2\n3 0 2 3\n"),
      HasSubstr("not finite"));
  EXPECT_THAT(refusal("inf.obj", "v 0 0 inf\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), HasSubstr("not finite"));
}

TEST_F(MeshFile, WhatIsNoSurfaceIsRefused) {
  EXPECT_THAT(refusal("points.obj", "v 0 0 0\nv 1 0 0\n"), HasSubstr("no faces"));
  EXPECT_THAT(refusal("point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n"), HasSubstr("no extent"));
  EXPECT_THAT(refusal("line.obj", "v 1 1 1\nv 1 2 1\nf 1 2\n"), HasSubstr("fewer than three"));
  EXPECT_THAT(refusal("word.obj", "v 1 one 1\n"), HasSubstr("line 1"));
  EXPECT_THAT(refusal("mesh.stl", "solid\n"), HasSubstr("neither PLY nor OBJ"));
  EXPECT_THAT(refusal("big.ply", "ply\nformat binary_big_endian 1.0\nend_header\n"),
              HasSubstr("little-endian"));
  EXPECT_THAT(message_of<InputError>([] { read_mesh("no/such/mesh.ply"); }), HasSubstr("no/such/mesh.ply"));
}

TEST(ScannedMeshes, AreReadWhole) {
  RAKELIGHT_NEED_SHARED_DATA(meshes, "meshes");
  const SceneMesh igea = read_mesh(meshes / "igea.ply");
  EXPECT_EQ(igea.vertices.size(), 134345U);
  EXPECT_EQ(igea.triangles.size(), 268686U);
  EXPECT_EQ(read_mesh(meshes / "stanford-bunny.obj").triangles.size(), 69451U);
}

}  // namespace
}  // namespace rakelight
