#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "cli/checks.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/tools/log/log.h"
#include "record/use/recording_diff.h"

namespace lockstep::host {
namespace {

struct LogDiffOptions {
  std::string a, b;
  DiffOptions diff;
  bool json = false;
};

// Both messages, and the worse of the two exit codes.
int report_ends(const RecordingReader& a, const RecordingReader& b) {
  const int code_a = report_end(a), code_b = report_end(b);
  return std::max(code_a, code_b);
}

// True if the runs differ in their times, as two runs on the wall clock always do.
bool differs_in_real_time(const RecordingDiff& diff, const RecordingReader& a,
                          const RecordingReader& b) {
  if (a.header().clock == "virtual" && b.header().clock == "virtual") return false;
  if (diff.tick) return diff.tick->time_a != diff.tick->time_b;
  return std::ranges::any_of(diff.end, [](const auto& it) { return it.what == "time_s"; });
}

int diff(const LogDiffOptions& options, RecordingReader& a, RecordingReader& b) {
  const RecordingDiff diff = compare(a, b, options.diff);
  const std::string text = options.json
                               ? to_json(diff) + "\n"
                               : to_text(diff, options.a, options.b, wants_color(results_file()));
  const int written = write_results(text);
  if (differs_in_real_time(diff, a, b)) {
    print_note("on the wall clock no two runs have the same times",
               "--ignore-time shows the first tick that differs in something else");
  }
  const int read = report_ends(a, b);
  const int result = diff.same() ? kExitSuccess : kExitFailure;
  return first_failure(read, first_failure(result, written));
}

int diff(const LogDiffOptions& options) {
  if (options.a == "-" && options.b == "-") {
    print_error("only one of the two recordings can be stdin");
    return kExitUsage;
  }
  return with_recording(options.a, [&](RecordingReader& a) {
    return with_recording(options.b, [&](RecordingReader& b) { return diff(options, a, b); });
  });
}

}  // namespace

LogSubcommand define_log_diff(CLI::App& log) {
  const auto options = std::make_shared<LogDiffOptions>();
  CLI::App* app = log.add_subcommand("diff", "The first tick in which two recordings differ");
  app->add_option("a", options->a, "A recording; - is stdin")->type_name("A.jsonl")->required();
  app->add_option("b", options->b, "Another one")->type_name("B.jsonl")->required();
  app->add_option("--tolerance", options->diff.tolerance,
                  "Treat progress values that differ by at most this as equal")
      ->type_name("X")
      ->check(number_between(0, 1))
      ->capture_default_str();
  app->add_flag(
      "--ignore-time", options->diff.ignore_time,
      "Do not compare times and overruns, which differ between all runs on the wall clock");
  app->add_flag("--json", options->json, "Print one line of JSON");
  app->footer(
      "Compares the headers, the ticks up to the first that differs, the lengths and the ends,\n"
      "but not the name of the tree file. Different versions of lockstep are only noted. Nodes\n"
      "are compared by path.\n"
      "Exit code: 0 the same, 1 they differ, 2 usage or a file that cannot be read, 3 not a\n"
      "recording or a damaged one.\n"
      "\n"
      "Examples:\n"
      "  lockstep log diff a.jsonl b.jsonl\n"
      "  lockstep log diff a.jsonl b.jsonl --tolerance 1e-9 --ignore-time");
  return {app, [options] { return diff(*options); }};
}

}  // namespace lockstep::host
