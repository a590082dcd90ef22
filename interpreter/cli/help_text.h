// The text of --help: descriptions wrap at the width of the terminal, or at 80 columns.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace CLI {
class FormatterBase;
}  // namespace CLI

namespace lockstep::host {

// `text` with line breaks between words, so that no line is longer than `width` columns where its
// words allow that.
std::string wrapped(std::string_view text, std::size_t width);

std::shared_ptr<CLI::FormatterBase> help_formatter(std::size_t width);

}  // namespace lockstep::host
