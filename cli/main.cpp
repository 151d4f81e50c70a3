// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program: arguments to commands, typed errors to one line and an exit code.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <limits>
#include <new>
#include <opencv2/core/utils/logger.hpp>
#include <system_error>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "cli/commands.h"
#include "stack/errors.h"

namespace rakelight::cli {
namespace {

constexpr int kFailure = 1, kUsage = 2, kInput = 3, kDevice = 4, kBusy = 5, kIo = 6, kCancelled = 130;

constexpr const char* kOverview =
    "Refines the depth of an RGB-D camera by photometric stereo: images of one object under several lamps "
    "in,\n"
    "a high-quality surface out.";

constexpr const char* kFooter = R"(Examples:
  rakelight refine my-scan -o my-surface      refine a recorded stack
  rakelight info my-scan                      what it holds
  rakelight refine --help                     every option of a command

Exit codes:
  0 done   2 usage   3 bad input data   4 device or permission   5 busy (another writer)   6 disk or I/O
  7 solved but did not converge (the result is written and says so)   130 interrupted   1 anything else)";

/// Errors of libraries may span lines; ours are one.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

int report(int code, const CLI::App& program, const std::string& message) {
  const auto commands = program.get_subcommands();
  const std::string command = commands.empty() ? "" : commands.front()->get_name() + ": ";
  spdlog::error("{}{}", command, one_line(message));
  return code;
}

int report_usage(const CLI::App& program, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return program.exit(error);  // --help, --version
  const auto commands = program.get_subcommands();
  const std::string command = commands.empty() ? "" : " " + commands.front()->get_name();
  return report(kUsage, program, std::string(error.what()) + "; see rakelight" + command + " --help");
}

/// Arrays of the size of a scan come and go with every iteration: glibc would take each from the kernel anew, and clearing
/// fresh pages costs as much as the work on them.
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

/// A system that is out of memory or threads is no device fault.
bool out_of_resources(const std::error_code& code) {
  return code == std::errc::resource_unavailable_try_again || code == std::errc::not_enough_memory;
}

int parse_and_run(CLI::App& program, int argc, char** argv) {
  try {
    program.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    return report_usage(program, error);
  } catch (const UsageError& error) {
    return report(kUsage, program, error.what());
  } catch (const InputError& error) {
    return report(kInput, program, error.what());
  } catch (const BusyError& error) {
    return report(kBusy, program, error.what());
  } catch (const IoError& error) {
    return report(kIo, program, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return report(kIo, program, error.what());
  } catch (const DeviceError& error) {
    return report(kDevice, program, error.what());
  } catch (const Cancelled& cancelled) {
    return report(kCancelled, program, cancelled.what());
  } catch (const std::system_error& error) {
    return report(out_of_resources(error.code()) ? kFailure : kDevice, program, error.what());
  } catch (const std::bad_alloc&) {
    return report(kFailure, program, "out of memory; close other programs or use a smaller --scale");
  } catch (const std::exception& error) { return report(kFailure, program, error.what()); }
}

/// What was printed must have arrived. A reader that left early (a closed pipe) is its own business.
int flush_stdout(int exit_code) {
  errno = 0;
  if (std::cout.flush()) return exit_code;
  if (errno == EPIPE) return exit_code;
  spdlog::error("cannot write to the standard output; is the disk full?");
  return exit_code == 0 ? kIo : exit_code;
}

void set_up_logging() {
  auto logger = spdlog::stderr_color_mt("rakelight");
  logger->set_pattern("%n: %^%l%$: %v");
  spdlog::set_default_logger(logger);
  // Our own line says what was wrong with a file; OpenCV's lines before it would only be noise.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

int run(int argc, char** argv) {
  keep_freed_memory();
  set_up_logging();
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is an error code of write(), not a death
  int exit_code = 0;
  CLI::App program(kOverview, "rakelight");
  program.set_version_flag("--version", "rakelight " RAKELIGHT_VERSION);
  program.footer(kFooter);
  program.require_subcommand(1);
  add_refine_command(program, exit_code);
  add_evaluate_command(program, exit_code);
  add_table_command(program, exit_code);
#ifdef RAKELIGHT_HAS_SIMULATE
  add_simulate_command(program, exit_code);
#endif
#ifdef RAKELIGHT_HAS_CAPTURE
  add_calibrate_command(program, exit_code);
  add_export_command(program, exit_code);
  add_lights_command(program, exit_code);
  add_doctor_command(program, exit_code);
  add_scan_command(program, exit_code);
#endif
  add_import_command(program, exit_code);
  add_info_command(program, exit_code);
  add_verify_command(program, exit_code);
#ifdef RAKELIGHT_HAS_VIEWER
  add_view_command(program, exit_code);
#endif
  const int failure = parse_and_run(program, argc, argv);
  return flush_stdout(failure != 0 ? failure : exit_code);
}

}  // namespace
}  // namespace rakelight::cli

int main(int argc, char** argv) { return rakelight::cli::run(argc, argv); }
