// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "stack/errors.h"

namespace rakelight {
namespace {

TableVariant make_variant(Method method, Preset preset, bool smooth) {
  TableVariant variant;
  variant.options = preset_options(preset, method);
  variant.name = to_string(method) + ", " + to_string(preset);
  variant.slug = to_string(method) + "-" + to_string(preset);
  if (!smooth) {
    variant.options.depth.smoothness = 0;
    variant.name += " (ns)";
    variant.slug += "-ns";
  }
  return variant;
}

/// Numbers the notes of a table in the order of their first appearance.
class Footnotes {
 public:
  /// e.g. "<sup>2</sup>", empty for an empty note.
  std::string mark(const std::string& note) {
    if (note.empty()) return "";
    const auto found = std::find(notes_.begin(), notes_.end(), note);
    const auto number = found - notes_.begin() + 1;
    if (found == notes_.end()) notes_.push_back(note);
    return "<sup>" + std::to_string(number) + "</sup>";
  }

  std::string text() const {
    std::string text;
    for (std::size_t k = 0; k < notes_.size(); ++k)
      text += "\n<sup>" + std::to_string(k + 1) + "</sup> " + notes_[k] + "\n";
    return text;
  }

 private:
  std::vector<std::string> notes_;
};

/// A bar would end a cell of the table.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result;
}

/// The number as the table shows it: the best of a column is judged by what the reader sees.
std::string shown(double value) {
  if (!std::isfinite(value)) return "–";
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

struct Column {
  std::size_t stack;
  double Evaluation::*measure;
};

std::vector<Column> columns_of(const MethodTable& table) {
  std::vector<Column> columns;
  for (std::size_t k = 0; k < table.stacks.size(); ++k) {
    columns.push_back({k, &Evaluation::rmse_mm});
    columns.push_back({k, &Evaluation::mae_deg});
  }
  return columns;
}

std::string best_of(const MethodTable& table, const Column& column) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t row = 1; row < table.rows.size(); ++row) {
    const TableCell& cell = table.rows[row].cells[column.stack];
    if (cell.errors && (*cell.errors).*column.measure < best) best = (*cell.errors).*column.measure;
  }
  return shown(best);
}

}  // namespace

std::vector<TableVariant> table_variants() {
  constexpr std::array kMethods{Method::rgbd_fusion, Method::fusion_like, Method::rgb_ratio,
                                Method::multi_light};
  std::vector<TableVariant> variants;
  for (const Method method : kMethods) {
    for (const Preset preset : {Preset::paper, Preset::robust}) {
      TableVariant variant = make_variant(method, preset, true);
      if (variant.options.depth.smoothness > 0) variants.push_back(make_variant(method, preset, false));
      variants.push_back(std::move(variant));
    }
  }
  return variants;
}

std::string table_markdown(const MethodTable& table) {
  std::string head = "| Method |", rule = "| --- |";
  for (const std::string& stack : table.stacks) {
    head += " " + escaped(stack) + ": RMSE mm | MAE ° |";
    rule += " ---: | ---: |";
  }
  const std::vector<Column> columns = columns_of(table);
  std::vector<std::string> best;
  for (const Column& column : columns) best.push_back(best_of(table, column));

  Footnotes footnotes;
  std::string lines = head + "\n" + rule + "\n";
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    lines += "| " + escaped(table.rows[row].name) + " |";
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const TableCell& cell = table.rows[row].cells[columns[k].stack];
      std::string text = cell.errors ? shown((*cell.errors).*columns[k].measure) : "–";
      if (row > 0 && cell.errors && text == best[k]) text = "**" + text + "**";
      const bool first_of_stack = k == 0 || columns[k - 1].stack != columns[k].stack;
      lines += " " + text + (first_of_stack ? footnotes.mark(escaped(cell.note)) : "") + " |";
    }
    lines += "\n";
  }
  return lines + footnotes.text();
}

VariantRun run_variant(const LightStack& stack, const GroundTruth& truth, const RefineOptions& options,
                       const ProgressCallback& progress) {
  VariantRun run;
  const auto cannot = [&run](const std::exception& error) { run.cell.note = error.what(); };
  try {
    run.result = refine_depth(stack, options, progress);
  } catch (const InputError& error) { cannot(error); } catch (const UsageError& error) {
    cannot(error);
  }
  if (!run.result) return run;
  run.cell.errors = evaluate(run.result->camera, run.result->depth, run.result->normals, truth);
  if (run.result->termination == Termination::diverged) run.cell.note = run.result->message;
  return run;
}

TableCell input_cell(const RefineResult& result, const GroundTruth& truth) {
  return {evaluate(result.camera, result.initial_depth, {}, truth), {}};
}

}  // namespace rakelight
