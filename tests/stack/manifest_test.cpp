// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/manifest.h"

#include <gmock/gmock.h>

#include "stack/errors.h"
#include "tests/support/message_of.h"

namespace rakelight {
namespace {

using test::message_of;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kSmallest = R"({
  "format": "rakelight-stack", "version": 1,
  "color_camera": {"width": 640, "height": 480, "fx": 570, "fy": 571, "cx": 319.5, "cy": 239.5},
  "depth_camera": {"width": 320, "height": 240, "fx": 285, "fy": 285, "cx": 160, "cy": 120},
  "depth_unit_m": 0.001, "color_response": "srgb",
  "lights": [{"id": "a", "color": "white"}, {"id": "b", "color": "rgb"}],
  "frames": [{"index": 0, "light": "a", "color": "color/0.png"}, {"index": 1, "light": null, "depth": "d.png"}]
})";

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = kSmallest;
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::invalid_argument("no " + from);
  return text.replace(at, from.size(), to);
}

std::string refusal(const std::string& text) {
  return message_of<InputError>([&] { parse_manifest(text, "dir/stack.json"); });
}

/// The refusal of the smallest manifest with one thing replaced.
std::string refusal(const std::string& from, const std::string& to) { return refusal(replaced(from, to)); }

TEST(Manifest, the_smallest_has_defaults_for_the_rest) {
  const Manifest manifest = parse_manifest(kSmallest, "stack.json");
  EXPECT_EQ(manifest.stack.color_camera.fy, 571);
  EXPECT_EQ(manifest.stack.color_response.kind, ColorResponse::Kind::srgb);
  EXPECT_TRUE(manifest.stack.T_color_depth.isIdentity(0));
  EXPECT_TRUE(manifest.stack.color_crosstalk.isIdentity(0));
  EXPECT_FALSE(manifest.stack.exposure_us || manifest.stack.gain || manifest.stack.white_balance);
  EXPECT_EQ(manifest.stack.frames[0].light, "a");
  EXPECT_FALSE(manifest.stack.frames[1].light) << "null is a dark frame";
  EXPECT_EQ(manifest.files[1].depth, "d.png");
  EXPECT_EQ(manifest.files[1].color, "");
  EXPECT_EQ(manifest.stack.unknown_keys, "");
}

TEST(Manifest, a_refusal_names_file_key_fault_and_cure) {
  EXPECT_EQ(refusal("\"fx\": 570", "\"fx\": -3"),
            "dir/stack.json color_camera fx: is no usable number; write a number from 0.001 to 1000000.0");
}

TEST(Manifest, what_is_not_json_is_refused) {
  for (const std::string text :
       {"", "{", "null", "[]", "7", "\"x\"", "\xff\xfe", "{\"a\": nul}", "{\"a\": 1,}"}) {
    EXPECT_THAT(refusal(text), HasSubstr("dir/stack.json")) << text;
  }
  EXPECT_THAT(refusal(std::string(kSmallest) + "x"), HasSubstr("not valid JSON"));
  EXPECT_THAT(refusal(std::string("{\"a\": \"\0\"}", 10)), HasSubstr("not valid JSON"));
  EXPECT_THAT(refusal("\"a\", \"color\"", "\"\xc3\x28\", \"color\""), HasSubstr("not valid JSON"));
}

TEST(Manifest, deep_nesting_is_refused_quickly) {
  EXPECT_THAT(refusal(std::string(10'000'000, '[')), HasSubstr("nested too deeply"));
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
  EXPECT_THAT(refusal(objects), HasSubstr("nested too deeply"));
}

TEST(Manifest, duplicate_keys_are_refused_at_any_depth) {
  EXPECT_THAT(refusal("\"version\": 1,", "\"version\": 1, \"version\": 1,"), HasSubstr("\"version\" twice"));
  EXPECT_THAT(refusal("\"fy\": 571", "\"fx\": 571"), HasSubstr("\"fx\" twice"));
  EXPECT_NO_THROW(
      parse_manifest(replaced("\"version\": 1,", "\"version\": 1, \"x\": {\"version\": 1},"), "f"));
}

TEST(Manifest, other_formats_and_versions_are_refused) {
  EXPECT_THAT(refusal("rakelight-stack", "other"), HasSubstr("format"));
  EXPECT_THAT(refusal("\"version\": 1", "\"version\": 2"), HasSubstr("update Rakelight"));
  EXPECT_THAT(refusal("\"version\": 1", "\"version\": 0"), HasSubstr("version"));
  EXPECT_THAT(refusal("\"version\": 1", "\"version\": 1.5"), HasSubstr("version"));
  EXPECT_THAT(refusal("\"version\": 1", "\"version\": \"1\""), HasSubstr("version"));
}

TEST(Manifest, every_required_key_is_missed_by_name) {
  for (const std::string key : {"format", "version", "color_camera", "depth_camera", "depth_unit_m",
                                "color_response", "lights", "frames"}) {
    EXPECT_THAT(refusal("\"" + key + "\"", "\"no_" + key + "\""),
                AllOf(HasSubstr(key), HasSubstr("is missing")));
  }
}

TEST(Manifest, cameras_must_be_cameras) {
  for (const std::string fx : {"0", "-570", "1e999", "1e300", "null", "\"570\"", "true", "[570]", "{}"}) {
    EXPECT_THAT(refusal("\"fx\": 570", "\"fx\": " + fx), HasSubstr("stack.json")) << fx;
  }
  for (const std::string width :
       {"0", "-1", "16385", "640.5", "1e2", "99999999999999999999", "18446744073709551615"}) {
    EXPECT_THAT(refusal("\"width\": 640", "\"width\": " + width), HasSubstr("stack.json")) << width;
  }
  EXPECT_THAT(refusal("\"width\": 640, \"height\": 480", "\"width\": 16000, \"height\": 16000"),
              HasSubstr("too large"));
  EXPECT_THAT(refusal("\"cy\": 120", "\"cy\": 120, \"distortion\": [1, 2, 3]"), HasSubstr("distortion"));
  EXPECT_THAT(refusal("\"cy\": 120", "\"cy\": 120, \"distortion\": [1, 2, 3, null]"),
              HasSubstr("distortion"));
}

TEST(Manifest, depth_unit_and_response_must_be_usable) {
  for (const std::string unit : {"0", "-0.001", "2", "\"1 mm\"", "null"}) {
    EXPECT_THAT(refusal("\"depth_unit_m\": 0.001", "\"depth_unit_m\": " + unit), HasSubstr("depth_unit_m"))
        << unit;
  }
  for (const std::string response : {"\"sRGB\"", "2.2", "{\"gamma\": 0}", "{\"gamma\": -2}", "{}", "[]"}) {
    EXPECT_THAT(refusal("\"srgb\"", response), HasSubstr("color_response")) << response;
  }
}

TEST(Manifest, T_color_depth_must_be_a_rigid_motion) {
  const auto with = [](const std::string& matrix) {
    return refusal("\"depth_unit_m\"", "\"T_color_depth\": " + matrix + ", \"depth_unit_m\"");
  };
  EXPECT_THAT(with("[[2,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]"), HasSubstr("rigid"));
  EXPECT_THAT(with("[[-1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]"), HasSubstr("rigid")) << "a reflection";
  EXPECT_THAT(with("[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,1,1]]"), HasSubstr("rigid"));
  EXPECT_THAT(with("[[1,0,0,0],[0,1,0,0],[0,0,1,0]]"), HasSubstr("no matrix"));
  EXPECT_THAT(with("[[1,0,0,1e9],[0,1,0,0],[0,0,1,0],[0,0,0,1]]"), HasSubstr("usable numbers"));
  EXPECT_THAT(with("\"identity\""), HasSubstr("no matrix"));
  EXPECT_NO_THROW(parse_manifest(replaced("\"depth_unit_m\"",
                                          "\"T_color_depth\": [[0,-1,0,0.02],[1,0,0,0],[0,0,1,0],[0,0,0,1]], "
                                          "\"depth_unit_m\""),
                                 "f"));
}

TEST(Manifest, crosstalk_must_be_reversible) {
  const auto with = [](const std::string& matrix) {
    return refusal("\"depth_unit_m\"", "\"color_crosstalk\": " + matrix + ", \"depth_unit_m\"");
  };
  EXPECT_THAT(with("[[1,1,0],[1,1,0],[0,0,1]]"), HasSubstr("singular"));
  EXPECT_THAT(with("[[0,0,0],[0,0,0],[0,0,0]]"), HasSubstr("singular"));
  EXPECT_THAT(with("[[1,0],[0,1]]"), HasSubstr("no matrix"));
}

TEST(Manifest, lights_are_named_once_and_known) {
  EXPECT_THAT(refusal("\"id\": \"b\"", "\"id\": \"a\""), HasSubstr("taken by another lamp"));
  EXPECT_THAT(refusal("\"id\": \"b\"", "\"id\": \"\""), HasSubstr("empty"));
  EXPECT_THAT(refusal("\"id\": \"b\"", "\"id\": \"\\u001b[2J\""), HasSubstr("control character"));
  EXPECT_THAT(refusal("\"color\": \"rgb\"", "\"color\": \"mauve\""),
              AllOf(HasSubstr("mauve"), HasSubstr("rgb")));
  EXPECT_THAT(refusal("\"light\": \"a\"", "\"light\": \"c\""), HasSubstr("'c' is not among the lights"));
  EXPECT_THAT(refusal("\"color\": \"rgb\"", "\"color\": \"rgb\", \"position_m\": [1, 2]"),
              HasSubstr("position_m"));
  EXPECT_THAT(refusal("\"color\": \"rgb\"", "\"color\": \"rgb\", \"line\": -1"), HasSubstr("line"));
}

TEST(Manifest, frames_are_numbered_once_and_have_an_image) {
  EXPECT_THAT(refusal("\"index\": 1", "\"index\": 0"), HasSubstr("taken by another frame"));
  EXPECT_THAT(refusal("\"index\": 1", "\"index\": -1"), HasSubstr("index"));
  EXPECT_THAT(refusal(", \"depth\": \"d.png\"", ""), HasSubstr("both missing"));
  EXPECT_THAT(refusal("\"d.png\"", "\"color/0.png\""), HasSubstr("another entry names"));
  EXPECT_THAT(refusal("\"d.png\"", "7"), HasSubstr("is no text"));
  EXPECT_THAT(refusal("\"d.png\"", "\"d.png\", \"depth_time\": {\"host_us\": 1.5}"), HasSubstr("host_us"));
  EXPECT_THAT(refusal("\"d.png\"", "\"d.png\", \"lit_check\": {\"matches\": true}"), HasSubstr("rows_rgb"));
}

TEST(Manifest, an_empty_list_of_frames_is_refused) {
  const std::string text = kSmallest;
  EXPECT_THAT(refusal(text.substr(0, text.find("\"frames\"")) + "\"frames\": []}"),
              HasSubstr("frames: is empty"));
}

TEST(Manifest, too_many_entries_are_refused) {
  std::string lights = "{\"id\": \"x0\", \"color\": \"white\"}";
  for (int i = 1; i < 5000; ++i) lights += ", {\"id\": \"x" + std::to_string(i) + "\", \"color\": \"white\"}";
  EXPECT_THAT(refusal("\"lights\": [", "\"lights\": [" + lights + ", "), HasSubstr("too many"));
}

TEST(Manifest, unknown_keys_are_kept_as_json) {
  const Manifest manifest = parse_manifest(
      replaced("\"id\": \"a\"", "\"id\": \"a\", \"watts\": 3").insert(1, "\"z\": [1, {\"y\": null}], "), "f");
  EXPECT_EQ(manifest.stack.unknown_keys, R"({"lights":{"a":{"watts":3}},"z":[1,{"y":null}]})");
}

TEST(Manifest, names_that_are_no_utf8_are_written_with_replacement_characters) {
  Manifest manifest = parse_manifest(kSmallest, "f");
  manifest.stack.sensor.name = "caf\xe9";
  const Manifest again = parse_manifest(manifest_text(manifest.stack, manifest.files), "f");
  EXPECT_EQ(again.stack.sensor.name, "caf\xef\xbf\xbd");
}

}  // namespace
}  // namespace rakelight
