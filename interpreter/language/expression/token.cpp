#include "language/expression/token.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

#include "base/core/suggest.h"
#include "base/core/utf8.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

using TokenResult = tl::expected<Token, Expression::Error>;

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::string_view kDigits = "0123456789";
constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";

bool is_digit(char c) {
  return kDigits.find(c) != std::string_view::npos;
}
bool is_letter(char c) {
  return kLetters.find(c) != std::string_view::npos;
}

// The longer ones first.
constexpr std::pair<std::string_view, Symbol> kSymbols[] = {
    {"&&", Symbol::And},        {"||", Symbol::Or},        {"==", Symbol::Equal},
    {"!=", Symbol::NotEqual},   {"<=", Symbol::LessEqual}, {">=", Symbol::GreaterEqual},
    {":=", Symbol::Make},       {"+=", Symbol::AddTo},     {"-=", Symbol::SubtractFrom},
    {"*=", Symbol::MultiplyBy}, {"/=", Symbol::DivideBy},  {"..", Symbol::Join},
    {"+", Symbol::Plus},        {"-", Symbol::Minus},      {"*", Symbol::Times},
    {"/", Symbol::Divided},     {"&", Symbol::BitAnd},     {"|", Symbol::BitOr},
    {"^", Symbol::BitXor},      {"~", Symbol::Complement}, {"!", Symbol::Not},
    {"<", Symbol::Less},        {">", Symbol::Greater},    {"=", Symbol::Assign},
    {"?", Symbol::Question},    {":", Symbol::Colon},      {"(", Symbol::Open},
    {")", Symbol::Close},       {";", Symbol::Semicolon},
};

std::size_t digits_at(std::string_view text, std::size_t from) {
  return std::min(text.find_first_not_of(kDigits, from), text.size()) - from;
}

// "e5", "E+05" at `from`: its length, or 0.
std::size_t exponent_at(std::string_view text, std::size_t from) {
  if (from >= text.size() || (text[from] != 'e' && text[from] != 'E')) return 0;
  std::size_t sign = 0;
  if (from + 1 < text.size() && (text[from + 1] == '+' || text[from + 1] == '-')) sign = 1;
  const std::size_t digits = digits_at(text, from + 1 + sign);
  return digits == 0 ? 0 : 1 + sign + digits;
}

// Reads one token from the text behind the blanks.
class Lexer {
 public:
  Lexer(std::string_view script, std::size_t offset)
      : text_(script.substr(offset)), offset_(offset) {}

  TokenResult read() {
    if (text_.empty()) return take(Symbol::End, 0);
    const char first = text_.front();
    if (first == '\'' || first == '"') return quoted(first);
    if (is_digit(first)) return number();
    if (is_letter(first) || first == '@') return name();
    for (const auto& [symbol, kind] : kSymbols) {
      if (text_.starts_with(symbol)) return take(kind, symbol.size());
    }
    return unexpected();
  }
  std::size_t end() const { return offset_ + length_; }

 private:
  Token take(Symbol symbol, std::size_t length) {
    length_ = length;
    return {.symbol = symbol, .text = text_.substr(0, length), .offset = offset_};
  }

  TokenResult fail(std::string message, std::string hint = {}) const {
    return tl::unexpected(Expression::Error{std::move(message), std::move(hint), offset_});
  }

  TokenResult quoted(char quote) {
    const auto end = text_.find(quote, 1);
    if (end == std::string_view::npos) {
      return fail(fmt::format("the text that begins with {} does not end", quote),
                  fmt::format("close it with {}", quote));
    }
    Token token = take(Symbol::Text, end + 1);
    token.text = text_.substr(1, end - 1);
    return token;
  }

  TokenResult name() {
    std::size_t length = 1;
    while (length < text_.size() && (is_letter(text_[length]) || is_digit(text_[length]))) ++length;
    const auto* const row =
        std::ranges::find(kReadings, text_.substr(0, length), &ReadingRow::name);
    const std::size_t open = text_.find_first_not_of(kBlanks, length);
    const bool is_reading =
        row != kReadings.end() && text_.substr(std::min(open, text_.size())).starts_with('(');
    return is_reading ? reading(*row, open) : take(Symbol::Name, length);
  }

  // progress(arm/lift), progress('Main/reach (left)')
  TokenResult reading(const ReadingRow& row, std::size_t open) {
    const bool is_owner = row.what == Reading::What::Owner;
    std::size_t begin = std::min(text_.find_first_not_of(kBlanks, open + 1), text_.size());
    const std::string_view first = text_.substr(begin, 1);
    const bool is_quoted = first == "'" || first == "\"";
    std::size_t end = text_.find(is_quoted ? first : ")", begin + (is_quoted ? 1 : 0));
    std::size_t close = end;
    if (is_quoted && end != std::string_view::npos)
      close = text_.find_first_not_of(kBlanks, end + 1);
    if (close == std::string_view::npos || text_[close] != ')') {
      return fail(
          fmt::format("')' is missing after '{}('", row.name),
          fmt::format("write {}({}), or the name in quotes", row.name, is_owner ? "dock" : "arm"));
    }
    begin += is_quoted ? 1 : 0;
    while (!is_quoted && end > begin && kBlanks.find(text_[end - 1]) != std::string_view::npos)
      --end;
    if (begin == end) {
      return fail(fmt::format("'{}()' does not name a node or a pool", row.name),
                  is_owner ? "write a resource: owner(dock)"
                           : fmt::format("write a node: {}(arm)", row.name));
    }
    Token token = take(Symbol::Reading, close + 1);
    token.text = text_.substr(begin, end - begin);
    token.reading = row.what;
    return token;
  }

  TokenResult number() {
    if (text_.starts_with("0x") || text_.starts_with("0X")) return hexadecimal();
    std::size_t length = digits_at(text_, 0);
    bool is_real = false;
    const bool has_point = length < text_.size() && text_[length] == '.';
    if (has_point && !text_.substr(length).starts_with("..")) {
      const std::size_t decimals = digits_at(text_, length + 1);
      if (decimals == 0) return malformed(length + 1, "write digits after the point: 5.0");
      is_real = true;
      length += 1 + decimals;
    }
    const std::size_t exponent = exponent_at(text_, length);
    length += exponent;
    if (is_continued(length)) return malformed(length, {});
    return is_real || exponent > 0 ? real(length) : whole(0, length, 10);
  }

  TokenResult hexadecimal() {
    constexpr std::string_view kHex = "0123456789abcdefABCDEF";
    const auto length = std::min(text_.find_first_not_of(kHex, 2), text_.size());
    if (length == 2 || is_continued(length)) {
      return malformed(length, "a hexadecimal number is 0x and digits from 0 to f");
    }
    return whole(2, length, 16);
  }

  bool is_continued(std::size_t length) const {
    return length < text_.size() && (is_letter(text_[length]) || is_digit(text_[length]));
  }

  TokenResult malformed(std::size_t length, std::string hint) const {
    while (is_continued(length)) ++length;
    return fail(fmt::format("'{}' is not a number", brief(text_.substr(0, length))),
                std::move(hint));
  }

  TokenResult whole(std::size_t from, std::size_t length, int base) {
    Token token = take(Symbol::Whole, length);
    const char* const end = text_.data() + length;
    const auto [rest, error] = std::from_chars(text_.data() + from, end, token.whole, base);
    if (error == std::errc() && rest == end) return token;
    return fail(fmt::format("{} is too large", brief(token.text)),
                "whole numbers go up to 9223372036854775807");
  }

  TokenResult real(std::size_t length) {
    Token token = take(Symbol::Real, length);
    const auto [rest, error] = std::from_chars(text_.data(), text_.data() + length, token.real);
    if (error == std::errc()) return token;
    if (is_small(token.text)) return token;  // as 0
    return fail(fmt::format("{} is too large", brief(token.text)),
                "numbers go up to about 1.8e308");
  }

  // For a number that no double is near to: whether it is close to 0.
  static bool is_small(std::string_view number) {
    const auto mark = std::min(number.find_first_of("eE"), number.size());
    const std::string_view digits = number.substr(0, mark);
    if (digits.find_first_not_of("0.") == std::string_view::npos) return true;
    const auto point = static_cast<std::ptrdiff_t>(std::min(digits.find('.'), digits.size()));
    const auto first = static_cast<std::ptrdiff_t>(digits.find_first_not_of("0."));
    std::ptrdiff_t exponent = 0;
    if (mark < number.size()) {
      const bool is_negative = number[mark + 1] == '-';
      const std::size_t sign = is_negative || number[mark + 1] == '+' ? 1 : 0;
      const auto [end, error] =
          std::from_chars(number.data() + mark + 1 + sign, number.data() + number.size(), exponent);
      if (error != std::errc()) return is_negative;
      if (is_negative) exponent = -exponent;
    }
    return exponent < first - point;
  }

  TokenResult unexpected() const {
    if (text_.size() > 1 && text_.front() == '.' && is_letter(text_[1])) {
      return fail("unexpected '.'",
                  "a script reads a node as progress(NODE), status(NODE), held(NODE)");
    }
    if (text_.front() == '.') {
      return fail("a number does not begin with a point", "write 0.5; '..' joins texts");
    }
    if (text_.front() == '{') return fail("unexpected '{'", "write the name of an entry alone");
    const std::size_t length = std::max<std::size_t>(utf8_length(text_), 1);
    return fail(fmt::format("unexpected '{}'", brief(text_.substr(0, length))),
                "texts are in quotes; names have letters from a to z, digits and _");
  }

  std::string_view text_;
  std::size_t offset_;
  std::size_t length_ = 0;
};

// What is compared with a status or an owner without quotes: a word of it, in any case, as trees
// for BehaviorTree.CPP have RUNNING.
TokenResult word(const Token& name, Reading::What what) {
  std::string small(name.text);
  std::ranges::transform(small, small.begin(), [](char c) {
    return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  std::vector<std::string_view> words{kNoOwner};
  if (what == Reading::What::Status) {
    words.clear();
    for (const StatusRow& row : kStatuses) words.push_back(row.name);
  }
  const auto found = std::ranges::find(words, small);
  if (found != words.end()) {
    return Token{.symbol = Symbol::Word, .text = *found, .offset = name.offset};
  }
  const bool is_status = what == Reading::What::Status;
  return tl::unexpected(Expression::Error{
      fmt::format("'{}' is no {}", brief(name.text), is_status ? "status" : "owner"),
      is_status ? suggest(name.text, words, "the statuses")
                : "compare with none, or with the path of a UseResources in quotes",
      name.offset});
}

}  // namespace

TokenResult TokenReader::next(std::string_view script, std::size_t& offset) {
  offset = std::min(script.find_first_not_of(kBlanks, offset), script.size());
  Lexer lexer(script, offset);
  auto token = lexer.read();
  offset = lexer.end();
  if (!token) return token;
  const auto compared = std::exchange(compared_, std::nullopt);
  if (compared && token->symbol == Symbol::Name) return word(*token, *compared);
  const bool compares = token->symbol == Symbol::Equal || token->symbol == Symbol::NotEqual;
  if (compares) compared_ = read_;
  read_.reset();
  const bool has_words =
      token->reading == Reading::What::Status || token->reading == Reading::What::Owner;
  if (token->symbol == Symbol::Reading && has_words) read_ = token->reading;
  return token;
}

}  // namespace lockstep::host
