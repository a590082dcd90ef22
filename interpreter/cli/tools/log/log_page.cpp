#include <CLI/CLI.hpp>
#include <cerrno>
#include <memory>
#include <sstream>
#include <string>
#include <utility>

#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/outputs.h"
#include "cli/tools/log/log.h"
#include "system/descriptors.h"
#include "system/output_file.h"
#include "web/page.h"

namespace lockstep::host {
namespace {

struct LogPageOptions {
  std::string file;
  std::string out;
};

int write_page(const std::string& path, std::string_view page) {
  OutputFile out(path);
  if (out.descriptor() < 0) return usage_error(printable(out.error()));
  const bool written = write_all(out.descriptor(), page) && out.take_name();
  return written ? kExitSuccess : cannot_use("write", path, errno);
}

int page(const LogPageOptions& options) {
  const NamedFile recording[] = {named_file(options.file)};
  if (would_overwrite("--out", options.out, recording)) return kExitUsage;
  return with_page(options.file,
                   [&](const std::string& page) { return write_page(options.out, page); });
}

}  // namespace

// The bytes themselves go into the page. What is wrong with them is found before a browser does.
int with_page(const std::string& path, const std::function<int(std::string page)>& use) {
  return with_file(path, [&](std::istream& in) {
    std::ostringstream all;
    all << in.rdbuf();
    std::istringstream recording(std::move(all).str());
    return read_recording(recording, path, [&](RecordingReader& reader) {
      while (reader.next()) {
      }
      if (const int code = report_end(reader); code != kExitSuccess) return code;
      return use(page_with_recording(recording.view()));
    });
  });
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
