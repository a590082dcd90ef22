#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "base/core/wording.h"
#include "language/property/formula_parser.h"
#include "language/property/property.h"

namespace lockstep::host {
namespace {

using Kind = PropertyToken::Kind;

constexpr double kMostTicks = 1e9;

// On one line: blanks that are in no quotes become one.
std::string on_one_line(std::string_view text) {
  std::string line;
  char quote = '\0';
  for (const char c : text) {
    const bool is_blank = c == ' ' || c == '\t' || c == '\r' || c == '\n';
    if (quote == '\0' && is_blank) {
      if (!line.empty() && line.back() != ' ') line += ' ';
      continue;
    }
    if (quote == '\0' && (c == '\'' || c == '"')) {
      quote = c;
    } else if (c == quote) {
      quote = '\0';
    }
    line += c;
  }
  if (line.ends_with(' ')) line.pop_back();
  return line;
}

}  // namespace

// Parses everything around formulas: the pattern and its limit.
class PropertyParser {
 public:
  PropertyParser(std::string_view text, const PropertyNames& names)
      : text_(text), parser_(text, names, property_.formula_) {}

  Property parse() {
    std::string_view name = take_name();
    property_.text_ = on_one_line(text_.substr(parser_.token().offset));
    property_.name_ = name.empty() ? property_.text_ : std::string(name);
    pattern();
    if (parser_.token().kind != Kind::End) {
      parser_.expected("the end", "join what holds in a tick with and, or");
    }
    property_.choose_state();
    return std::move(property_);
  }

 private:
  using Pattern = Property::Pattern;

  // "grip:" before the pattern; "" if there is none.
  std::string_view take_name() {
    std::size_t offset = 0;
    const auto first = next_property_token(text_, offset);
    if (!first || (first->kind != Kind::Word && first->kind != Kind::Quoted)) return {};
    const auto second = next_property_token(text_, offset);
    if (!second || second->kind != Kind::Colon) return {};
    parser_.take();
    parser_.take();
    return first->text;
  }

  void pattern() {
    if (parser_.take_word("never")) return only_left(Pattern::Never);
    if (parser_.take_word("sometimes")) return only_left(Pattern::Sometimes);
    if (parser_.take_word("finally")) return only_left(Pattern::Finally);
    const bool is_after = parser_.take_word("after");
    property_.left_ = parser_.formula();
    if (is_after) {
      if (!parser_.take_word("never")) parser_.expected("'and', 'or' or 'never'");
      return both(Pattern::AfterNever);
    }
    if (parser_.take_word("leads")) return leads_to();
    if (parser_.take_word("only")) {
      need("after");
      return both(Pattern::OnlyAfter);
    }
    if (parser_.take_word("at")) {
      need("most");
      property_.pattern_ = Pattern::AtMost;
      return ticks();
    }
    if (parser_.take_word("until")) return both(Pattern::Until);
    parser_.expected("'and', 'or', 'leads to', 'only after', 'at most' or 'until'",
                     "a condition of a tick is not a property yet; or write 'never', 'sometimes' "
                     "or 'finally' before it, or 'after' before it and 'never' behind it");
  }

  void need(std::string_view word) {
    if (!parser_.take_word(word)) parser_.expected(fmt::format("'{}'", word));
  }

  void only_left(Pattern pattern) {
    property_.pattern_ = pattern;
    property_.left_ = parser_.formula();
  }

  void both(Pattern pattern) {
    property_.pattern_ = pattern;
    property_.right_ = parser_.formula();
  }

  void leads_to() {
    need("to");
    both(Pattern::LeadsTo);
    if (!parser_.take_word("within")) return;
    property_.has_limit_ = true;
    ticks();
  }

  // "20 ticks"
  void ticks() {
    const PropertyToken number = parser_.token();
    if (number.kind != Kind::Number) parser_.expected("a number of ticks");
    if (!(number.number >= 0) || number.number > kMostTicks ||
        number.number != std::floor(number.number)) {
      throw PropertyError{fmt::format("'{}' is not a number of ticks", brief(number.text)),
                          "write a whole number from 0 to 1000000000", number.offset};
    }
    parser_.take();
    property_.ticks_ = static_cast<std::uint32_t>(number.number);
    if (!parser_.take_word("ticks") && !parser_.take_word("tick")) {
      parser_.expected("'ticks'", "limits are in ticks of the tree");
    }
  }

  std::string_view text_;
  Property property_;
  FormulaParser parser_;
};

Property::Parsed Property::parse(std::string_view text, const PropertyNames& names) {
  try {
    return PropertyParser(text, names).parse();
  } catch (PropertyError& error) {
    return tl::unexpected(std::move(error));
  }
}

}  // namespace lockstep::host
