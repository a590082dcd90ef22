// Errors, warnings and notes, each with its place. Nothing here prints or throws: the command line
// renders the list.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/message_code.h"

namespace lockstep::host {

// Line and column count from 1, the column in bytes; 0 = not known (the file as a whole).
struct SourceLocation {
  std::string file;
  std::uint32_t line = 0;
  std::uint32_t column = 0;
};

enum class Severity : std::uint8_t { Error, Warning, Note };

// A source line; for a long line, the part around the reported place.
struct Excerpt {
  std::string text = {};
  std::uint32_t column = 1;  // of its first byte

  friend auto operator<=>(const Excerpt&, const Excerpt&) = default;
};

struct Diagnostic {
  Severity severity = Severity::Error;
  SourceLocation location = {};
  std::string message;    // lower case, no full stop, names in single quotes
  std::string hint = {};  // what to do, or ""
  Excerpt excerpt = {};   // no text: there is none
  MessageCode code = {};
};

class Diagnostics {
 public:
  // How many are kept for each severity; the others are only counted.
  static constexpr std::size_t kMaxKept = 1000;

  void add(Diagnostic diagnostic);
  void error(MessageCode code, SourceLocation location, std::string message, std::string hint = {},
             Excerpt excerpt = {});
  void warning(MessageCode code, SourceLocation location, std::string message,
               std::string hint = {});
  void note(MessageCode code, SourceLocation location, std::string message, std::string hint = {});

  bool has_errors() const;
  // True if no more of this severity are kept. Then a message is not needed: count_one() is enough.
  bool is_full(Severity severity) const { return added_[index(severity)] >= kMaxKept; }
  void count_one(Severity severity);
  std::size_t count(Severity severity) const;  // also those that were not kept
  // By file in the order of first mention, then line, then column; equal entries once.
  void sort();
  const std::vector<Diagnostic>& all() const { return all_; }

 private:
  static constexpr std::size_t index(Severity severity) {
    return static_cast<std::size_t>(severity);
  }

  std::vector<Diagnostic> all_;
  std::array<std::size_t, 3> added_{};  // of each severity
  std::array<std::size_t, 3> lost_{};   // of those, not kept
};

std::string_view to_string(Severity severity);

// "file:line:column: error: message [code]", the source line, a caret and the hint, each on its own
// line, ending in a newline. Control characters are made visible. `color` adds ANSI colors.
std::string render(const Diagnostic& diagnostic, bool color);

// `text` without effect on a terminal: control characters and invalid UTF-8 become \xNN or \uNNNN.
std::string printable(std::string_view text);

}  // namespace lockstep::host
