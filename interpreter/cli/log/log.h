// What the subcommands of `lockstep log` share: a recording is opened, read to its end and its end
// told in one way. One file for each of the larger subcommands.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "recording/read/recording_reader.h"

namespace CLI {
class App;
}

namespace lockstep {

// Adds the argument that names the recording.
void add_recording_file(CLI::App& app, std::string& file);

// Opens the recording, "-" being stdin, and returns what `use` does, or the exit code for a file
// that is none.
int with_recording(const std::string& path, const std::function<int(RecordingReader&)>& use);
// Says what was wrong with the recording, or that it is cut. Returns the exit code.
int report_end(const RecordingOutcome& outcome);
int report_end(const RecordingReader& reader);
// Reports what the user got wrong. Returns the exit code.
int usage_error(const std::string& message);
// Says that `path` cannot be read or written. Returns the exit code.
int cannot_use(std::string_view verb, std::string_view path, int reason);
// Writes `text` to stdout and then says how the recording ended. Returns the exit code.
int write_results_of(const RecordingReader& reader, std::string_view text);

struct LogSubcommand {
  CLI::App* app;
  std::function<int()> run;
};
LogSubcommand define_log_measure(CLI::App& log);
LogSubcommand define_log_plot(CLI::App& log);
LogSubcommand define_log_diff(CLI::App& log);

}  // namespace lockstep
