// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <charconv>
#include <cstring>
#include <map>
#include <optional>
#include <string_view>

#include "simulate/mesh_formats.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

enum class Scalar { i8, u8, i16, u16, i32, u32, f32, f64 };

struct Property {
  std::string name;
  Scalar type = Scalar::f32;
  std::optional<Scalar> count_type;  ///< of a list's length
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  bool ascii = false;
  std::vector<Element> elements;
  std::size_t size = 0;  ///< bytes up to the first value
};

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& fault) {
  throw InputError(file.string(), fault,
                   "repair the mesh or convert it to PLY (ascii or binary little-endian) anew");
}

std::size_t size_of(Scalar type) {
  switch (type) {
    case Scalar::i8:
    case Scalar::u8:
      return 1;
    case Scalar::i16:
    case Scalar::u16:
      return 2;
    case Scalar::f64:
      return 8;
    default:
      return 4;
  }
}

std::vector<std::string> words(std::string_view line) {
  std::vector<std::string> result;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    result.emplace_back(line.substr(at, end - at));
    at = end;
  }
  return result;
}

Scalar parse_scalar(const std::string& name, const std::filesystem::path& file) {
  static const std::map<std::string, Scalar> kNames{
      {"char", Scalar::i8},   {"int8", Scalar::i8},     {"uchar", Scalar::u8},   {"uint8", Scalar::u8},
      {"short", Scalar::i16}, {"int16", Scalar::i16},   {"ushort", Scalar::u16}, {"uint16", Scalar::u16},
      {"int", Scalar::i32},   {"int32", Scalar::i32},   {"uint", Scalar::u32},   {"uint32", Scalar::u32},
      {"float", Scalar::f32}, {"float32", Scalar::f32}, {"double", Scalar::f64}, {"float64", Scalar::f64}};
  const auto found = kNames.find(name);
  if (found == kNames.end()) fail(file, "has a property of unknown type");
  return found->second;
}

Element parse_element(const std::vector<std::string>& line, const std::filesystem::path& file) {
  Element element;
  if (line.size() != 3) fail(file, "has a malformed element line");
  element.name = line[1];
  const std::string& number = line[2];
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), element.count);
  if (error != std::errc() || end != number.data() + number.size())
    fail(file, "has an element count that is no number");
  return element;
}

Property parse_property(const std::vector<std::string>& line, const std::filesystem::path& file) {
  if (line.size() == 3) return {line[2], parse_scalar(line[1], file), std::nullopt};
  if (line.size() == 5 && line[1] == "list")
    return {line[4], parse_scalar(line[3], file), parse_scalar(line[2], file)};
  fail(file, "has a malformed property line");
}

void parse_header_line(const std::vector<std::string>& line, const std::filesystem::path& file,
                       Header& header, bool& has_format) {
  if (line.empty() || line[0] == "comment" || line[0] == "obj_info" || line[0] == "ply") return;
  if (line[0] == "format") {
    has_format = line.size() == 3 && (line[1] == "ascii" || line[1] == "binary_little_endian");
    if (!has_format) fail(file, "is neither ascii nor binary little-endian");
    header.ascii = line[1] == "ascii";
  } else if (line[0] == "element") {
    header.elements.push_back(parse_element(line, file));
  } else if (line[0] == "property" && !header.elements.empty()) {
    header.elements.back().properties.push_back(parse_property(line, file));
  } else {
    fail(file, "has an unknown line in its header");
  }
}

Header parse_header(const std::string& bytes, const std::filesystem::path& file) {
  Header header;
  bool has_format = false;
  std::size_t at = 0;
  while (true) {
    const std::size_t end = bytes.find('\n', at);
    if (end == std::string::npos) fail(file, "ends within its header");
    const auto line = words(std::string_view(bytes).substr(at, end - at));
    at = end + 1;
    if (line.size() == 1 && line[0] == "end_header") break;
    parse_header_line(line, file, header, has_format);
  }
  if (!has_format) fail(file, "does not name its format");
  header.size = at;
  return header;
}

/// Hands out the values of the body, one by one, as numbers.
class Values {
 public:
  Values(const std::string& bytes, const Header& header, const std::filesystem::path& file)
      : rest_(std::string_view(bytes).substr(header.size)), ascii_(header.ascii), file_(file) {}

  double next(Scalar type) { return ascii_ ? next_word() : next_binary(type); }

  /// An upper bound of how many values of a type are still to come.
  std::uint64_t at_most(Scalar type) const {
    return ascii_ ? (rest_.size() + 1) / 2 : rest_.size() / size_of(type);
  }

 private:
  double next_word() {
    constexpr std::string_view kBlank = " \t\r\n";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlank), rest_.size()));
    const std::string_view word = rest_.substr(0, std::min(rest_.find_first_of(kBlank), rest_.size()));
    if (word.empty()) fail(file_, "ends too early");
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      fail(file_, "has a value that is no number");
    rest_.remove_prefix(word.size());
    return value;
  }

  template <typename T>
  double take() {
    T value;
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_.remove_prefix(sizeof value);
    return static_cast<double>(value);
  }

  double next_binary(Scalar type) {
    if (rest_.size() < size_of(type)) fail(file_, "ends too early");
    switch (type) {
      case Scalar::i8:
        return take<std::int8_t>();
      case Scalar::u8:
        return take<std::uint8_t>();
      case Scalar::i16:
        return take<std::int16_t>();
      case Scalar::u16:
        return take<std::uint16_t>();
      case Scalar::i32:
        return take<std::int32_t>();
      case Scalar::u32:
        return take<std::uint32_t>();
      case Scalar::f32:
        return take<float>();
      case Scalar::f64:
        return take<double>();
    }
    return 0;
  }

  std::string_view rest_;
  bool ascii_;
  const std::filesystem::path& file_;
};

/// The body: elements in the header's order.
class Body {
 public:
  Body(const std::string& bytes, const Header& header, const std::filesystem::path& file)
      : values_(bytes, header, file), file_(file) {}

  void read(const Element& element) {
    check_count(element);
    if (element.name == "vertex") mesh_.vertices.reserve(element.count);
    for (std::uint64_t k = 0; k < element.count; ++k) {
      if (element.name == "vertex") mesh_.vertices.emplace_back(Eigen::Vector3f::Zero());
      for (const Property& property : element.properties) read(element, property);
    }
  }

  SceneMesh take() { return std::move(mesh_); }

 private:
  /// A count that the rest of the file cannot hold is refused before anything is allocated for it.
  void check_count(const Element& element) const {
    if (element.properties.empty()) fail(file_, "has an element without properties");
    const Property& first = element.properties.front();
    if (element.count > values_.at_most(first.count_type.value_or(first.type))) fail(file_, "ends too early");
  }

  void read(const Element& element, const Property& property) {
    if (property.count_type) return read_list(element, property);
    const double value = values_.next(property.type);
    if (element.name != "vertex") return;
    auto& vertex = mesh_.vertices.back();
    if (property.name == "x") vertex.x() = static_cast<float>(value);
    if (property.name == "y") vertex.y() = static_cast<float>(value);
    if (property.name == "z") vertex.z() = static_cast<float>(value);
  }

  void read_list(const Element& element, const Property& property) {
    const double length = values_.next(*property.count_type);
    if (!(length >= 0) || length > static_cast<double>(values_.at_most(property.type)))
      fail(file_, "ends too early");
    std::vector<double> list(static_cast<std::size_t>(length));
    for (double& value : list) value = values_.next(property.type);
    if (element.name == "face" && is_indices(property)) add_face(list);
    if (element.name == "tristrips" && is_indices(property)) add_strips(list);
  }

  static bool is_indices(const Property& property) {
    return property.name == "vertex_indices" || property.name == "vertex_index";
  }

  std::uint32_t index(double value) const {
    if (!(value >= 0) || value >= 4294967295.0) fail(file_, "has a face that names no vertex");
    return static_cast<std::uint32_t>(value);
  }

  void add_face(const std::vector<double>& corners) {
    if (corners.size() < 3) fail(file_, "has a face of fewer than three vertices");
    for (std::size_t k = 2; k < corners.size(); ++k) {
      mesh_.triangles.push_back({index(corners[0]), index(corners[k - 1]), index(corners[k])});
    }
  }

  /// Strips of triangles, each new vertex one with the two before it; -1 ends a strip.
  void add_strips(const std::vector<double>& list) {
    std::size_t length = 0;
    for (std::size_t k = 0; k < list.size(); ++k) {
      length = list[k] == -1 ? 0 : length + 1;
      if (length < 3) continue;
      const std::uint32_t a = index(list[k - 2]), b = index(list[k - 1]), c = index(list[k]);
      if (a == b || b == c || a == c) continue;  // strips turn corners by repeating a vertex
      if (length % 2 == 1)
        mesh_.triangles.push_back({a, b, c});
      else
        mesh_.triangles.push_back({b, a, c});
    }
  }

  Values values_;
  const std::filesystem::path& file_;
  SceneMesh mesh_;
};

}  // namespace

SceneMesh parse_ply(const std::string& bytes, const std::filesystem::path& file) {
  const Header header = parse_header(bytes, file);
  Body body(bytes, header, file);
  for (const Element& element : header.elements) body.read(element);
  return body.take();
}

}  // namespace rakelight
