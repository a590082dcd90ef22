#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>

#include "base/compression/decompressed.h"
#include "base/json/reader.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/tools/log/log.h"
#include "record/header_line.h"
#include "record/lines.h"
#include "record/read/recording_json.h"
#include "run/stop_signals.h"

namespace lockstep::host {
namespace {

struct LogCatOptions {
  std::string file;
  bool follows = false;
};

struct Ending {
  bool follows = false;
  bool is_there = false;    // of the run
  bool is_of_part = false;  // the last line says that the run goes on in another part
};

bool is_header(std::string_view line) {
  return line.starts_with(kHeaderBegin);
}

bool is_json(std::string& line) {
  try {
    JsonReader().read(line, [](JsonObject object) { object.read({}); });
    return true;
  } catch (const JsonError&) {
    return false;
  }
}

// Reports that the run was cut, if this is the header of the process that continues it.
void tell_resumed(std::string& header) {
  std::optional<double> after;
  std::uint64_t first = 0;
  try {
    JsonReader().read(header, [&](JsonObject object) {
      object.read({{lines::kHeader["first_tick"], into(first), kMayLack},
                   {lines::kHeader["resumed_after_s"],
                    [&](JsonValue value) { after = value.number(); }, kMayLack}});
    });
  } catch (const JsonError&) {
    return;
  }
  if (!after) return;
  print_note(
      fmt::format("the run was cut, and continues from tick {} on, {:.1f} s later", first, *after));
}

// Whole lines, as long as there are any. The first part of a line waits in `rest` for its end.
int print_lines(std::istream& in, std::string& rest, Ending& ending) {
  std::string line, lines;
  int written = kExitSuccess;
  while (written == kExitSuccess && std::getline(in, line)) {
    const bool is_in_pieces = !rest.empty();
    rest += line;
    if (in.eof()) break;
    if (is_in_pieces && !is_json(rest)) {  // a cut left it
      rest.clear();
      continue;
    }
    if (ending.follows && is_header(rest)) tell_resumed(rest);
    ending.is_there = ending.is_there || RecordingJson::is_end(rest);
    ending.is_of_part = RecordingJson::is_part_end(rest);
    (lines += rest) += '\n';
    rest.clear();
    constexpr std::size_t kFull = 1u << 16u;
    if (lines.size() < kFull) continue;
    written = write_results(lines);
    lines.clear();
  }
  return written == kExitSuccess ? write_results(lines) : written;
}

// Prints the header. False: it is none, or cut.
bool begin(std::istream& in, int& written) {
  std::string header;
  std::getline(in, header);
  if (in.eof() || !is_header(header)) return false;
  written = write_results(header += '\n');
  return true;
}

int follow(std::istream& in, const LogCatOptions& options) {
  constexpr std::chrono::milliseconds kLook{50};
  if (options.follows) StopSignals::install();
  std::string rest;
  Ending ending{.follows = options.follows};
  int written = kExitSuccess;
  if (!begin(in, written)) {
    print_error(printable(options.file + ":1: no header of a recording"));
    return kExitInvalidTree;
  }
  if (written != kExitSuccess) return written;
  while (true) {
    if (const int code = print_lines(in, rest, ending); code != kExitSuccess) return code;
    // Where all parts are read, the next one comes.
    std::error_code none;
    const bool is_one = ending.is_of_part && std::filesystem::exists(options.file, none);
    if (!options.follows || ending.is_there || is_one) break;
    if (StopSignals::received() != 0) return kExitSignal + StopSignals::received();
    std::this_thread::sleep_for(kLook);
    in.clear();
  }
  if (!ending.is_there && !ending.is_of_part)
    print_error("the recording is cut: it ends without a closing line");
  return kExitSuccess;
}

int cat(const LogCatOptions& options) {
  using Reading = NamedRecording::Reading;
  const auto print = [&](std::istream& in) {
    try {
      in.exceptions(std::ios_base::badbit);
      return follow(in, options);
    } catch (const CannotDecompress& damage) {
      print_error(printable(options.file + ": " + damage.what()));
      return int{kExitInvalidTree};
    }
  };
  return with_file(options.file, print, options.follows ? Reading::Follows : Reading::Once);
}

}  // namespace

LogSubcommand define_log_cat(CLI::App& log) {
  const auto options = std::make_shared<LogCatOptions>();
  CLI::App* app = log.add_subcommand(
      "cat", "Print the lines of the recording as they are, also of a compressed one");
  add_recording_file(*app, options->file);
  app->add_flag("--follow,-f", options->follows,
                "Also print the lines that are written from now on, until the run ends");
  return {app, [options] { return cat(*options); }};
}

}  // namespace lockstep::host
