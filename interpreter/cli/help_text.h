// The text of --help: descriptions wrap at the width of the terminal, or at 80 columns.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace CLI {
class App;
class FormatterBase;
class Option;
}  // namespace CLI

namespace lockstep::host {

// `text` with line breaks between words, so that no line is longer than `width` columns where its
// words allow that.
std::string wrapped(std::string_view text, std::size_t width);

// What stands for the value of an option: "wall|virtual" for "TEXT:wall|virtual", "HZ" for "HZ".
std::string value_name(const CLI::Option& option);

std::shared_ptr<CLI::FormatterBase> help_formatter(std::size_t width);

// Leaves these options out of --help, which nobody reads if it is longer than two screens. They are
// in --help-all, in completion and in the manual page.
void only_in_help_all(CLI::App& command, std::span<const char* const> options);

}  // namespace lockstep::host
