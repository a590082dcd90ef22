#include "author/server/features/actions.h"

#include <fmt/format.h>

#include <algorithm>

#include "author/edit/file_text.h"
#include "author/server/diagnostics_json.h"
#include "author/server/features/names.h"
#include "author/server/features/refactorings.h"
#include "author/server/features/site.h"
#include "author/server/features/workspace_edit.h"
#include "language/document/lines.h"
#include "language/document/value_text.h"

namespace lockstep::host {
namespace {

// The words between single quotes of a message.
std::vector<std::string_view> quoted_words(std::string_view message) {
  std::vector<std::string_view> words;
  while (true) {
    const auto open = message.find('\'');
    const auto close = open == message.npos ? open : message.find('\'', open + 1);
    if (close == message.npos) return words;
    words.push_back(message.substr(open + 1, close - open - 1));
    message.remove_prefix(close + 1);
  }
}

// The word behind `sign` in a text, up to the quote that closes it; "" when it is not there.
std::string_view word_behind(std::string_view text, std::string_view sign) {
  const auto at = text.find(sign);
  if (at == text.npos) return {};
  text.remove_prefix(at + sign.size());
  return text.substr(0, text.find('\''));
}

class Fixes {
 public:
  explicit Fixes(const Question& question)
      : question_(question),
        tree_(question.file.tree()),
        // The places of messages are those without a byte order mark.
        mark_(byte_order_mark(tree_.text).size()),
        lines_(tree_.text.substr(mark_)) {}

  std::vector<Json> all() {
    const Positions& positions = question_.file.positions();
    ByteRange wanted{0, tree_.text.size()};
    if (const auto& range = question_.params.range)
      wanted = {positions.byte_at(range->first), positions.byte_at(range->second)};
    for (const Diagnostic& it : question_.file.analysis->diagnostics) {
      if (it.location.file != question_.file.path) continue;
      ByteRange place = range_of(tree_.text.substr(mark_), lines_, it.location);
      place = {place.begin + mark_, place.end + mark_};
      if (place.end < wanted.begin || place.begin > wanted.end) continue;
      replace_word(it, place);
      add_missing(it, place);
    }
    return std::move(actions_);
  }

 private:
  void add(std::string title, const TextEdit& edit) {
    Json change = workspace_edit(question_,
                                 {{question_.file.uri, json_of(edit, question_.file.positions())}});
    actions_.push_back(Json{{"title", std::move(title)},
                            {"kind", "quickfix"},
                            {"isPreferred", true},
                            {"edit", std::move(change)}});
  }

  void replace_word(const Diagnostic& message, ByteRange place) {
    const std::string_view right = word_behind(message.hint, "did you mean '");
    if (right.empty()) return;
    for (const std::string_view wrong : quoted_words(message.message)) {
      const auto found = find_word(wrong, place);
      if (!found) continue;
      TextEdit edit;
      edit.replace(found->begin, found->end, escaped(right));
      add_end_tag(*found, right, edit);
      return add(fmt::format("Replace '{}' by '{}'", wrong, right), edit);
    }
  }

  // In the tag or the value that begins there.
  std::optional<ByteRange> find_word(std::string_view word, ByteRange place) const {
    // A path has the names of trees before that of the entry.
    for (const std::string_view it : {word, word.substr(word.rfind('/') + 1)}) {
      const std::string_view there = tree_.text.substr(place.begin, place.end - place.begin);
      const auto at = there.find(it);
      if (!it.empty() && at != there.npos)
        return ByteRange{place.begin + at, place.begin + at + it.size()};
    }
    return std::nullopt;
  }

  void add_end_tag(ByteRange name, std::string_view right, TextEdit& edit) const {
    const TolerantElement* const element = tree_.at(name.begin);
    if (element == nullptr || range_of(tree_, element->tag) != name) return;
    if (element->close == element->end) return;
    const std::size_t begin = element->close + 2;
    edit.replace(begin, begin + element->tag.size(), std::string(right));
  }

  void add_missing(const Diagnostic& message, ByteRange place) {
    std::string_view name = word_behind(message.message, "needs the parameter '");
    if (name.empty()) name = word_behind(message.message, "needs the attribute '");
    const TolerantElement* const element = tree_.at(place.begin + 1);
    if (name.empty() || element == nullptr || element->begin != place.begin) return;
    std::size_t end = tree_.offset_of(element->tag) + element->tag.size();
    for (const TolerantAttribute& it : tree_.attributes_of(*element))
      end = range_of(tree_, it.value).end + 1;
    const std::string text = fmt::format("{}={}", name, host::quoted(value_for(*element, name)));
    TextEdit edit;
    edit.insert(end, " " + text);
    add(fmt::format("Add {}", text), edit);
  }

  // One that the check accepts where that is possible.
  std::string value_for(const TolerantElement& element, std::string_view name) const {
    if (name == "lockstep") return "1";
    const Parameter* const it =
        parameter_of(type_of(tree_, element, question_.file.analysis->catalog), name);
    if (it == nullptr) return "";
    if (it->direction != Direction::Input) return fmt::format("{{{}}}", name);
    if (!it->choices.empty()) return std::string(it->choices.front());
    switch (it->type) {
      case ValueType::Bool:
        return "true";
      case ValueType::Number:
      case ValueType::Int:
      case ValueType::Double:
        return it->range.min > 1   ? fmt::format("{}", it->range.min)
               : it->range.max < 1 ? fmt::format("{}", it->range.max)
                                   : "1";
      default:
        return "";
    }
  }

  const Question& question_;
  const TolerantTree& tree_;
  std::size_t mark_;
  LineIndex lines_;
  std::vector<Json> actions_;
};

}  // namespace

bool is_wanted(std::string_view kind, const std::vector<std::string>& kinds) {
  return kinds.empty() || std::ranges::any_of(kinds, [&](std::string_view it) {
           const bool begins = it.empty() || kind.starts_with(it);
           return begins && (it.empty() || it.size() == kind.size() || kind[it.size()] == '.');
         });
}

Json code_actions(const Question& question) {
  std::vector<Json> actions;
  if (is_wanted("quickfix", question.params.kinds)) actions = Fixes(question).all();
  for (Json& it : refactorings(question)) actions.push_back(std::move(it));
  return Json::array(std::move(actions));
}

}  // namespace lockstep::host
