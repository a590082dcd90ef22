#include "cli/help_text.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>
#include <sstream>

#include "cli/command_walk.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kColumn = 30;  // where descriptions begin
// The end of the names of groups that are in --help-all only.
constexpr std::string_view kMore = ", more";
constexpr std::size_t kNarrowest = 20;  // columns for them, in any terminal

// The paragraphs of a text, wrapped again. Lines that begin with a blank, as examples do, stay.
std::string filled(const std::string& text, std::size_t width) {
  std::istringstream lines(text);
  std::string result, paragraph;
  const auto end_paragraph = [&] {
    if (!paragraph.empty()) result += wrapped(paragraph, width) + '\n';
    paragraph.clear();
  };
  for (std::string line; std::getline(lines, line);) {
    const bool is_text = !line.empty() && line[0] != ' ';
    if (!is_text) end_paragraph();
    if (is_text) {
      paragraph += (paragraph.empty() ? "" : " ") + line;
    } else {
      result += line + '\n';
    }
  }
  end_paragraph();
  if (!result.empty()) result.pop_back();
  return result;
}

class WrappedHelp final : public CLI::Formatter {
 public:
  explicit WrappedHelp(std::size_t width)
      : width_(std::max(width, kColumn + kNarrowest) - kColumn) {
    column_width(kColumn);
  }

  // Without the syntax of CLI11: "TEXT:a|b=a REQUIRED Needs: --c".
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string value = takes_value(*option) ? value_name(*option) : "";
    return value.empty() ? "" : " " + value;
  }

  std::string make_option_desc(const CLI::Option* option) const override {
    std::string text = option->get_description();
    const std::string standard = option->get_default_str();
    if (!standard.empty()) text += fmt::format(" (default: {})", standard);
    if (option->get_required() && !option->get_positional()) text += " (required)";
    for (const CLI::Option* it : option->get_needs()) {
      text += fmt::format(" (only with {})", it->get_name());
    }
    return wrapped(text, width_);
  }

  std::string make_subcommand(const CLI::App* command) const override {
    std::ostringstream out;
    CLI::detail::format_help(out, command->get_display_name(),
                             wrapped(command->get_description(), width_), kColumn);
    return out.str();
  }

  std::string make_description(const CLI::App* command) const override {
    return filled(command->get_description(), kColumn + width_) + "\n";
  }

  std::string make_help(const CLI::App* command, std::string name,
                        CLI::AppFormatMode mode) const override {
    shows_all_ = mode == CLI::AppFormatMode::All;
    std::string text = Formatter::make_help(command, std::move(name), mode);
    for (auto at = text.find("\n\n\n"); at != text.npos; at = text.find("\n\n\n", at)) {
      text.erase(at, 1);  // around groups that are left out
    }
    return text;
  }

  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override {
    if (group.ends_with(kMore) && !shows_all_) return "";
    return Formatter::make_group(std::move(group), is_positional, std::move(options));
  }

  std::string make_footer(const CLI::App* command) const override {
    const std::string footer = filled(command->get_footer(), kColumn + width_);
    const auto more = command->get_options(
        [](const CLI::Option* it) { return it->get_group().ends_with(kMore); });
    const std::string hint = more.empty() || shows_all_
                                 ? ""
                                 : fmt::format("{} more options: --help-all\n\n", more.size());
    return footer.empty() ? hint : hint + footer + "\n";
  }

 private:
  std::size_t width_;
  mutable bool shows_all_ = false;  // in the call of make_help that goes on
};

}  // namespace

std::string value_name(const CLI::Option& option) {
  std::string type = option.get_type_name();
  const std::size_t colon = type.find(':');
  const bool is_list = colon != std::string::npos &&
                       (type.find('|', colon) != std::string::npos || type[colon + 1] == '{');
  if (is_list) type = type.substr(colon + 1);
  type = type.substr(0, type.find(":INT"));  // the range that CLI11 adds
  std::erase_if(type, [&](char c) { return is_list && (c == '{' || c == '}'); });
  std::ranges::replace(type, ',', is_list ? '|' : ',');
  return type;
}

std::string wrapped(std::string_view text, std::size_t width) {
  std::string lines;
  std::size_t column = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    if (column != 0) {
      const bool fits = column + 1 + word.size() <= width;
      lines += fits ? ' ' : '\n';
      column = fits ? column + 1 : 0;
    }
    lines += word;
    column += word.size();
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

void only_in_help_all(CLI::App& command, std::span<const char* const> options) {
  const std::set<std::string_view> names(options.begin(), options.end());
  for (CLI::Option* const option : command.get_options()) {
    const std::string name = option->get_name();
    if (names.contains(name)) option->group(option->get_group() + std::string(kMore));
  }
  command.option_defaults()->group("Options");
  command.set_help_all_flag("--help-all", "Print the help with all options and exit");
}

std::shared_ptr<CLI::FormatterBase> help_formatter(std::size_t width) {
  return std::make_shared<WrappedHelp>(width);
}

}  // namespace lockstep::host
