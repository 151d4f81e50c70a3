// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the calibrations have in common: each adds a subcommand of `calibrate`, measures, reports, and stores into the
// rig file if one is given.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "capture/rig.h"

namespace rakelight::cli {

struct CalibrateTarget {
  std::filesystem::path rig;  ///< empty: nothing is stored
  bool json = false;
};

/// Adds --rig and --json.
std::shared_ptr<CalibrateTarget> add_target(CLI::App& command);

/// Stores into the rig file if there is one: `change` gets the rig as the file says it.
void store(const CalibrateTarget& target, const std::function<void(Rig&)>& change);

/// Prints the text for people, or the object, and where it was stored.
void print_result(const CalibrateTarget& target, const std::string& text, nlohmann::ordered_json result);

void add_calibrate_board(CLI::App& calibrate, int& exit_code);
void add_calibrate_camera(CLI::App& calibrate, int& exit_code);
void add_calibrate_response(CLI::App& calibrate, int& exit_code);
void add_calibrate_crosstalk(CLI::App& calibrate, int& exit_code);
void add_calibrate_latency(CLI::App& calibrate, int& exit_code);
void add_calibrate_lamps(CLI::App& calibrate, int& exit_code);

}  // namespace rakelight::cli
