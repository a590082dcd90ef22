#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <vector>

#include "cli/console.h"
#include "cli/tools/log/log.h"
#include "judge/measure/measure_spec.h"
#include "record/use/recording_measures.h"

namespace lockstep::host {
namespace {

struct LogMeasureOptions {
  std::string file;
  std::vector<std::string> measures = {"progress-distance", "step-length", "duration"};
  bool json = false;
};

int print_measures(const LogMeasureOptions& options, std::span<const MeasureSpec> measures,
                   RecordingReader& reader) {
  const auto values = measure_recording(reader, measures);
  if (!values) return usage_error(printable(values.error().message));
  if (!reader.error().empty()) return report_end(reader);
  if (const std::uint64_t first = reader.header().first_tick; first > 0) {
    print_note(
        fmt::format("the recording begins with tick {}: a measure is of the ticks from there on, "
                    "without a value if it counts from the first tick of the run; ticks, "
                    "duration and success are of the run",
                    first));
  }
  const std::string text =
      options.json ? to_json(*values) + "\n" : to_table(*values, results_width());
  return write_results_of(reader, text);
}

int measure(const LogMeasureOptions& options) {
  std::vector<MeasureSpec> measures;
  for (const std::string& text : options.measures) {
    const auto spec = parse_measure(text);
    if (!spec) {
      return usage_error(fmt::format("--measure {}: {}", printable(text), spec.error().message));
    }
    measures.push_back(*spec);
  }
  return with_recording(options.file, [&](RecordingReader& reader) {
    return print_measures(options, measures, reader);
  });
}

}  // namespace

LogSubcommand define_log_measure(CLI::App& log) {
  const auto options = std::make_shared<LogMeasureOptions>();
  CLI::App* app =
      log.add_subcommand("measure", "Print measures of the run, with the names that a study uses");
  add_recording_file(*app, options->file);
  app->add_option(
         "--measure", options->measures,
         measure_usages() + "; may be repeated. Default: progress-distance, step-length, duration")
      ->type_name("NAME")
      ->allow_extra_args(false);
  app->add_flag("--json", options->json, "Print one line of JSON");
  return {app, [options] { return measure(*options); }};
}

}  // namespace lockstep::host
