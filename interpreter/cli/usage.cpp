#include "cli/usage.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>

#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "cli/command_walk.h"

namespace lockstep::host {
namespace {

std::string with_help(const CLI::App& command, std::string hint) {
  const std::string help = fmt::format("see `{} --help`", command_line_of(command));
  return hint.empty() ? help : fmt::format("{} {}", hint, help);
}

std::string suggest_one_of(std::string_view word, const std::vector<std::string>& names,
                           std::string_view what) {
  const std::vector<std::string_view> views(names.begin(), names.end());
  return what.empty() ? did_you_mean(word, views) : suggest(word, views, what);
}

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

// "--clock virtual" for '--virtual': a value that is taken for an option.
std::string option_with_value(const CLI::App& command, const std::string& value) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string type = option->get_type_name();  // "TEXT:wall|virtual"
    const std::string values = "|" + type.substr(type.find(':') + 1) + "|";
    if (type.find('|') == std::string::npos || option->get_lnames().empty()) continue;
    if (values.find("|" + value + "|") == std::string::npos) continue;
    return fmt::format("--{} {}", option->get_lnames().front(), value);
  }
  return {};
}

void find_owners(const CLI::App& command, const std::string& option,
                 std::vector<const CLI::App*>& owners) {
  if (find_option(command, option) != nullptr) owners.push_back(&command);
  for (const CLI::App* it : subcommands(command)) find_owners(*it, option, owners);
}

// Which other commands have the option.
std::string owners_hint(const CLI::App& program, const std::string& option) {
  constexpr std::size_t kMostNamed = 2;
  std::vector<const CLI::App*> owners;
  find_owners(program, option, owners);
  if (owners.empty()) return {};
  const std::string names = some_of(
      owners, kMostNamed, [](const CLI::App* it) { return '`' + command_line_of(*it) + '`'; });
  return fmt::format("{} {} that option;", names, owners.size() == 1 ? "has" : "have");
}

UsageError unknown_option(const CLI::App& program, const CommandWalk& walk) {
  const CLI::App& command = *walk.command;
  const std::string& option = walk.unknown_option;
  std::string hint;
  if (walk.unknown_at != &command && find_option(command, option) != nullptr) {
    hint = fmt::format("it stands behind the command: `{} {}`;", command_line_of(command), option);
  }
  if (hint.empty() && option.starts_with("--")) {
    const std::string better = option_with_value(command, option.substr(2));
    hint =
        better.empty() ? owners_hint(program, option) : fmt::format("did you mean '{}'?", better);
  }
  if (hint.empty()) hint = suggest_one_of(option, option_names(command), "");
  return {fmt::format("unknown option '{}'", brief(option)), with_help(command, hint)};
}

// A question, or a list.
std::string suggest_command(const CLI::App& command, std::string_view word) {
  std::string hint = suggest_one_of(word, names_of(subcommands(command)), "commands");
  if (!hint.ends_with('?')) hint += ';';
  return hint;
}

UsageError unknown_command(const CommandWalk& walk) {
  const bool is_program = walk.command->get_parent() == nullptr;
  const std::string prefix = is_program ? "" : command_name_of(*walk.command) + " ";
  return {fmt::format("unknown command '{}{}'", prefix, brief(walk.arguments.front())),
          with_help(*walk.command, suggest_command(*walk.command, walk.arguments.front()))};
}

// A command that takes a file or a subcommand got a subcommand that is mistyped.
bool is_mistyped_command(const CommandWalk& walk) {
  const auto names = names_of(subcommands(*walk.command));
  return !walk.arguments.empty() && !names.empty() &&
         !suggest_one_of(walk.arguments.front(), names, "").empty() &&
         !std::filesystem::exists(walk.arguments.front());
}

// How many arguments the command takes that are not options.
std::size_t capacity(const CLI::App& command) {
  std::size_t count = 0;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional())
      count += static_cast<std::size_t>(option->get_items_expected_max());
  }
  return count;
}

std::string reason(const CLI::ParseError& error) {
  constexpr std::string_view kConversion = "Could not convert: ";
  std::string text = error.what();
  const auto equals = text.find(" = ");
  if (text.starts_with(kConversion) && equals != std::string::npos) {
    return fmt::format("{}: '{}' is not a value of this option",
                       text.substr(kConversion.size(), equals - kConversion.size()),
                       brief(std::string_view(text).substr(equals + 3)));
  }
  // In our words: lower case.
  if (text.size() > 1 && std::isupper(text[0]) != 0 && std::islower(text[1]) != 0)
    text[0] = static_cast<char>(std::tolower(text[0]));
  return text;
}

}  // namespace

std::optional<UsageError> find_unknown_command(const CLI::App& program,
                                               std::span<const std::string> words) {
  const CommandWalk walk = follow(program, words);
  if (walk.arguments.empty() || walk.command->get_require_subcommand_min() == 0)
    return std::nullopt;
  return unknown_command(walk);
}

std::optional<UsageError> find_empty_option(const CLI::App& program,
                                            std::span<const std::string> words) {
  const CommandWalk walk = follow(program, words);
  if (walk.empty_option.empty() || !walk.unknown_option.empty()) return std::nullopt;
  return UsageError{fmt::format("'{}' needs a value", brief(walk.empty_option)),
                    with_help(*walk.command, "")};
}

UsageError explain(const CLI::App& program, std::span<const std::string> words,
                   const CLI::ParseError& error) {
  const CommandWalk walk = follow(program, words);
  const CLI::App& command = *walk.command;
  if (!walk.unknown_option.empty()) return unknown_option(program, walk);
  if (command.get_require_subcommand_min() > 0) {
    return {fmt::format("`{}` needs a command", command_line_of(command)),
            with_help(command, suggest_command(command, ""))};
  }
  if (!walk.empty_option.empty()) {
    return {fmt::format("'{}' needs a value", brief(walk.empty_option)), with_help(command, "")};
  }
  if (is_mistyped_command(walk)) return unknown_command(walk);
  if (walk.arguments.size() > capacity(command)) {
    const std::string& argument = walk.arguments[capacity(command)];
    return {fmt::format("unexpected argument '{}'", brief(argument)), with_help(command, "")};
  }
  return {reason(error), with_help(command, "")};
}

}  // namespace lockstep::host
