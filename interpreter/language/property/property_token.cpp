#include "language/property/property_token.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "base/core/utf8.h"
#include "base/core/value.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

using Kind = PropertyToken::Kind;
using TokenResult = tl::expected<PropertyToken, PropertyError>;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
// The characters of a node's name that needs no quotes.
bool is_of_word(char c) {
  return is_letter(c) || is_digit(c) || c == '-' || c == '#' || c == '/' || c == '.' ||
         static_cast<unsigned char>(c) >= 0x80;
}

// The longer ones first.
constexpr std::pair<std::string_view, Relation> kRelations[] = {
    {"==", Relation::Equal},        {"!=", Relation::NotEqual}, {"<=", Relation::LessEqual},
    {">=", Relation::GreaterEqual}, {"<", Relation::Less},      {">", Relation::Greater},
};

// Words of other languages, and our words for them.
constexpr std::pair<std::string_view, std::string_view> kForeign[] = {
    {"&&", "write 'and'"}, {"&", "write 'and'"},
    {"||", "write 'or'"},  {"|", "write 'or'"},
    {"!", "write 'not'"},  {"->", "write 'leads to'"},
    {"=", "write '=='"},   {"{", "write {key} on one line, with a name in it"}};

class PropertyLexer {
 public:
  PropertyLexer(std::string_view all, std::size_t offset)
      : text_(all.substr(offset)), offset_(offset) {}

  TokenResult read() {
    if (text_.empty()) return take(Kind::End, 0);
    const char first = text_.front();
    if (first == '(') return take(Kind::Open, 1);
    if (first == ')') return take(Kind::Close, 1);
    if (first == ':') return take(Kind::Colon, 1);
    if (first == '\'' || first == '"') return enclosed(Kind::Quoted, first);
    if (first == '{' && text_.find('}') != std::string_view::npos) return enclosed(Kind::Key, '}');
    for (const auto& [symbol, relation] : kRelations) {
      if (!text_.starts_with(symbol)) continue;
      PropertyToken token = take(Kind::Relation, symbol.size());
      token.relation = relation;
      return token;
    }
    if (const std::size_t length = number_length(); length > 0) return number(length);
    if (first == '.') return field();
    if (is_of_word(first) && !text_.starts_with("->")) return word();
    return unexpected();
  }
  std::size_t end() const { return offset_ + length_; }

 private:
  PropertyToken take(Kind kind, std::size_t length) {
    length_ = length;
    return {.kind = kind, .text = text_.substr(0, length), .offset = offset_};
  }

  TokenResult fail(std::string message, std::string hint = {}) const {
    return tl::unexpected(PropertyError{std::move(message), std::move(hint), offset_});
  }

  TokenResult enclosed(Kind kind, char last) {
    const auto end = text_.find(last, 1);
    if (end == std::string_view::npos) {
      return fail(fmt::format("the name that begins with {} does not end", last),
                  fmt::format("close it with {}", last));
    }
    PropertyToken token = take(kind, end + 1);
    token.text = text_.substr(1, end - 1);
    return token;
  }

  std::size_t digits_at(std::size_t from) const {
    std::size_t length = from;
    while (length < text_.size() && is_digit(text_[length])) ++length;
    return length - from;
  }

  // 0: what is here is no number, but may be the name of a node ("2nd").
  std::size_t number_length() const {
    std::size_t length = text_.front() == '-' ? 1 : 0;
    const std::size_t whole = digits_at(length);
    if (whole == 0) return 0;
    length += whole;
    if (length < text_.size() && text_[length] == '.') {
      if (const std::size_t decimals = digits_at(length + 1); decimals > 0) length += 1 + decimals;
    }
    if (length < text_.size() && (text_[length] == 'e' || text_[length] == 'E')) {
      const bool has_sign =
          length + 1 < text_.size() && (text_[length + 1] == '-' || text_[length + 1] == '+');
      const std::size_t exponent = digits_at(length + 1 + (has_sign ? 1 : 0));
      if (exponent > 0) length += 1 + (has_sign ? 1 : 0) + exponent;
    }
    return length < text_.size() && is_of_word(text_[length]) ? 0 : length;
  }

  TokenResult number(std::size_t length) {
    PropertyToken token = take(Kind::Number, length);
    const auto value = parse_double(token.text);
    if (!value) return fail(fmt::format("{} is too large", brief(token.text)));
    token.number = *value;
    return token;
  }

  TokenResult field() {
    std::size_t length = 1;
    while (length < text_.size() && is_letter(text_[length])) ++length;
    PropertyToken token = take(Kind::Field, length);
    token.text.remove_prefix(1);
    ++token.offset;
    return token;
  }

  TokenResult word() {
    std::size_t length = 1;
    while (length < text_.size() && is_of_word(text_[length])) ++length;
    return take(Kind::Word, length);
  }

  TokenResult unexpected() const {
    const auto* const foreign = std::ranges::find_if(
        kForeign, [this](const auto& it) { return text_.starts_with(it.first); });
    if (foreign != std::end(kForeign)) {
      return fail(fmt::format("unexpected '{}'", foreign->first), std::string(foreign->second));
    }
    const std::size_t length = std::max<std::size_t>(utf8_length(text_), 1);
    return fail(fmt::format("unexpected '{}'", brief(text_.substr(0, length))),
                "the path of a node that has other characters than letters, digits and - _ . # / "
                "is in quotes: 'pick up'.running");
  }

  std::string_view text_;
  std::size_t offset_;
  std::size_t length_ = 0;
};

}  // namespace

bool needs_quotes(std::string_view name) {
  return !std::ranges::all_of(name, is_of_word);
}

tl::expected<PropertyToken, PropertyError> next_property_token(std::string_view text,
                                                               std::size_t& offset) {
  offset = std::min(text.find_first_not_of(" \t\n\r", offset), text.size());
  PropertyLexer lexer(text, offset);
  auto token = lexer.read();
  if (token) offset = lexer.end();
  return token;
}

}  // namespace lockstep::host
