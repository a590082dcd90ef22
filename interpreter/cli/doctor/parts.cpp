#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "base/system/late_library.h"
#include "cli/doctor/symptoms.h"
#include "run/loading/plugin_directories.h"
#include "run/loading/plugins.h"

namespace lockstep::host {
namespace {

using Grade = Symptom::Grade;
namespace fs = std::filesystem;

std::size_t count_plugins(const std::string& directory) {
  std::size_t count = 0;
  std::error_code error;
  for (fs::directory_iterator it(directory, error), end; !error && it != end; it.increment(error))
    count += it->path().extension() == ".so" ? 1U : 0U;
  return count;
}

void look_at_plugins(const Patient& patient, Symptoms& symptoms) {
  std::size_t all = 0;
  const auto directories = plugin_directories(patient.plugins);
  for (std::size_t i = 0; i < directories.size(); ++i) {
    const std::size_t count = count_plugins(directories[i]);
    all += count;
    std::error_code error;
    const bool is_there = fs::is_directory(directories[i], error);
    const bool is_own = i + 2 >= directories.size();  // in a build, or installed: one of them
    if (is_there)
      symptoms.push_back(
          {"plugin path", Grade::Good, fmt::format("{}: {} plugins", directories[i], count)});
    else if (!is_own)
      symptoms.push_back({"plugin path", Grade::Trouble,
                          fmt::format("{}: there is no such directory", directories[i]),
                          "mend --plugin-path or LOCKSTEP_PLUGIN_PATH"});
  }
  if (all == 0)
    symptoms.push_back({"plugins", Grade::Trouble, "there are none",
                        "build or install lockstep with its plugins, or set LOCKSTEP_PLUGIN_PATH"});
}

void look_at_leafhost(const Patient& patient, Symptoms& symptoms) {
  const std::string leafhost = isolation_options(patient.plugins).leafhost;
  if (access(leafhost.c_str(), X_OK) == 0)
    symptoms.push_back({"isolation", Grade::Good, leafhost});
  else
    symptoms.push_back({"isolation", Grade::Trouble, fmt::format("there is no {}", leafhost),
                        "--isolate and process plugins need it: install all of lockstep"});
}

bool is_program(const char* name) {
  const char* const path = std::getenv("PATH");
  std::istringstream directories(path != nullptr ? path : "");
  for (std::string directory; std::getline(directories, directory, ':');)
    if (access((directory + "/" + name).c_str(), X_OK) == 0) return true;
  return false;
}

struct Part {
  const char* name;
  const char* user;  // what needs it
  const char* package;
};

constexpr Part kPrograms[] = {
    {"gnuplot", "`log plot` and the plots of studies", "gnuplot-nox"},
    {"python3", "plugins in Python, and the plugin exec", "python3"},
    {"xdg-open", "--monitor-open", "xdg-utils"},
};

// Those that are loaded when they are needed first.
constexpr Part kLibraries[] = {
    {LOCKSTEP_ZSTD, "compressed recordings", "libzstd1"},
#ifdef LOCKSTEP_MICROHTTPD
    {LOCKSTEP_MICROHTTPD, "`run --monitor`", "libmicrohttpd12"},
#endif
#ifdef LOCKSTEP_ZMQ
    {LOCKSTEP_ZMQ, "`run --groot2`", "libzmq5"},
#endif
#ifdef LOCKSTEP_SODIUM
    {LOCKSTEP_SODIUM, "tickets of `verify`", "libsodium23"},
#endif
};

void look_at(const Part& part, bool is_there, Symptoms& symptoms) {
  if (is_there)
    symptoms.push_back({part.name, Grade::Good, fmt::format("for {}", part.user)});
  else
    symptoms.push_back({part.name, Grade::Note, fmt::format("missing: for {}", part.user),
                        fmt::format("sudo apt-get install {}", part.package)});
}

struct AnyLibrary : LateLibrary {
  explicit AnyLibrary(const char* file) : LateLibrary(file) {}
};

bool is_library(const char* file) {
  try {
    const AnyLibrary library(file);
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

// No package has it.
void look_at_team(const Patient& patient, Symptoms& symptoms) {
  const std::string module = team_module(patient.plugins);
  constexpr const char* kName = "lockstep-team.so";
  if (is_library(module.c_str()))
    symptoms.push_back({kName, Grade::Good, "for robots in step on a network"});
  else
    symptoms.push_back({kName, Grade::Note, "missing: for robots in step on a network",
                        "build with ./dev build, or with -DLOCKSTEP_TEAM=ON"});
}

}  // namespace

void look_at_parts(const Patient& patient, Symptoms& symptoms) {
  look_at_plugins(patient, symptoms);
  look_at_leafhost(patient, symptoms);
  for (const Part& part : kLibraries) look_at(part, is_library(part.name), symptoms);
  look_at_team(patient, symptoms);
  for (const Part& part : kPrograms) look_at(part, is_program(part.name), symptoms);
}

}  // namespace lockstep::host
