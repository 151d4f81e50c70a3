// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "refine/table.h"

namespace rakelight {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const std::string& stack, const TableCell& cell) {
  Json json = {{"stack", stack}};
  if (cell.errors) {
    json["rmse_mm"] = cell.errors->rmse_mm;
    json["mae_deg"] = cell.errors->mae_deg;
    json["median_deg"] = cell.errors->median_deg;
    json["rmse_unbiased_mm"] = cell.errors->rmse_unbiased_mm;
    json["complete"] = cell.errors->completeness;
  }
  if (!cell.note.empty()) json["note"] = cell.note;
  return json;
}

}  // namespace

std::string table_json(const MethodTable& table) {
  Json rows = Json::array();
  for (const TableRow& row : table.rows) {
    Json cells = Json::array();
    for (std::size_t k = 0; k < row.cells.size(); ++k)
      cells.push_back(json_of(table.stacks[k], row.cells[k]));
    rows.push_back({{"name", row.name}, {"cells", cells}});
  }
  const Json json = {{"stacks", table.stacks}, {"rows", rows}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rakelight
