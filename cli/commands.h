// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One function a subcommand: it adds its options to the program and sets what runs. A command returns normally with
// its exit code in `exit_code`, or throws a typed error (stack/errors.h) that main() turns into a line and a code.
#pragma once

#include <CLI/CLI.hpp>

namespace rakelight::cli {

void add_refine_command(CLI::App& program, int& exit_code);
void add_simulate_command(CLI::App& program, int& exit_code);
void add_import_command(CLI::App& program, int& exit_code);
void add_export_command(CLI::App& program, int& exit_code);
void add_info_command(CLI::App& program, int& exit_code);
void add_verify_command(CLI::App& program, int& exit_code);
void add_evaluate_command(CLI::App& program, int& exit_code);
void add_calibrate_command(CLI::App& program, int& exit_code);
void add_lights_command(CLI::App& program, int& exit_code);
void add_doctor_command(CLI::App& program, int& exit_code);
void add_scan_command(CLI::App& program, int& exit_code);
void add_table_command(CLI::App& program, int& exit_code);

}  // namespace rakelight::cli
