// Shared by the subcommands of `lockstep log`: they open a recording, read it to its end and report
// its end in the same way. Each of the larger subcommands has a file.
#pragma once

#include <functional>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "cli/outputs.h"
#include "record/read/recording_parts.h"
#include "record/read/recording_reader.h"
#include "record/tick_range.h"

namespace CLI {
class App;
}

namespace lockstep::host {

// Adds the argument that names the recording.
void add_recording_file(CLI::App& app, std::string& file);

// Adds --from and --to.
void add_tick_range(CLI::App& app, TickRange& range);
// Opens the recording ("-" is stdin) and returns the result of `use`, or the exit code for a file
// that is not a recording.
int with_recording(const std::string& path, const std::function<int(RecordingReader&)>& use);
// The recording and its parts, which must not be overwritten.
std::vector<NamedFile> files_of(const std::string& path);
// The two steps of it.
int with_file(const std::string& path, const std::function<int(std::istream&)>& use,
              NamedRecording::Reading reading = NamedRecording::Reading::Once);
int read_recording(std::istream& in, const std::string& path,
                   const std::function<int(RecordingReader&)>& use);
// Reads the recording, or a range of it, and meanwhile gives `write` the parts of the web page that
// shows it. There is no whole page if the recording is damaged, or if `write` returns false.
// Returns the exit code.
int make_page(std::istream& in, const std::string& path, TickRange range,
              const std::function<bool(std::string_view part)>& write);
// Reports an error in the recording, or that it is cut. Returns the exit code.
int report_end(const RecordingOutcome& outcome);
int report_end(const RecordingReader& reader);
// The same for a part of it. A range that begins behind the last tick is a mistake.
int report_end(const RecordingReader& reader, TickRange range);
// Reports a mistake of the user. Returns the exit code.
int usage_error(const std::string& message);
// Reports that `path` cannot be read or written. Returns the exit code.
int cannot_use(std::string_view verb, std::string_view path, int reason);
// Writes `text` to stdout and then reports how the recording ended. Returns the exit code.
int write_results_of(const RecordingReader& reader, std::string_view text);

struct LogSubcommand {
  CLI::App* app;
  std::function<int()> run;
};
LogSubcommand define_log_cat(CLI::App& log);
LogSubcommand define_log_events(CLI::App& log);
LogSubcommand define_log_export(CLI::App& log);
LogSubcommand define_log_measure(CLI::App& log);
LogSubcommand define_log_plot(CLI::App& log);
LogSubcommand define_log_diff(CLI::App& log);
LogSubcommand define_log_page(CLI::App& log);
LogSubcommand define_log_check(CLI::App& log);
LogSubcommand define_log_scenario(CLI::App& log);
LogSubcommand define_log_why(CLI::App& log);
LogSubcommand define_log_merge(CLI::App& log);

}  // namespace lockstep::host
