// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "stack/check.h"
#include "stack/errors.h"
#include "stack/stack_io.h"
#include "stack/truth_io.h"

namespace rakelight::cli {
namespace {

struct Arguments {
  std::filesystem::path stack;
  bool json = false;
};

constexpr const char* kFooter = R"(Examples:
  rakelight verify my-scan           every file read and checked; exit 0: whole, 3: not
  rakelight verify my-scan --json    {"stack": ..., "whole": true} or {..., "whole": false, "fault": ...}

Checked: the manifest; checksums and end of every image; sizes against the cameras; that there is a mask, depth and
light on the object; the truth if there is one.)";

/// @return the number of images read  @throws InputError at the first fault.
int verify(const std::filesystem::path& folder) {
  const LightStack stack = read_stack(folder);
  check_stack(stack);
  int images = stack.mask.empty() ? 0 : 1;
  for (const Frame& frame : stack.frames)
    images += (frame.color.empty() ? 0 : 1) + (frame.depth.empty() ? 0 : 1);
  if (has_truth(folder)) images += read_truth(folder).albedo.empty() ? 2 : 3;
  return images;
}

void print_json(const std::filesystem::path& stack, const char* fault) {
  nlohmann::ordered_json report = {{"stack", stack.string()}, {"whole", fault == nullptr}};
  if (fault != nullptr) report["fault"] = fault;
  std::cout << report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << "\n";
}

void run(const Arguments& arguments) {
  try {
    const int images = verify(arguments.stack);
    if (arguments.json) {
      print_json(arguments.stack, nullptr);
    } else {
      std::cout << arguments.stack.string() << ": whole; " << images << " images read and checked\n";
    }
  } catch (const InputError& error) {
    if (arguments.json) print_json(arguments.stack, error.what());
    throw;
  }
}

}  // namespace

void add_verify_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand("verify", "Check that a stack is whole and can be worked with");
  command->footer(kFooter);
  command->add_option("STACK", arguments->stack, "Stack or source folder")->required();
  command->add_flag("--json", arguments->json, "Print one JSON object on stdout and nothing else there");
  command->callback([arguments, &exit_code] {
    run(*arguments);
    exit_code = 0;
  });
}

}  // namespace rakelight::cli
