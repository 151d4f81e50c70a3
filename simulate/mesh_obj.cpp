// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <charconv>
#include <cstdlib>
#include <string_view>

#include "simulate/mesh_formats.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

/// Cuts the next token (no blanks) off a line; empty at its end.
std::string_view next_token(std::string_view& line) {
  constexpr std::string_view kBlank = " \t\r";
  const auto start = std::min(line.find_first_not_of(kBlank), line.size());
  line.remove_prefix(start);
  const auto length = std::min(line.find_first_of(kBlank), line.size());
  const std::string_view token = line.substr(0, length);
  line.remove_prefix(length);
  return token;
}

class ObjParser {
 public:
  explicit ObjParser(const std::filesystem::path& file) : file_(file) {}

  void read_line(std::string_view line) {
    ++line_number_;
    const std::string_view keyword = next_token(line);
    if (keyword == "v") read_vertex(line);
    if (keyword == "f") read_face(line);
  }

  SceneMesh take() { return std::move(mesh_); }

 private:
  [[noreturn]] void fail(const std::string& fault) const {
    throw InputError(file_.string(), "line " + std::to_string(line_number_) + " " + fault, "repair the mesh");
  }

  void read_vertex(std::string_view line) {
    Eigen::Vector3f vertex;
    for (int k = 0; k < 3; ++k) {
      const std::string_view token = next_token(line);
      const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), vertex[k]);
      if (error != std::errc() || end != token.data() + token.size())
        fail("has a vertex without three numbers");
    }
    mesh_.vertices.push_back(vertex);
  }

  /// "7", "7/1", "7//3", "7/1/3"; 1 is the first vertex, -1 the latest.
  std::uint32_t vertex_index(std::string_view token) const {
    const std::string_view number = token.substr(0, token.find('/'));
    long index = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), index);
    const auto count = static_cast<long>(mesh_.vertices.size());
    if (error != std::errc() || end != number.data() + number.size())
      fail("has a face index that is no number");
    const long absolute = index < 0 ? count + index : index - 1;
    if (absolute < 0 || absolute >= count) fail("has a face that names a vertex beyond the last");
    return static_cast<std::uint32_t>(absolute);
  }

  void read_face(std::string_view line) {
    std::vector<std::uint32_t> corners;
    for (std::string_view token = next_token(line); !token.empty(); token = next_token(line)) {
      corners.push_back(vertex_index(token));
    }
    if (corners.size() < 3) fail("has a face of fewer than three vertices");
    for (std::size_t k = 2; k < corners.size(); ++k)
      mesh_.triangles.push_back({corners[0], corners[k - 1], corners[k]});
  }

  const std::filesystem::path& file_;
  SceneMesh mesh_;
  std::size_t line_number_ = 0;
};

}  // namespace

SceneMesh parse_obj(const std::string& bytes, const std::filesystem::path& file) {
  ObjParser parser(file);
  std::string_view rest = bytes;
  while (!rest.empty()) {
    const auto end = std::min(rest.find('\n'), rest.size());
    parser.read_line(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return parser.take();
}

}  // namespace rakelight
