// A manual page in mdoc, the language of man(1): escapes, and breaks lines where mdoc wants them.
#pragma once

#include <string>
#include <string_view>

namespace lockstep::host {

class ManualPage {
 public:
  // "lockstep-run", "1", "November 26, 2026", what it is about in a line.
  ManualPage(std::string_view name, std::string_view section, std::string_view date,
             std::string_view summary);

  void section(std::string_view heading);
  void subsection(std::string_view heading);
  // Words of text, with `code` in bold; each sentence on a line.
  void text(std::string_view text);
  void paragraph() { roff_ += ".Pp\n"; }
  // Lines that stay as they are.
  void literal(std::string_view lines);
  // A list of terms, each with its text. A term is a macro line: see flag(), argument(), word().
  void begin_list() { roff_ += ".Bl -tag -width Ds\n"; }
  void item(std::string_view term, std::string_view about);
  void end_list() { roff_ += ".El\n"; }
  // A line of macros, as it is.
  void line(std::string_view macros) { (roff_ += macros) += '\n'; }

  const std::string& roff() const { return roff_; }

 private:
  std::string roff_;
};

// Parts of a line of macros.
std::string mdoc_flag(std::string_view name);  // of an option, without its first hyphen
std::string mdoc_argument(std::string_view name);
std::string mdoc_word(std::string_view word);

}  // namespace lockstep::host
