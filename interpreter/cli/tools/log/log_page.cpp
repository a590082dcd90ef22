#include <CLI/CLI.hpp>
#include <array>
#include <cerrno>
#include <memory>
#include <streambuf>
#include <string>
#include <utility>

#include "cli/exit_code.h"
#include "cli/outputs.h"
#include "cli/tools/log/log.h"
#include "cli/tools/log/reading_progress.h"
#include "system/descriptors.h"
#include "system/output_file.h"
#include "web/page.h"

namespace lockstep::host {
namespace {

struct LogPageOptions {
  std::string file;
  std::string out;
};

// Reads another stream, and gives all that it reads to someone else too.
class CopiedInput final : public std::streambuf {
 public:
  // Returns false to end the input.
  using Take = std::function<bool(std::string_view)>;

  CopiedInput(std::streambuf& in, Take take) : in_(in), take_(std::move(take)) {}

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

// Reads the recording to its end. What is wrong with it is found here, before a browser does.
int read_to_end(std::istream& in, const std::string& path) {
  return read_recording(in, path, [](RecordingReader& reader) {
    while (reader.next()) {
    }
    return report_end(reader);
  });
}

int page(const LogPageOptions& options) {
  if (would_overwrite("--out", options.out, files_of(options.file))) return kExitUsage;
  return with_file(options.file, [&](std::istream& in) {
    OutputFile out(options.out);
    if (out.descriptor() < 0) return usage_error(printable(out.error()));
    int reason = 0;
    const int code = make_page(in, options.file, [&](std::string_view part) {
      if (!write_all(out.descriptor(), part)) reason = errno;
      return reason == 0;
    });
    if (reason == 0 && code == kExitSuccess && !out.take_name()) reason = errno;
    return reason == 0 ? code : cannot_use("write", options.out, reason);
  });
}

}  // namespace

// The bytes themselves go into the page.
int make_page(std::istream& in, const std::string& path,
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
  const int code = read_to_end(recording, path);
  if (writes && code == kExitSuccess) page.finish();
  return code;
}

LogSubcommand define_log_page(CLI::App& log) {
  const auto options = std::make_shared<LogPageOptions>();
  CLI::App* app = log.add_subcommand(
      "page", "Write a web page that shows the recording, as one file that needs no server");
  add_recording_file(*app, options->file);
  app->add_option("--out", options->out, "The page, to be opened in any browser")
      ->type_name("FILE.html")
      ->required();
  return {app, [options] { return page(*options); }};
}

}  // namespace lockstep::host
