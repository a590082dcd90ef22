#include "cli/command_walk.h"

#include <CLI/CLI.hpp>
#include <algorithm>

namespace lockstep::host {
namespace {

const CLI::App* find_subcommand(const CLI::App& command, const std::string& name) {
  const auto all = subcommands(command);
  const auto found = std::ranges::find(all, name, [](const auto* it) { return it->get_name(); });
  return found == all.end() ? nullptr : *found;
}

// `--name`, `--name=value`, `-n` or `-nvalue`. Returns how many of the next words are its values.
std::size_t follow_option(CommandWalk& walk, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  const CLI::Option* option = find_option(*walk.command, name);
  const bool is_short = !word.starts_with("--");
  const bool has_value = name.size() < word.size() || (option == nullptr && is_short);
  if (option == nullptr && is_short) option = find_option(*walk.command, word.substr(0, 2));
  if (option == nullptr && walk.unknown_option.empty()) {
    walk.unknown_option = name;
    walk.unknown_at = walk.command;
  }
  const bool needs_value = option != nullptr && takes_value(*option);
  const bool is_empty = word.size() == name.size() + 1;  // "--name="
  if (needs_value && is_empty && walk.empty_option.empty()) walk.empty_option = name;
  walk.open = needs_value && !has_value ? option : nullptr;
  return walk.open != nullptr ? static_cast<std::size_t>(option->get_items_expected_min()) : 0;
}

}  // namespace

std::vector<const CLI::App*> subcommands(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App*) { return true; });
}

bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

// Not get_option_no_throw(): without memory it ends the program.
const CLI::Option* find_option(const CLI::App& command, const std::string& name) {
  const auto all = command.get_options();
  const auto found =
      std::ranges::find_if(all, [&](const auto* it) { return it->check_name(name); });
  return found == all.end() ? nullptr : *found;
}

CommandWalk follow(const CLI::App& program, std::span<const std::string> words) {
  CommandWalk walk{&program, {}, &program, {}, nullptr, {}};
  bool options_end = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (!options_end && word.size() > 1 && word[0] == '-') {
      options_end = word == "--";
      if (options_end) continue;
      for (std::size_t values = follow_option(walk, word); values > 0; --values) {
        const bool has_one = ++i < words.size() && !words[i].empty();
        if (!has_one && walk.empty_option.empty()) walk.empty_option = word;
      }
      if (i < words.size()) walk.open = nullptr;
    } else if (const CLI::App* command = find_subcommand(*walk.command, word)) {
      walk.command = command;
    } else {
      walk.arguments.push_back(word);
    }
  }
  return walk;
}

std::string command_line_of(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent == nullptr ? command.get_name()
                           : command_line_of(*parent) + " " + command.get_name();
}

std::string command_name_of(const CLI::App& command) {
  const std::string path = command_line_of(command);
  return path.substr(std::min(path.find(' ') + 1, path.size()));
}

}  // namespace lockstep::host
