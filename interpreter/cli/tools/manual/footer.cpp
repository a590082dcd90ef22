#include "cli/tools/manual/footer.h"

#include <algorithm>

namespace lockstep::host {
namespace {

std::vector<std::string> paragraphs_of(const std::string& text) {
  std::vector<std::string> result;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find("\n\n", begin), text.size());
    result.push_back(text.substr(begin, end - begin));
    begin = end + 2;
  }
  return result;
}

// The text behind the paragraph's first word or line.
std::string examples_of(const std::string& paragraph) {
  const std::size_t end = paragraph.find('\n');
  const std::size_t begin = end != std::string::npos ? end : paragraph.find(' ');
  return paragraph.substr(std::min(begin, paragraph.size() - 1) + 1);
}

}  // namespace

bool is_table(const std::string& paragraph) {
  return paragraph.starts_with(' ') || paragraph.find("\n ") != std::string::npos;
}

Footer parse_footer(const std::string& text) {
  Footer footer;
  for (std::string& paragraph : paragraphs_of(text)) {
    if (paragraph.starts_with("Example")) {
      footer.examples = examples_of(paragraph);
      continue;
    }
    const std::size_t code = paragraph.find("Exit code: ");
    if (code != 0) footer.text.push_back(paragraph.substr(0, code));
    if (code != std::string::npos) footer.exit_code = paragraph.substr(code);
  }
  std::ranges::replace(footer.exit_code, '\n', ' ');
  return footer;
}

}  // namespace lockstep::host
