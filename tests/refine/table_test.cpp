// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "stack/errors.h"
#include "tests/support/bump_stack.h"

namespace rakelight {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TableCell cell(double rmse_mm, double mae_deg, const std::string& note = "") {
  Evaluation errors;
  errors.rmse_mm = rmse_mm;
  errors.mae_deg = mae_deg;
  return {errors, note};
}

/// Two stacks; the second method cannot serve the first stack.
MethodTable small_table() {
  MethodTable table;
  table.stacks = {"simple", "led"};
  table.rows = {{"input", {cell(1.0, 2.0), cell(3.3, 16.3)}},
                {"multi-light", {cell(2.0, 1.50), {std::nullopt, "too few images"}}},
                {"rgb-ratio", {{std::nullopt, "no colour-lit image"}, cell(2.01, 5.0, "did not settle")}},
                {"fusion-like", {cell(2.004, 1.6), {std::nullopt, "too few images"}}}};
  return table;
}

TEST(TableMarkdown, HasTwoColumnsAStackWithTheBestInBoldAndNumberedFootnotes) {
  EXPECT_EQ(table_markdown(small_table()),
            "| Method | simple: RMSE mm | MAE ° | led: RMSE mm | MAE ° |\n"
            "| --- | ---: | ---: | ---: | ---: |\n"
            "| input | 1.00 | 2.00 | 3.30 | 16.30 |\n"
            "| multi-light | **2.00** | **1.50** | –<sup>1</sup> | – |\n"
            "| rgb-ratio | –<sup>2</sup> | – | **2.01**<sup>3</sup> | **5.00** |\n"
            "| fusion-like | **2.00** | 1.60 | –<sup>1</sup> | – |\n"
            "\n<sup>1</sup> too few images\n"
            "\n<sup>2</sup> no colour-lit image\n"
            "\n<sup>3</sup> did not settle\n");
}

TEST(TableMarkdown, KeepsItsShapeWhateverNamesAndNotesHold) {
  MethodTable table = small_table();
  table.stacks[0] = "a|b";
  table.rows[2].cells[0].note = "first\nsecond | third";
  const std::string text = table_markdown(table);
  EXPECT_THAT(text, HasSubstr("a\\|b: RMSE mm"));
  EXPECT_THAT(text, HasSubstr("first second \\| third"));
}

TEST(TableMarkdown, ShowsADashForWhatIsNoNumber) {
  MethodTable table = small_table();
  table.rows[1].cells[0].errors->mae_deg = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(table_markdown(table), HasSubstr("| multi-light | **2.00** | – |"));
}

TEST(TableJson, HoldsEveryCellWithItsErrorsOrItsReason) {
  MethodTable table = small_table();
  table.rows[3].cells[0].errors->median_deg = std::numeric_limits<double>::quiet_NaN();
  const auto json = nlohmann::json::parse(table_json(table));
  EXPECT_EQ(json.at("stacks"), nlohmann::json({"simple", "led"}));
  ASSERT_EQ(json.at("rows").size(), 4U);
  const auto& multi_light = json.at("rows")[1].at("cells");
  EXPECT_EQ(multi_light[0].at("stack"), "simple");
  EXPECT_EQ(multi_light[0].at("mae_deg"), 1.5);
  EXPECT_FALSE(multi_light[1].contains("rmse_mm"));
  EXPECT_EQ(multi_light[1].at("note"), "too few images");
  EXPECT_TRUE(json.at("rows")[3].at("cells")[0].at("median_deg").is_null());
}

TEST(TableVariants, AreEveryMethodInBothPresetsAndWithoutSmoothnessWhereItHasSome) {
  std::vector<std::string> names;
  std::set<std::string> slugs;
  for (const TableVariant& variant : table_variants()) {
    names.push_back(variant.name);
    slugs.insert(variant.slug);
    EXPECT_EQ(variant.slug.find_first_of(" ,()"), std::string::npos) << variant.slug;
    const bool ns = variant.name.find("(ns)") != std::string::npos;
    EXPECT_TRUE(!ns || variant.options.depth.smoothness == 0) << variant.name;
  }
  EXPECT_EQ(slugs.size(), names.size());
  for (const char* method : {"multi-light", "rgb-ratio", "fusion-like", "rgbd-fusion"}) {
    EXPECT_THAT(names, Contains(std::string(method) + ", paper"));
    EXPECT_THAT(names, Contains(std::string(method) + ", robust"));
  }
  for (const char* name : {"fusion-like, paper (ns)", "rgbd-fusion, paper (ns)", "fusion-like, robust (ns)"})
    EXPECT_THAT(names, Contains(name));
  EXPECT_THAT(names, Not(Contains("multi-light, robust (ns)")));  // it has no such term
}

TEST(RunVariant, GivesTheErrorsOfResultAndInput) {
  RefineOptions options = preset_options(Preset::robust);
  options.max_iterations = 12;
  const VariantRun run = run_variant(test::bump_stack(), test::bump_truth(), options);
  ASSERT_TRUE(run.result && run.cell.errors);
  EXPECT_THAT(run.cell.note, IsEmpty());
  const TableCell input = input_cell(*run.result, test::bump_truth());
  EXPECT_LT(run.cell.errors->mae_deg, 0.5 * input.errors->mae_deg);
}

TEST(RunVariant, TurnsARefusalIntoANote) {
  const VariantRun run =
      run_variant(test::bump_stack(), test::bump_truth(), preset_options(Preset::robust, Method::rgb_ratio));
  EXPECT_FALSE(run.result || run.cell.errors);
  EXPECT_THAT(run.cell.note, HasSubstr("red, green and blue lamps"));
}

TEST(RunVariant, PassesCancellationOn) {
  EXPECT_THROW(run_variant(test::bump_stack(), test::bump_truth(), {}, [](const Progress&) { return false; }),
               Cancelled);
}

}  // namespace
}  // namespace rakelight
