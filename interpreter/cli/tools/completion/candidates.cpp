#include "cli/tools/completion/candidates.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/command_program.h"
#include "cli/command_walk.h"
#include "cli/tools/completion/value_kinds.h"

namespace lockstep::host {
namespace {

// Each option once, by its long name.
std::vector<Candidate> options_of(const CLI::App& command) {
  std::vector<Candidate> result;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_lnames().empty()) continue;
    result.push_back(
        {"--" + option->get_lnames().front(), first_sentence(option->get_description())});
  }
  return result;
}

std::vector<Candidate> commands_of(const CLI::App& command) {
  std::vector<Candidate> result;
  for (const CLI::App* it : subcommands(command))
    result.push_back({it->get_name(), first_sentence(it->get_description())});
  return result;
}

// The positional in whose place the next word would be.
const CLI::Option* next_positional(const CommandWalk& walk) {
  auto before = static_cast<int>(walk.arguments.size());
  for (const CLI::Option* option : walk.command->get_options()) {
    if (!option->get_positional()) continue;
    before -= option->get_items_expected_max();
    if (before < 0) return option;
  }
  return nullptr;
}

Candidates arguments_of(const CommandWalk& walk) {
  Candidates result;
  if (const CLI::Option* option = next_positional(walk); option != nullptr)
    result = values_of(*option, walk);
  if (walk.arguments.empty()) {
    auto commands = commands_of(*walk.command);
    result.words.insert(result.words.begin(), commands.begin(), commands.end());
  }
  return result;
}

// `--clock=virtual`: whole words, as the shells replace them.
Candidates joined_value(const CommandWalk& walk, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  const CLI::Option* option = find_option(*walk.command, name);
  if (option == nullptr || !takes_value(*option)) return {};
  Candidates result = values_of(*option, walk);
  for (Candidate& it : result.words) it.word.insert(0, name + "=");
  result.files.clear();
  return result;
}

Candidates all_candidates(const CommandWalk& walk, const std::string& word) {
  // The value may be left out where its type is in brackets.
  const bool is_open = walk.open != nullptr && !walk.open->get_type_name().starts_with('[');
  if (is_open) return values_of(*walk.open, walk);
  if (word.starts_with("--") && word.find('=') != std::string::npos)
    return joined_value(walk, word);
  if (word.starts_with('-')) return {options_of(*walk.command)};
  return arguments_of(walk);
}

}  // namespace

Candidates candidates(std::span<const std::string> words) {
  Program program({words.begin(), words.end()}, Program::Options::OfNamedCommands);
  const std::string word = words.empty() ? "" : words.back();
  auto before = words.first(words.size() - (words.empty() ? 0 : 1));
  const bool is_help = !before.empty() && before.front() == "help";
  if (is_help) before = before.subspan(1);
  const CommandWalk walk = follow(program.app(), before);
  Candidates result = is_help ? Candidates{commands_of(*walk.command)} : all_candidates(walk, word);
  std::erase_if(result.words, [&](const Candidate& it) { return !it.word.starts_with(word); });
  return result;
}

}  // namespace lockstep::host
