#include "reliability/hostile_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace lockstep::host::test {
namespace {

namespace fs = std::filesystem;

std::string surrounded(const std::string& leaf, const std::string& function) {
  if (function == "halt") return fmt::format("<Timeout seconds=\"0.03\">{}</Timeout>", leaf);
  if (function == "progress") {
    return fmt::format("<ParallelRelative delta=\"1\">{}<Wait seconds=\"0.1\"/></ParallelRelative>",
                       leaf);
  }
  if (function == "pause" || function == "resume") {
    return fmt::format(
        "<ParallelAbsolute barriers=\"0.5\">{}<Wait seconds=\"0.2\"/></ParallelAbsolute>", leaf);
  }
  return leaf;
}

}  // namespace

std::string hostile_tree(const Misdeed& misdeed) {
  const std::string leaf =
      fmt::format("<Misbehave name=\"arm\" how=\"{}\" where=\"{}\" number=\"{{n}}\"/>", misdeed.how,
                  misdeed.where);
  return fmt::format(
      "<root lockstep=\"1\"><plugin name=\"hostile\"/><BehaviorTree ID=\"Main\">"
      "<Fallback name=\"plan\">{}<AlwaysSuccess name=\"instead\"/></Fallback>"
      "</BehaviorTree></root>",
      surrounded(leaf, misdeed.where));
}

Outcome run_hostile(const Misdeed& misdeed, Where where, std::vector<std::string> options,
                    std::map<std::string, std::string> environment) {
  const TemporaryDirectory directory;
  std::vector<std::string> arguments = {"run", directory.file("tree.xml", hostile_tree(misdeed)),
                                        "--plugin-path", LOCKSTEP_HOSTILE_DIRECTORY};
  if (where == Where::Isolated) arguments.emplace_back("--isolate");
  arguments.insert(arguments.end(), options.begin(), options.end());
  return run({.arguments = arguments, .environment = std::move(environment)});
}

OwnPlugin::OwnPlugin() {
  fs::copy_file(LOCKSTEP_HOSTILE_DIRECTORY "/hostile.so", directory_.path("hostile.so"));
}

std::vector<pid_t> processes_with(const std::string& text) {
  std::vector<pid_t> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (!std::ranges::all_of(name, [](unsigned char c) { return std::isdigit(c) != 0; })) continue;
    const pid_t process = std::stoi(name);
    std::string line = read_process_file(process, "cmdline");
    std::ranges::replace(line, '\0', ' ');
    if (contains(line, text)) found.push_back(process);
  }
  return found;
}

}  // namespace lockstep::host::test
