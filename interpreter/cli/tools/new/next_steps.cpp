// The commands to type next: with this program, wherever it is.
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "base/terminal/outlet.h"
#include "cli/tools/new/new.h"
#include "run/loading/plugin_directories.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

// Whether a directory is one of PATH.
bool is_on_path(const fs::path& directory) {
  const char* const path = std::getenv("PATH");
  std::istringstream directories(path == nullptr ? "" : path);
  std::error_code error;
  for (std::string it; std::getline(directories, it, ':');) {
    if (!it.empty() && fs::equivalent(it, directory, error)) return true;
  }
  return false;
}

}  // namespace

void print_next(std::span<const std::string> lines) {
  if (lines.empty()) return;
  std::string text = "\nnext:\n";
  for (const std::string& line : lines) text += "  " + line + '\n';
  messages().say(text);
}

std::string in_shell(const std::string& word) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::strchr("_-./=+,:@", c) != nullptr;
  };
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + '\'';
}

std::string program_word() {
  const fs::path directory = program_directory({});
  return directory.empty() || is_on_path(directory) ? "lockstep"
                                                    : in_shell((directory / "lockstep").string());
}

std::string configure_option() {
  const fs::path directory = program_directory({});
  if (fs::exists(directory / "cmake/lockstep/lockstepConfig.cmake")) {  // a build of the sources
    return " -Dlockstep_DIR=" + in_shell((directory / "cmake/lockstep").string());
  }
  const bool is_found =
      is_on_path(directory) || directory == "/usr/bin" || directory == "/usr/local/bin";
  return is_found ? "" : " -DCMAKE_PREFIX_PATH=" + in_shell(directory.parent_path().string());
}

}  // namespace lockstep::host
