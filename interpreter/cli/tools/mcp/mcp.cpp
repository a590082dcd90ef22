#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/load_options.h"
#include "cli/tools/mcp/mcp_server.h"
#include "run/stop_signals.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

struct McpOptions {
  std::string workspace = ".";
  PluginOptions plugins;
  double seconds = 60;
  std::size_t memory_mib = 4096;
};

// Its own, and gone at the end.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::error_code error;
    std::string name = (fs::temp_directory_path(error) / "lockstep-mcp-XXXXXX").string();
    if (mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~ScratchFolder() {
    std::error_code unused;
    if (!path_.empty()) fs::remove_all(path_, unused);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::vector<std::string> plugin_words(const PluginOptions& options) {
  const auto whole = [](const std::string& it) {
    std::error_code unused;
    return is_plugin_file(it) ? fs::absolute(it, unused).string() : it;
  };
  std::vector<std::string> words;
  for (const std::string& it : options.plugins) words.push_back("--plugin=" + whole(it));
  std::error_code unused;
  for (const std::string& it : options.directories)
    words.push_back("--plugin-path=" + fs::absolute(it, unused).string());
  return words;
}

int serve_mcp(const McpOptions& options) {
  if (is_terminal(STDIN_FILENO)) {
    print_note("this waits for a client, which starts it and talks to it over stdin and stdout",
               "see `lockstep docs mcp`; Ctrl-D ends it");
  }
  const std::vector<std::string> words = plugin_words(options.plugins);
  std::error_code error;
  const fs::path workspace = fs::canonical(options.workspace, error);
  if (!error) fs::current_path(workspace, error);
  if (error) {
    print_error(fmt::format("--workspace {}: {}", printable(options.workspace), error.message()));
    return kExitUsage;
  }
  const ScratchFolder scratch;
  if (scratch.path().empty()) {
    print_error(fmt::format("no temporary folder can be made: {}", strerror(errno)),
                "TMPDIR names the folder in which it is made");
    return kExitUsage;
  }
  keep_stdout_for_results();
  StopSignals::install();
  McpServer server({workspace, scratch.path(), words, options.seconds, options.memory_mib},
                   STDIN_FILENO, results_file());
  server.run();
  if (const int signal = StopSignals::received(); signal != 0) return kExitSignal + signal;
  if (server.problem().empty()) return kExitSuccess;
  print_error(server.problem(), "stdin must have messages of the Model Context Protocol");
  return kExitUsage;
}

std::function<int()> define_mcp(CLI::App& app) {
  const auto options = std::make_shared<McpOptions>();
  app.add_option("--workspace", options->workspace, "The folder that the tools read")
      ->type_name("DIR")
      ->capture_default_str();
  app.add_option("--plugin", options->plugins.plugins,
                 "Load this plugin for all trees: a file, or a name to search for; may be repeated")
      ->type_name("FILE|NAME")
      ->allow_extra_args(false);
  app.add_option("--plugin-path", options->plugins.directories,
                 "Search plugins in this directory first; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
  app.add_option("--time", options->seconds, "A call that takes longer than S seconds is stopped")
      ->type_name("S")
      ->check(number_between(0.1, 1e6))
      ->capture_default_str();
  app.add_option("--memory", options->memory_mib, "A call gets at most N MiB of memory")
      ->type_name("N")
      ->transform(whole_number(256, std::size_t{1} << 30u))
      ->capture_default_str();
  return [options] { return serve_mcp(*options); };
}

}  // namespace

extern const Command kMcpCommand{
    "mcp", "Serve a program that writes trees: check, verify, test and simulate them",
    "Speaks the Model Context Protocol on stdin and stdout; clients start it. Each call is a\n"
    "process with limits. No tool writes a file of the workspace or uses a robot's clock.\n"
    "Exit code: 0 the client has closed stdin, 2 usage, or no message of the protocol.\n"
    "\n"
    "Examples:\n"
    "  lockstep mcp --workspace trees\n"
    "  lockstep mcp --plugin-path build/plugins --time 300",
    define_mcp};

}  // namespace lockstep::host
