#include <CLI/CLI.hpp>
#include <fstream>
#include <sstream>

#include "base/core/diagnostics.h"
#include "base/terminal/text_table.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/installed.h"

namespace lockstep::host {
namespace {

// The first sentence of the comment at the top of the file.
std::string summary_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  const std::string all = text.str();
  auto begin = all.find("<!-- ");
  if (begin != std::string::npos && all.compare(begin, 11, "<!-- expect") == 0)
    begin = all.find("<!-- ", begin + 1);
  if (begin == std::string::npos) return {};
  begin += 5;
  std::istringstream words(all.substr(begin, all.find("-->", begin) - begin));
  std::string sentence;
  for (std::string word; words >> word;) {
    sentence += (sentence.empty() ? "" : " ") + word;
    if (word.ends_with('.') || word.ends_with(':')) break;
  }
  if (!sentence.empty()) sentence.pop_back();
  return printable(sentence);
}

int examples() {
  const std::vector<std::string> names = example_names();
  if (names.empty()) {
    print_error("the example trees are not installed",
                "they are the folder `trees` of the sources");
    return kExitUsage;
  }
  std::string text = "Example trees, in " + printable(examples_directory().string()) + ":\n";
  std::vector<TableRow> rows;
  for (const std::string& name : names)
    rows.push_back({{"  " + name, summary_of(example_file(name))}});
  text += text_table(rows, 2);
  return write_results(text + "\nTo run one: lockstep run --example door_pulling\n");
}

std::function<int()> define_examples(CLI::App&) {
  return examples;
}

}  // namespace

extern const Command kExamplesCommand{
    "examples", "List the example trees that are installed",
    "Most commands take an example instead of a file: --example NAME.\n"
    "Exit code: 0 listed, 2 the examples are not installed.\n"
    "\n"
    "Examples:\n"
    "  lockstep examples\n"
    "  lockstep run --example door_pulling\n"
    "  lockstep show --example door_pulling",
    define_examples};

}  // namespace lockstep::host
