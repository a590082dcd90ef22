#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <optional>
#include <streambuf>
#include <string>
#include <utility>

#include "base/system/descriptors.h"
#include "base/system/output_file.h"
#include "cli/exit_code.h"
#include "cli/outputs.h"
#include "cli/tools/log/log.h"
#include "cli/tools/log/reading_progress.h"
#include "record/read/recording_parts.h"
#include "show/web/page.h"

namespace lockstep::host {
namespace {

struct LogPageOptions {
  std::string file;
  std::string out;
  TickRange range;
};

// Reads another stream, and gives all that it reads to someone else too.
class CopiedInput final : public TextOfFiles {
 public:
  // Returns false to end the input.
  using Take = std::function<bool(std::string_view)>;

  CopiedInput(std::streambuf& in, Take take) : in_(in), take_(std::move(take)) {}

  std::optional<Place> place_of(std::uint64_t byte) override {
    auto* const files = dynamic_cast<TextOfFiles*>(&in_);
    return files != nullptr ? files->place_of(byte) : std::nullopt;
  }

 private:
  int_type underflow() override {
    const auto count = in_.sgetn(part_.data(), static_cast<std::streamsize>(part_.size()));
    if (count == 0 || !take_({part_.data(), static_cast<std::size_t>(count)})) {
      return traits_type::eof();
    }
    setg(part_.data(), part_.data(), part_.data() + count);
    return traits_type::to_int_type(part_.front());
  }

  std::streambuf& in_;
  const Take take_;
  std::array<char, 1u << 16u> part_;
};

// Bytes of a text.
struct Piece {
  std::uint64_t from = 0, to = 0;
};

bool write_piece(std::istream& in, Piece piece,
                 const std::function<bool(std::string_view)>& write) {
  std::array<char, 1u << 16u> part;
  in.clear();
  in.seekg(static_cast<std::streamoff>(piece.from));
  for (std::uint64_t left = piece.to - piece.from; left > 0;) {
    const auto count = in.rdbuf()->sgetn(
        part.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(left, part.size())));
    if (count <= 0 || !write({part.data(), static_cast<std::size_t>(count)})) return false;
    left -= static_cast<std::uint64_t>(count);
  }
  return true;
}

// Its header, and the lines from the last whole state before the range on.
int make_page_of(std::istream& in, const std::string& path, TickRange range,
                 const std::function<bool(std::string_view part)>& write) {
  return read_recording(in, path, [&](RecordingReader& reader) {
    const Piece header{0, reader.position().lines.bytes};
    if (range.from > 0) reader.skip_to(range.from);
    Piece ticks{reader.position().lines.bytes, reader.position().lines.bytes};
    bool has_more = false;
    while (const auto tick = reader.next()) {
      has_more = tick->tick > range.to;
      if (has_more) break;
      ticks.to = reader.position().lines.bytes;
    }
    if (!has_more) ticks.to = reader.position().lines.bytes;
    const int code = report_end(reader, range);
    if (code != kExitSuccess) return code;
    const auto asked = [](bool is_bound, std::uint64_t tick) {
      return is_bound ? std::optional(tick) : std::nullopt;
    };
    RecordingPage page(write, asked(range.from > 0, range.from), asked(has_more, range.to));
    const auto add = [&page](std::string_view bytes) {
      page.add(bytes);
      return true;
    };
    if (write_piece(in, header, add) && write_piece(in, ticks, add)) page.finish();
    return code;
  });
}

// The bytes themselves go into the page.
int make_whole_page(std::istream& in, const std::string& path,
                    const std::function<bool(std::string_view part)>& write) {
  bool writes = true;
  RecordingPage page([&](std::string_view part) { writes = writes && write(part); });
  ReadingProgress progress(path);
  CopiedInput input(*in.rdbuf(), [&](std::string_view bytes) {
    page.add(bytes);
    progress.add(bytes.size());
    return writes;
  });
  std::istream recording(&input);
  // To its end: what is wrong with it is found here, before a browser does.
  RecordingReader reader(recording, path == "-" ? "stdin" : path);
  while (reader.next()) {
  }
  if (!writes) return kExitSuccess;  // that its end is not read is no fault of the recording
  const int code = report_end(reader);
  if (code == kExitSuccess) page.finish();
  return code;
}

int page(const LogPageOptions& options) {
  if (options.file == "-" && !options.range.is_all()) {
    return usage_error("--from and --to need a recording in a file");
  }
  if (would_overwrite("--out", options.out, files_of(options.file))) return kExitUsage;
  return with_file(options.file, [&](std::istream& in) {
    OutputFile out(options.out);
    if (out.descriptor() < 0) return usage_error(printable(out.error()));
    int reason = 0;
    const auto write = [&](std::string_view part) {
      if (!write_all(out.descriptor(), part)) reason = errno;
      return reason == 0;
    };
    const int code = make_page(in, options.file, options.range, write);
    if (reason == 0 && code == kExitSuccess && !out.take_name()) reason = errno;
    return reason == 0 ? code : cannot_use("write", options.out, reason);
  });
}

}  // namespace

int make_page(std::istream& in, const std::string& path, TickRange range,
              const std::function<bool(std::string_view part)>& write) {
  return range.is_all() ? make_whole_page(in, path, write) : make_page_of(in, path, range, write);
}

LogSubcommand define_log_page(CLI::App& log) {
  const auto options = std::make_shared<LogPageOptions>();
  CLI::App* app = log.add_subcommand(
      "page", "Write a web page that shows the recording, as one file that needs no server");
  add_recording_file(*app, options->file);
  app->add_option("--out", options->out, "The page, for any browser")
      ->type_name("FILE.html")
      ->required();
  add_tick_range(*app, options->range);
  return {app, [options] { return page(*options); }};
}

}  // namespace lockstep::host
