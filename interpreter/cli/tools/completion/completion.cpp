#include <CLI/CLI.hpp>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/tools/completion/candidates.h"
#include "cli/tools/completion/shell_scripts.h"

namespace lockstep::host {
namespace {

struct Shell {
  const char* name;
  const char* about;
  const char* script;
};

int print_candidates(std::vector<std::string> words) {
  if (!words.empty()) words.erase(words.begin());  // the program's name
  const Candidates found = candidates(words);
  std::string text;
  for (const Candidate& it : found.words) {
    text += it.word + (it.about.empty() ? "" : '\t' + it.about) + '\n';
  }
  if (!found.files.empty()) text += found.files + '\n';
  return write_results(text);
}

std::function<int()> define_completion(CLI::App& app) {
  const Shell shells[] = {{"bash", "Print the script for bash", kBashCompletion},
                          {"zsh", "Print the script for zsh", kZshCompletion},
                          {"fish", "Print the script for fish", kFishCompletion}};
  app.require_subcommand(1);
  const auto text = std::make_shared<const char*>(nullptr);
  for (const Shell& shell : shells) {
    app.add_subcommand(shell.name, shell.about)->callback([text, script = shell.script] {
      *text = script;
    });
  }
  CLI::App* const words = app.add_subcommand(
      "words", "Print the words that may end the line that follows; the scripts call this");
  words->prefix_command();
  return [words, text] {
    return *text != nullptr ? write_results(*text) : print_candidates(words->remaining());
  };
}

}  // namespace

extern const Command kCompletionCommand{
    "completion", "Print a script for the completion of the command line in a shell",
    "The script gets from lockstep the commands, options and values that could stand next. Values\n"
    "come from the tree or the recording on the line; no plugin is loaded for that.\n"
    "\n"
    "Exit code: 0 printed, 2 usage.\n"
    "\n"
    "Examples, for the file that the shell reads at its start:\n"
    "  eval \"$(lockstep completion bash)\"\n"
    "  eval \"$(lockstep completion zsh)\"      # behind compinit\n"
    "  lockstep completion fish | source",
    define_completion};

}  // namespace lockstep::host
