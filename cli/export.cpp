// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "capture/oni_file.h"
#include "cli/commands.h"
#include "stack/stack_io.h"

namespace rakelight::cli {
namespace {

struct Arguments {
  std::string kind;
  std::filesystem::path stack, output;
};

constexpr const char* kFooter = R"(Kinds:
  oni    an OpenNI2 recording of the frames that have colour and depth

Lost in an .oni file: lamps and which lit which frame, mask, principal point, distortion, T_color_depth, colour response,
exposure, the low byte of 16-bit colour, depth finer than 0.1 mm, frame numbers, host times.

Examples:
  rakelight export oni my-scan -o my-scan.oni
  rakelight import oni my-scan.oni -o again --lights dark,white-00,white-01,dark)";

}  // namespace

void add_export_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand("export", "Write a stack as a file for other tools");
  command->footer(kFooter);
  command->add_option("KIND", arguments->kind, "Format of the file")
      ->required()
      ->check(CLI::IsMember({"oni"}));
  command->add_option("STACK", arguments->stack, "Stack folder")->required();
  command->add_option("-o,--output", arguments->output, "File to write; an older one is replaced")
      ->required()
      ->type_name("FILE");
  command->callback([arguments, &exit_code] {
    export_oni(read_stack(arguments->stack), arguments->output);
    std::cout << arguments->output.string() << "\n";
    exit_code = 0;
  });
}

}  // namespace rakelight::cli
