#include "author/server/features/script_tokens.h"

#include <algorithm>
#include <optional>

#include "author/server/features/names.h"
#include "author/server/features/site.h"
#include "language/expression/token.h"

namespace lockstep::host {
namespace {

enum class TokenType : int { Variable, Number, String, Operator, Parameter, Function };
constexpr const char* kTypes[] = {"variable", "number",    "string",
                                  "operator", "parameter", "function"};

std::optional<TokenType> type_of(Symbol symbol) {
  switch (symbol) {
    case Symbol::End:
    case Symbol::Open:
    case Symbol::Close:
    case Symbol::Semicolon:
      return std::nullopt;
    case Symbol::Whole:
    case Symbol::Real:
      return TokenType::Number;
    case Symbol::Text:
    case Symbol::Word:
      return TokenType::String;
    case Symbol::Reading:
      return TokenType::Function;
    case Symbol::Name:
      return TokenType::Variable;
    default:
      return TokenType::Operator;
  }
}

class TokenWriter {
 public:
  explicit TokenWriter(const Question& question)
      : question_(question), tree_(question.file.tree()) {}

  Json write() {
    const LanguageRules& rules = rules_of(question_);
    for (const TolerantElement& element : tree_.elements) {
      const NodeType* const type = host::type_of(tree_, element, question_.file.analysis->catalog);
      const bool is_node = tree_around(tree_, element) != nullptr;
      for (const TolerantAttribute& it : tree_.attributes_of(element)) {
        if (!it.has_quote) continue;
        if (is_node && is_script(type, it.name, rules)) {
          add_script(it.value);
        } else {
          add_references(it.value, is_node);
        }
      }
    }
    return {{"data", Json::array(encoded())}};
  }

 private:
  struct Found {
    ByteRange range;
    TokenType type;
  };

  void add_script(std::string_view value) {
    const Decoded script = decoded(value);
    const std::size_t begin = tree_.offset_of(value);
    TokenReader reader;
    for (std::size_t offset = 0;;) {
      const auto token = reader.next(script.text, offset);
      if (!token || token->symbol == Symbol::End) return;
      // The offset of the token, which is behind blanks, up to where the next one begins.
      if (const auto type = type_of(token->symbol)) {
        found_.push_back({{begin + script.raw[token->offset], begin + script.raw[offset]}, *type});
      }
    }
  }

  void add_references(std::string_view value, bool is_node) {
    for (auto at = value.find('{'); at != value.npos; at = value.find('{', at + 1)) {
      const auto end = value.find('}', at);
      if (end == value.npos) return;
      const bool is_argument = at > 0 && value[at - 1] == '$';
      const std::size_t begin = tree_.offset_of(value) + at;
      if (is_argument) {
        found_.push_back({{begin - 1, begin + (end - at) + 1}, TokenType::Parameter});
      } else if (is_node && key_in(value)) {
        found_.push_back({{begin, begin + (end - at) + 1}, TokenType::Variable});
      }
    }
  }

  // Each relative to the one before it; none goes over the end of a line.
  std::vector<Json> encoded() const {
    std::vector<Json> data;
    Position before;
    for (const auto& [range, type] : found_) {
      const Position begin = question_.file.positions().position_of(range.begin);
      const Position end = question_.file.positions().position_of(range.end);
      if (begin.line != end.line || end.character == begin.character) continue;
      const bool is_same_line = begin.line == before.line;
      data.emplace_back(begin.line - before.line);
      data.emplace_back(begin.character - (is_same_line ? before.character : 0));
      data.emplace_back(end.character - begin.character);
      data.emplace_back(static_cast<int>(type));
      data.emplace_back(0);
      before = begin;
    }
    return data;
  }

  const Question& question_;
  const TolerantTree& tree_;
  std::vector<Found> found_;
};

}  // namespace

Json script_tokens(const Question& question) {
  return TokenWriter(question).write();
}

Json script_token_legend() {
  std::vector<Json> types(std::begin(kTypes), std::end(kTypes));
  return {{"tokenTypes", Json::array(std::move(types))}, {"tokenModifiers", Json::array()}};
}

}  // namespace lockstep::host
