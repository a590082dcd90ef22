#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <ctime>
#include <filesystem>

#include "base/core/diagnostics.h"
#include "base/core/value.h"
#include "base/system/output_file.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/tools/manual/pages.h"

namespace lockstep::host {
namespace {

// The date of the release that is built, if SOURCE_DATE_EPOCH says it, so that two builds are the
// same.
std::string date_of_pages() {
  std::time_t seconds = std::time(nullptr);
  if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH"))
    seconds = static_cast<std::time_t>(parse_double(epoch).value_or(0));
  std::tm date{};
  gmtime_r(&seconds, &date);
  char month[32];
  std::strftime(month, sizeof month, "%B", &date);
  return fmt::format("{} {}, {}", month, date.tm_mday, 1900 + date.tm_year);
}

bool write(const std::filesystem::path& path, const std::string& text) {
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  return write_output(path, text).has_value();
}

int manual(const std::string& directory) {
  const std::string date = date_of_pages();
  std::vector<ManualFile> files = command_pages(date);
  files.push_back(tree_page(date));
  files.push_back(recording_page(date));
  std::string list;
  for (const ManualFile& file : files) {
    const auto path = std::filesystem::path(directory) / file.name;
    if (!write(path, file.roff)) {
      print_error(fmt::format("cannot write '{}'", printable(path.string())));
      return kExitUsage;
    }
    list += path.string() + '\n';
  }
  return write_results(list);
}

std::function<int()> define_manual(CLI::App& app) {
  const auto directory = std::make_shared<std::string>();
  app.add_option("directory", *directory, "Where man1/ and man5/ are made")
      ->type_name("DIR")
      ->required();
  return [directory] { return manual(*directory); };
}

}  // namespace

extern const Command kManualCommand{
    "manual", "Write the manual pages: a page for each command, lockstep-tree(5) and more",
    "They are made from the same descriptions as --help. The packages have them; "
    "SOURCE_DATE_EPOCH\n"
    "gives their date.\n"
    "\n"
    "Exit code: 0 written, 2 usage or a file that cannot be written.\n"
    "\n"
    "Examples:\n"
    "  lockstep manual ~/.local/share/man && man lockstep-run",
    define_manual};

}  // namespace lockstep::host
