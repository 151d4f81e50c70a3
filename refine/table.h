// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every method and variant on the same stacks, in the layout of the paper's Table II.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "refine/evaluate.h"
#include "refine/refine.h"

namespace rakelight {

/// One row of the table: a method with its parameters.
struct TableVariant {
  std::string name;  ///< e.g. "rgb-ratio, robust (ns)"
  std::string slug;  ///< the same as a file name, e.g. "rgb-ratio-robust-ns"
  RefineOptions options;
};

/// All methods in the paper's order, each in presets paper and robust; "ns" (no Laplacian smoothness) where the preset
/// has such a term.
std::vector<TableVariant> table_variants();

/// One method on one stack: its errors, or why there are none.
struct TableCell {
  std::optional<Evaluation> errors;
  std::string note;  ///< why there are no errors, or what to mind; becomes a footnote
};

struct TableRow {
  std::string name;
  std::vector<TableCell> cells;  ///< one a stack
};

struct MethodTable {
  std::vector<std::string> stacks;  ///< names, the heads of the columns
  std::vector<TableRow> rows;
};

/// The table as Markdown: RMSE in mm and MAE in degrees a stack, the best of each column in bold (the row `input` aside),
/// a dash where a method cannot serve a stack, and footnotes.
std::string table_markdown(const MethodTable& table);

/// The same as a JSON object: `stacks`, and `rows` of `name` and `cells`. @throws nothing: NaN becomes null.
std::string table_json(const MethodTable& table);

/// A variant's result on a stack, and its cell.
struct VariantRun {
  std::optional<RefineResult> result;  ///< empty when the method cannot serve the stack
  TableCell cell;
};

/// Refines and evaluates. A stack that the method cannot serve is a cell with a note. @throws Cancelled.
VariantRun run_variant(const LightStack& stack, const GroundTruth& truth, const RefineOptions& options,
                       const ProgressCallback& progress = {});

/// Errors of the sensor's depth as the methods get it: filled and smoothed, not refined.
TableCell input_cell(const RefineResult& result, const GroundTruth& truth);

}  // namespace rakelight
