#include "cli/about.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <filesystem>
#include <string_view>

#include "base/core/language.h"
#include "base/core/version.h"
#include "cli/command.h"
#include "lockstep/leaf.h"
#include "record/lines.h"
#include "run/loading/plugin_directories.h"

namespace lockstep::host {
namespace {

bool has_tools() {
  for (const Command* command : commands())
    if (std::string_view(command->name) == "log") return command->define != absent("log").define;
  return false;
}

std::string parts() {
  std::string text = has_tools() ? "tools, " : "";
#ifdef LOCKSTEP_MICROHTTPD
  text += "monitor (" LOCKSTEP_MICROHTTPD "), ";
#endif
#ifdef LOCKSTEP_ZMQ
  text += "groot2 (" LOCKSTEP_ZMQ "), ";
#endif
  return text + "compressed recordings (" LOCKSTEP_ZSTD ")";
}

std::string compiler() {
#ifdef __clang__
  return __VERSION__;
#else
  return "g++ " __VERSION__;
#endif
}

}  // namespace

std::string about_text() {
  utsname system{};
  uname(&system);
  const PluginOptions defaults;
  std::string text = fmt::format("lockstep {}\n", kVersion);
  const auto line = [&text](std::string_view name, const std::string& value) {
    text += fmt::format("{:<17} {}\n", name, value);
  };
  line("parts", parts());
  line("plugin contract", fmt::format("{}.{}", LOCKSTEP_ABI_MAJOR, LOCKSTEP_ABI_MINOR));
  line("semantics", fmt::format("{}", kLawVersion));
  line("recordings", fmt::format("{}", kRecordingVersion));
  line("compiler", compiler());
  line("system", fmt::format("{} {} {}", system.sysname, system.release, system.machine));
  line("program", program_directory(defaults).string());
  line("lockstep-leafhost", isolation_options(defaults).leafhost);
  for (const std::string& directory : plugin_directories(defaults)) {
    std::error_code error;
    const bool is_there = std::filesystem::is_directory(directory, error);
    line("plugins", is_there ? directory : directory + " (not there)");
  }
  text.pop_back();
  return text;
}

}  // namespace lockstep::host
