// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "refine/output/report/embedded.h"
#include "refine/output/report/encoding.h"
#include "tests/support/sample_result.h"
#include "tests/support/small_stack.h"

namespace rakelight {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The JSON of one of the page's data elements.
nlohmann::json data_of(const std::string& page, const std::string& id) {
  const std::string open = "<script type=\"application/json\" id=\"" + id + "\">";
  const std::size_t at = page.find(open);
  if (at == std::string::npos) return {};
  const std::size_t begin = at + open.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++count;
  return count;
}

/// Noise as large as a result gets, which compresses badly.
RefineResult large_result(const cv::Size& size) {
  RefineResult result = test::sample_result();
  result.camera = {size.width, size.height, 2000, 2000, size.width / 2.0, size.height / 2.0, {}};
  result.depth = cv::Mat1f(size);
  cv::randu(result.depth, 0.5, 0.6);
  result.initial_depth = cv::Mat1f(size);
  cv::randu(result.initial_depth, 0.5, 0.6);
  result.normals = cv::Mat3f(size);
  cv::randu(result.normals, cv::Scalar(-0.5, -0.5, -1), cv::Scalar(0.5, 0.5, -0.6));
  result.albedo = cv::Mat3f(size);
  cv::randu(result.albedo, 0, 2);
  return result;
}

TEST(Report, LoadsNothing) {
  const LightStack stack = test::small_stack(8);
  const std::string page = report_html(test::sample_result(), &stack);
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  const std::regex reference(
      "(src|href|action|poster)=\"([^\"]*)\"|url\\(([^)]*)\\)|@import|https?://[^\"' ]*");
  for (std::sregex_iterator at(page.begin(), page.end(), reference), end; at != end; ++at) {
    const std::string found = at->str();
    const bool harmless = found.find("=\"data:") != std::string::npos ||
                          found.find("=\"#") != std::string::npos || found == "http://www.w3.org/2000/svg";
    EXPECT_TRUE(harmless) << found.substr(0, 80);
  }
}

TEST(Report, HasNoSlotLeftAndAltTextsForEveryPicture) {
  const std::string page = report_html(test::sample_result(), nullptr);
  EXPECT_THAT(page, Not(HasSubstr("{{")));
  const std::regex picture("<img [^>]*>");
  int pictures = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), picture), end; at != end; ++at, ++pictures)
    EXPECT_TRUE(std::regex_search(at->str().substr(0, 200), std::regex("alt=\"[^\"]{10,}\"")));
  EXPECT_EQ(pictures, 7);
  EXPECT_THAT(page, HasSubstr("<html lang=\"en\">"));
}

TEST(Report, TakesTextsOfAStackAsTextsNeverAsMarkup) {
  const std::string hostile = "</script><script>alert(1)</script><!--{{data}}\"'&";
  RefineResult result = test::sample_result();
  result.lights.front().id = hostile;
  result.warnings.push_back(hostile);
  LightStack stack = test::small_stack(8);
  stack.origin = "/scans/<b>bold<b>";
  stack.lights.front().id = hostile;
  stack.frames.front().light = hostile;
  const std::string honest = report_html(test::sample_result(), nullptr);
  const std::string page = report_html(result, &stack);
  EXPECT_EQ(count_of(page, "<script"), count_of(honest, "<script"));
  EXPECT_EQ(count_of(page, "</script"), count_of(honest, "</script"));
  EXPECT_THAT(page, Not(HasSubstr("<b>")));
  EXPECT_EQ(data_of(page, "result").at("lights").at(0).at("id"), hostile);
  EXPECT_EQ(data_of(page, "data").at("frames").at(0).at("lamp"), hostile);
  EXPECT_EQ(data_of(page, "data").at("name"), "<b>bold<b>");
}

TEST(Report, SurvivesTextThatIsNoUtf8) {
  LightStack stack = test::small_stack(8);
  stack.frames.front().light = "\xff\xfe";
  EXPECT_NO_THROW(data_of(report_html(test::sample_result(), &stack), "data"));
}

TEST(Report, ShowsTheFramesWithTheirLampsAndChecks) {
  LightStack stack = test::small_stack(8);
  stack.frames[0].color.setTo(cv::Scalar::all(255));
  const auto frames = data_of(report_html(test::sample_result(), &stack), "data").at("frames");
  ASSERT_EQ(frames.size(), stack.frames.size());
  EXPECT_EQ(frames[0].at("lamp"), *stack.frames[0].light);
  EXPECT_EQ(frames[0].at("color"), "red");
  EXPECT_EQ(frames[0].at("clipped"), 1.0);
  EXPECT_EQ(frames[0].at("lit"), nullptr);
  EXPECT_EQ(frames[1].at("lit"), true);
  EXPECT_EQ(frames[1].at("clipped"), 0.0);
  EXPECT_EQ(frames[4].at("lamp"), nullptr);
  for (const auto& frame : frames)
    EXPECT_THAT(frame.at("picture").get<std::string>(), testing::StartsWith("data:image/jpeg;base64,"));
}

TEST(Report, CountsEveryPixelOfTheSurfaceInTheHistogram) {
  const RefineResult result = test::sample_result();
  const auto data = data_of(report_html(result, nullptr), "data");
  int counted = data.at("delta").at("below").get<int>() + data.at("delta").at("above").get<int>();
  for (const int count : data.at("delta").at("counts")) counted += count;
  EXPECT_EQ(counted, (test::kSampleWidth - 2) * (test::kSampleHeight - 2));
  EXPECT_EQ(data.at("pixels"), counted);
  EXPECT_NEAR(data.at("delta").at("mean_mm").get<double>(), 1.0, 1e-3);
}

TEST(Report, StaysSmallWhateverTheResult) {
  LightStack stack = test::small_stack(8);
  for (Frame& frame : stack.frames) {
    frame.color = cv::Mat(1200, 1600, CV_8UC3);
    cv::randu(frame.color, 0, 256);
  }
  const RefineResult result = large_result({1600, 1200});
  const std::string page = report_html(result, &stack);
  EXPECT_LE(page.size(), kMaxReportBytes);
  EXPECT_GE(page.size(), kMaxReportBytes / 4);
  EXPECT_EQ(data_of(page, "data").at("frames").size(), stack.frames.size());
}

TEST(Report, OfAResultWithoutSurfaceIsStillAPage) {
  RefineResult result = test::sample_result();
  result.depth.setTo(NAN);
  result.iterations.clear();
  result.lights.clear();
  EXPECT_EQ(data_of(report_html(result, nullptr), "data").at("pixels"), 0);
}

TEST(Encoding, MatchesTheExamplesOfTheStandard) {
  const std::string text = "foobar";
  const char* expected[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (std::size_t size = 0; size <= text.size(); ++size)
    EXPECT_EQ(base64(text.data(), size), expected[size]);
}

TEST(Embedded, RefusesAFileThatIsNotThere) { EXPECT_THROW(embedded_file("nothing.js"), std::logic_error); }

}  // namespace
}  // namespace rakelight
