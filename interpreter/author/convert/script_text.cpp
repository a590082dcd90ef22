#include "author/convert/script_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/wording.h"
#include "language/expression/token.h"

namespace lockstep::host {
namespace {

using Converted = tl::expected<std::string, Expression::Error>;

Converted cannot(std::string what, std::string hint, const Token& token) {
  return tl::unexpected(Expression::Error{std::move(what), std::move(hint), token.offset});
}

// Copies the script, but for the tokens that `replace` has another text for: none is the same.
template <class Replace>
Converted convert_tokens(std::string_view script, Replace replace) {
  std::string text;
  std::size_t end = 0;
  TokenReader reader;
  while (true) {
    const std::size_t copied = end;
    end = std::min(script.find_first_not_of(" \t\r\n", end), script.size());
    if (script.substr(end).starts_with("${")) {  // an argument
      end = std::min(script.find('}', end), script.size() - 1) + 1;
      text += script.substr(copied, end - copied);
      continue;
    }
    const auto token = reader.next(script, end);
    if (!token) return tl::unexpected(token.error());
    text += script.substr(copied, token->offset - copied);
    if (token->symbol == Symbol::End) return text;
    const std::string_view written = script.substr(token->offset, end - token->offset);
    Converted other = replace(*token, written);
    if (!other) return other;
    text += *other;
  }
}

}  // namespace

// It has texts in single quotes, and no words for '&&' and '||'.
Converted script_to_theirs(std::string_view script) {
  return convert_tokens(script, [](const Token& token, std::string_view written) -> Converted {
    if (token.symbol == Symbol::Name && token.text == "and") return "&&";
    if (token.symbol == Symbol::Name && token.text == "or") return "||";
    if (token.symbol != Symbol::Text || written.front() == '\'') return std::string(written);
    if (token.text.find('\'') == std::string_view::npos) return fmt::format("'{}'", token.text);
    return cannot(fmt::format("the text {}", brief(written)), "there, a text has no ' in it",
                  token);
  });
}

// Its words 'and' and 'or' are names there, and "@key" is an entry of the main tree.
Converted script_to_ours(std::string_view script, const NumberNames& numbers) {
  return convert_tokens(script, [&](const Token& token, std::string_view written) -> Converted {
    if (token.symbol != Symbol::Name) return std::string(written);
    if (token.text == "and" || token.text == "or") {
      return cannot(fmt::format("an entry called '{}'", token.text), "there it is an operator",
                    token);
    }
    if (token.text.starts_with('@')) {
      return cannot(
          fmt::format("the entry '{}'", brief(token.text)),
          fmt::format("give it to the tree by an attribute of its SubTree: {0}=\"{{{0}}}\"",
                      brief(token.text.substr(1))),
          token);
    }
    if (numbers.has(token.text)) {
      return cannot(fmt::format("the name '{}' of a number", brief(token.text)),
                    fmt::format("write the number that a program registers for it; no port or "
                                "script here makes it an entry, as '{} := 0' does",
                                brief(token.text)),
                    token);
    }
    return std::string(written);
  });
}

}  // namespace lockstep::host
