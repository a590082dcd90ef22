#include <unistd.h>

#include <CLI/CLI.hpp>

#include "author/server/server.h"
#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/load_options.h"

namespace lockstep::host {
namespace {

struct LspOptions {
  PluginOptions plugins;
  bool no_plugins = false;
  bool stdio = true;
};

int serve(const LspOptions& options) {
  if (is_terminal(STDIN_FILENO)) {
    print_note("this waits for an editor, which starts it and talks to it over stdin and stdout",
               "see `lockstep docs language_server`; Ctrl-D ends it");
  }
  keep_stdout_for_results();  // what plugins print is no message of the protocol
  Server server({options.plugins, {}, !options.no_plugins}, STDIN_FILENO, results_file());
  const int code = server.run();
  if (server.problem().empty()) return code;
  print_error(server.problem(), "stdin must have messages of the Language Server Protocol");
  return kExitUsage;
}

std::function<int()> define_lsp(CLI::App& app) {
  const auto options = std::make_shared<LspOptions>();
  app.add_option("--plugin", options->plugins.plugins,
                 "Load this plugin for all files: a file, or a name to search for; may be repeated")
      ->type_name("FILE|NAME")
      ->allow_extra_args(false);
  app.add_option("--plugin-path", options->plugins.directories,
                 "Search plugins in this directory first; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
  app.add_option("--hang-limit", options->plugins.hang_limit,
                 "A plugin that takes longer than S seconds to be loaded is a hang; 0 = never")
      ->type_name("S")
      ->check(number_between(0.0, 1e6))
      ->capture_default_str();
  app.add_flag("--no-plugins", options->no_plugins, "Load no plugin, as in an untrusted workspace");
  app.add_flag("--stdio", options->stdio, "Has no effect: stdin and stdout are always used");
  return [options] { return serve(*options); };
}

}  // namespace

extern const Command kLspCommand{
    "lsp", "Serve an editor: messages, completion and more while you write a tree",
    "Speaks the Language Server Protocol 3.17 on stdin and stdout; editors start it. Plugins are\n"
    "loaded in other processes; programs are not started.\n"
    "Exit code: 0 after the editor has ended the session, 1 the editor vanished, 2 usage or\n"
    "a message that is not of the protocol.\n"
    "\n"
    "Examples, the second in the init.lua of Neovim 0.8 or later:\n"
    "  lockstep lsp --plugin-path build/plugins\n"
    "  vim.lsp.start({name = 'lockstep', cmd = {'lockstep', 'lsp'}})",
    define_lsp};

}  // namespace lockstep::host
