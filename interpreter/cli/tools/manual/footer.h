// The end of --help, in the sections of a manual page.
#pragma once

#include <string>
#include <vector>

namespace lockstep::host {

struct Footer {
  std::vector<std::string> text;  // paragraphs; one with an indented line stays as it is
  std::string exit_code, examples;
};

Footer parse_footer(const std::string& text);
// Whether it has an indented line.
bool is_table(const std::string& paragraph);

}  // namespace lockstep::host
