// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/table.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <set>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "refine/output/result_io.h"
#include "refine/output/table_pictures.h"
#include "stack/atomic_folder.h"
#include "stack/checked_file.h"
#include "stack/errors.h"
#include "stack/stack_io.h"

namespace rakelight::cli {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::vector<fs::path> stacks;
  fs::path output;
  std::vector<std::string> methods;
  int scale = 0, threads = 0;
  bool json = false;
};

constexpr const char* kFooter = R"(Examples:
  rakelight table vase                                   every method and preset on a simulated scan, as Markdown
  rakelight table simple pattern complicated -o out      the paper's Table II, with every surface and its pictures
  rakelight table vase --method rgb-ratio --json         one method, for scripts

ns: no Laplacian smoothness of the depth. RMSE: of depth. MAE: mean angle between the true normals and those of depth.
With -o DIR: DIR/STACK/METHOD/ is a result folder, DIR/STACK/pictures/ has relief, normals, albedo and error of each,
sheet.jpg all of them; DIR/table/ has the table as table.md and table.json.)";

const FolderKind kTableFolder{"table", "table.json", {"table.md"}};

/// `my-scan` of `scans/my-scan/`.
std::string name_of(const fs::path& stack) {
  const fs::path whole = fs::absolute(stack).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

std::vector<TableVariant> variants_of(const Arguments& arguments) {
  std::vector<TableVariant> variants = table_variants();
  const auto unwanted = [&](const TableVariant& variant) {
    const auto& wanted = arguments.methods;
    return !wanted.empty() &&
           std::find(wanted.begin(), wanted.end(), to_string(variant.options.method)) == wanted.end();
  };
  variants.erase(std::remove_if(variants.begin(), variants.end(), unwanted), variants.end());
  for (TableVariant& variant : variants) {
    variant.options.scale = arguments.scale;
    variant.options.threads = arguments.threads;
  }
  return variants;
}

void check_names(const Arguments& arguments) {
  std::set<std::string> names;
  for (const fs::path& stack : arguments.stacks) {
    const std::string name = name_of(stack);
    if (!names.insert(name).second) {
      throw UsageError("two stacks are called " + name +
                       "; rename one: columns and folders have these names");
    }
    if (name == "table" && !arguments.output.empty()) {
      throw UsageError("a stack is called table, as is the table's own folder in -o; rename it");
    }
  }
}

/// Fails before the long work does.
void check_folders(const Arguments& arguments, const std::vector<TableVariant>& variants) {
  if (arguments.output.empty()) return;
  const AtomicFolder locked_for_a_moment(arguments.output / "table", kTableFolder);
  for (const fs::path& stack : arguments.stacks) {
    const fs::path folder = arguments.output / name_of(stack);
    check_pictures_folder(folder / "pictures");
    for (const TableVariant& variant : variants) check_result_folder(folder / variant.slug);
  }
}

/// What the whole table has done, as one bar.
class TableProgress {
 public:
  TableProgress(std::size_t stacks, std::size_t variants) : total_(static_cast<double>(stacks * variants)) {}

  void next(const std::string& stack, const std::string& variant) {
    name_ = stack + ": " + variant;
    done_ += running_ ? 1 : 0;
    running_ = true;
  }
  bool show(const Progress& progress) {
    bar_.show({name_, (done_ + progress.fraction_done) / total_});
    return !interrupted();
  }

 private:
  ProgressBar bar_;
  double total_, done_ = 0;
  bool running_ = false;
  std::string name_;
};

/// Adds a column to the table: every variant on one stack.
void add_stack(const fs::path& folder, const Arguments& arguments, const std::vector<TableVariant>& variants,
               TableProgress& progress, MethodTable& table) {
  const LightStack stack = read_stack(folder);
  const GroundTruth truth = read_truth(folder);
  const std::string name = name_of(folder);
  table.stacks.push_back(name);
  std::vector<PictureRow> pictures;
  table.rows.front().cells.emplace_back();
  for (std::size_t k = 0; k < variants.size(); ++k) {
    progress.next(name, variants[k].name);
    const auto show = [&progress](const Progress& p) { return progress.show(p); };
    const VariantRun run = run_variant(stack, truth, variants[k].options, show);
    table.rows[k + 1].cells.push_back(run.cell);
    if (!run.result) continue;
    table.rows.front().cells.back() = input_cell(*run.result, truth);
    if (arguments.output.empty()) continue;
    write_result(*run.result, arguments.output / name / variants[k].slug, &stack);
    if (pictures.empty()) pictures.push_back(input_row(stack, *run.result));
    pictures.push_back(result_row(variants[k], *run.result));
  }
  if (pictures.empty()) return;
  pictures.push_back(truth_row(truth));
  write_table_pictures(pictures, truth, arguments.output / name / "pictures");
}

void write_table(const MethodTable& table, const fs::path& folder) {
  AtomicFolder out(folder / "table", kTableFolder);
  write_file(out.path() / "table.md", table_markdown(table));
  write_file(out.path() / "table.json", table_json(table));
  out.commit();
}

void run(const Arguments& arguments) {
  catch_interrupts();
  check_names(arguments);
  const std::vector<TableVariant> variants = variants_of(arguments);
  for (const fs::path& stack :
       arguments.stacks) {  // a fault in the last one should not cost the first one's time
    read_stack(stack);
    read_truth(stack);
  }
  check_folders(arguments, variants);
  MethodTable table;
  table.rows.push_back({"input", {}});
  for (const TableVariant& variant : variants) table.rows.push_back({variant.name, {}});
  try {
    TableProgress progress(arguments.stacks.size(), variants.size());
    for (const fs::path& stack : arguments.stacks) add_stack(stack, arguments, variants, progress, table);
  } catch (const Cancelled&) {
    if (arguments.output.empty()) throw;
    throw Cancelled("the surfaces finished so far are in " + arguments.output.string() +
                    ", the table is not");
  }
  if (!arguments.output.empty()) write_table(table, arguments.output);
  std::cout << (arguments.json ? table_json(table) : table_markdown(table));
}

}  // namespace

void add_table_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      program.add_subcommand("table", "Run every method on stacks with truth: the paper's Table II");
  command->footer(kFooter);
  command->add_option("STACK", arguments->stacks, "Stack folders with truth/, a column each")->required();
  command
      ->add_option("-o,--output", arguments->output, "Keep every surface, and pictures of it, in this folder")
      ->type_name("DIR");
  command->add_option("--method", arguments->methods, "Only this method; may be given several times")
      ->check(CLI::IsMember({"multi-light", "rgb-ratio", "fusion-like", "rgbd-fusion"}))
      ->allow_extra_args(false);
  command
      ->add_option("--scale", arguments->scale,
                   "Refined grid / depth grid; default: as fine as the colour images")
      ->check(CLI::Range(1, 4));
  command->add_option("--threads", arguments->threads, "Threads; 0 (default): all; the result is the same")
      ->check(CLI::Range(0, 1024));
  command->add_flag("--json", arguments->json, "Print one JSON object on stdout and nothing else there");
  command->callback([arguments, &exit_code] {
    run(*arguments);
    exit_code = 0;
  });
}

}  // namespace rakelight::cli
