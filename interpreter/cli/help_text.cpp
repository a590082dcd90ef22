#include "cli/help_text.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

namespace lockstep::host {
namespace {

constexpr std::size_t kColumn = 30;     // where descriptions begin
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

  std::string make_option_desc(const CLI::Option* option) const override {
    return wrapped(option->get_description(), width_);
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

  std::string make_footer(const CLI::App* command) const override {
    const std::string footer = filled(command->get_footer(), kColumn + width_);
    return footer.empty() ? "" : footer + "\n";
  }

 private:
  std::size_t width_;
};

}  // namespace

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

std::shared_ptr<CLI::FormatterBase> help_formatter(std::size_t width) {
  return std::make_shared<WrappedHelp>(width);
}

}  // namespace lockstep::host
