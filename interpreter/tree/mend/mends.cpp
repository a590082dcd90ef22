#include "tree/mend/mends.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/core/identifier.h"
#include "base/core/typo.h"
#include "language/document/byte_order_mark.h"
#include "language/document/value_text.h"
#include "tree/mend/element_type.h"

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

std::string_view behind(const std::string& text, std::string_view before) {
  const auto at = text.find(before);
  return at == text.npos ? std::string_view() : std::string_view(text).substr(at + before.size());
}

std::string_view between(const std::string& text, std::string_view before, std::string_view after) {
  const std::string_view rest = behind(text, before);
  const auto end = rest.find(after);
  return end == rest.npos ? std::string_view() : rest.substr(0, end);
}

std::string_view rest_of_line(const std::string& text, std::string_view before) {
  const std::string_view rest = behind(text, before);
  return rest.substr(0, rest.find('\n'));
}

// What they return is a part of the text, which must live as long.
std::string_view behind(std::string&& text, std::string_view before) = delete;
std::string_view between(std::string&& text, std::string_view before,
                         std::string_view after) = delete;
std::string_view rest_of_line(std::string&& text, std::string_view before) = delete;

bool is_of_word(char it) {
  return is_identifier(std::string_view(&it, 1)) || (it >= '0' && it <= '9');
}

// Not as a part of a longer word.
std::size_t find_whole(std::string_view text, std::string_view word) {
  if (word.empty()) return text.npos;
  for (auto at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || !is_of_word(text[at - 1]) || !is_of_word(word.front());
    const bool ends = end == text.size() || !is_of_word(text[end]) || !is_of_word(word.back());
    if (begins && ends) return at;
  }
  return text.npos;
}

// A long name has only its first letters in a message.
bool is_cut(std::string_view word) {
  return word.ends_with("\u2026");
}

class Mending {
 public:
  Mending(const TolerantTree& tree, const Catalog& catalog, const Diagnostic& message,
          ByteRange place)
      : tree_(tree), catalog_(catalog), message_(message), place_(place) {}

  std::vector<Mend> all() {
    if (tree_.text.empty()) return {};
    replace_word();
    using Way = void (Mending::*)();
    struct Row {
      std::string_view code;
      Way way;
    };
    static constexpr Row kRows[] = {
        {"assigning-condition", &Mending::compare},
        {"bad-key", &Mending::join_words},
        {"bad-name", &Mending::join_words},
        {"bad-value", &Mending::replace_value},
        {"child-count", &Mending::mend_children},
        {"empty-tree", &Mending::put_child},
        {"fixed-parameter", &Mending::replace_value},
        {"ignored-attribute", &Mending::remove_attribute},
        {"missing-attribute", &Mending::add_missing},
        {"missing-port", &Mending::add_missing},
        {"needs-entry", &Mending::name_entry},
        {"no-main-tree", &Mending::choose_tree},
        {"old-model", &Mending::replace_value},
        {"unknown-attribute", &Mending::remove_attribute},
        {"unknown-group", &Mending::declare_group},
        {"unknown-port", &Mending::remove_attribute},
        {"unknown-tree", &Mending::take_known},
        {"unknown-version", &Mending::write_version},
        {"wrong-category", &Mending::write_category},
        {"wrong-language", &Mending::choose_language},
        {"xml-syntax", &Mending::close_element},
    };
    for (const Row& row : kRows)
      if (row.code == message_.code.text()) (this->*row.way)();
    return std::move(mends_);
  }

 private:
  enum class Sure : bool { No, Yes };

  void add(std::string title, TextEdit edit, Sure sure) {
    mends_.push_back({std::move(title), std::move(edit), sure == Sure::Yes});
  }

  // The element in whose start tag the message is.
  const TolerantElement* element() const {
    const TolerantElement* const it = tree_.at(std::min(place_.begin + 1, tree_.text.size()));
    return it != nullptr && place_.begin >= it->begin && place_.begin < it->tag_end ? it : nullptr;
  }

  const TolerantElement* element_that_begins_here() const {
    const TolerantElement* const it = element();
    return it != nullptr && it->begin == place_.begin ? it : nullptr;
  }

  // Whose name or value the message is about.
  const TolerantAttribute* attribute() const {
    const TolerantElement* const it = element();
    if (it == nullptr) return nullptr;
    for (const TolerantAttribute& each : tree_.attributes_of(*it)) {
      const std::size_t end = range_of(tree_, each.value).end;
      if (each.is_closed && place_.begin >= each.begin && place_.begin <= end) return &each;
    }
    return nullptr;
  }

  // "did you mean 'a', 'b'?"
  void replace_word() {
    const auto rights = quoted_words(between(message_.hint, "did you mean ", "?"));
    for (const std::string_view right : rights) {
      if (is_cut(right)) continue;
      const bool is_only = rights.size() == 1 && message_.severity == Severity::Error;
      for (const std::string_view wrong : quoted_words(message_.message)) {
        const auto found = find_word(wrong);
        if (!found) continue;
        TextEdit edit;
        edit.replace(found->begin, found->end, escaped(right));
        add_end_tag(*found, right, edit);
        const auto there = tree_.text.substr(found->begin, found->end - found->begin);
        add(fmt::format("Replace '{}' by '{}'", there, right), std::move(edit),
            is_only && is_slip_of(there, right) ? Sure::Yes : Sure::No);
        break;
      }
    }
  }

  // In the tag or the value that begins there.
  std::optional<ByteRange> find_word(std::string_view word) const {
    // A path has the names of trees before that of the entry. A SubTree has the key as a name.
    const bool is_entry = word.size() > 2 && word.front() == '{' && word.back() == '}';
    for (const std::string_view it : {word, word.substr(word.rfind('/') + 1),
                                      is_entry ? word.substr(1, word.size() - 2) : ""}) {
      const std::string_view there = tree_.text.substr(place_.begin, place_.end - place_.begin);
      const auto at = find_whole(there, it);
      if (at != there.npos) return ByteRange{place_.begin + at, place_.begin + at + it.size()};
    }
    return find_in_values(word);
  }

  // A message about an element may be about one of its values.
  std::optional<ByteRange> find_in_values(std::string_view word) const {
    const TolerantElement* const it = element_that_begins_here();
    if (it == nullptr || word.empty()) return std::nullopt;
    for (const TolerantAttribute& each : tree_.attributes_of(*it)) {
      if (each.value != word) continue;
      return range_of(tree_, each.value);
    }
    return std::nullopt;
  }

  void add_end_tag(ByteRange name, std::string_view right, TextEdit& edit) const {
    const TolerantElement* const it = tree_.at(name.begin);
    if (it == nullptr || range_of(tree_, it->tag) != name) return;
    if (it->close == it->end) return;
    const std::size_t begin = it->close + 2;
    edit.replace(begin, begin + it->tag.size(), std::string(right));
  }

  void add_missing() {
    const TolerantElement* const it = element_that_begins_here();
    for (const std::string_view kind : {"parameter '", "port '", "attribute '"}) {
      const auto missing = between(message_.message, fmt::format("needs the {}", kind), "'");
      if (missing.empty() || is_cut(missing) || it == nullptr) continue;
      const std::string value = missing == "ID" ? id_for(*it) : value_for(*it, missing);
      if (value.empty() && kind.starts_with("attribute")) continue;
      add_attribute(*it, missing, value, missing == "lockstep" ? Sure::Yes : Sure::No);
    }
  }

  // Of a tree that has none, or of the one that a SubTree may mean; "": there are several, or none.
  std::string id_for(const TolerantElement& of) const {
    const TolerantElement* const around = tree_around(of);
    std::vector<std::string_view> ids;
    for (const TolerantElement& it : tree_.elements) {
      const std::string_view id = tree_.value_of(it, "ID");
      if (it.tag == "BehaviorTree" && &it != around && !id.empty()) ids.push_back(id);
    }
    if (of.tag == "SubTree") return ids.size() == 1 ? std::string(ids.front()) : "";
    const bool is_main = of.tag == "BehaviorTree" && std::ranges::find(ids, "Main") == ids.end();
    return is_main ? "Main" : "";
  }

  const TolerantElement* tree_around(const TolerantElement& of) const {
    const TolerantElement* it = &of;
    while (it != nullptr && it->tag != "BehaviorTree") it = tree_.parent_of(*it);
    return it;
  }

  void add_attribute(const TolerantElement& to, std::string_view name, std::string_view value,
                     Sure sure) {
    std::size_t end = tree_.offset_of(to.tag) + to.tag.size();
    for (const TolerantAttribute& it : tree_.attributes_of(to))
      end = range_of(tree_, it.value).end + 1;
    const std::string text = fmt::format("{}={}", name, host::quoted(value));
    TextEdit edit;
    edit.insert(end, " " + text);
    add(fmt::format("Add {}", text), std::move(edit), sure);
  }

  // One that the check accepts where that is possible.
  std::string value_for(const TolerantElement& of, std::string_view name) const {
    if (name == "lockstep") return "1";
    const Parameter* const it = parameter_of(type_of(tree_, of, catalog_), name);
    return it == nullptr ? "" : value_for(*it);
  }

  static std::string value_for(const Parameter& it) {
    if (it.direction != Direction::Input) return fmt::format("{{{}}}", it.name);
    if (!it.choices.empty()) return std::string(it.choices.front());
    switch (it.type) {
      case ValueType::Bool:
        return "true";
      case ValueType::Number:
      case ValueType::Int:
      case ValueType::Double:
        return it.range.min > 1   ? fmt::format("{}", it.range.min)
               : it.range.max < 1 ? fmt::format("{}", it.range.max)
                                  : "1";
      default:
        return "";
    }
  }

  void set_value(const TolerantAttribute& of, std::string_view value, Sure sure) {
    const ByteRange there = range_of(tree_, of.value);
    if (of.value == value) return;
    TextEdit edit;
    edit.replace(there.begin, there.end, escaped(value));
    add(fmt::format("Write {}={}", of.name, host::quoted(value)), std::move(edit), sure);
  }

  // "0.5" of "0.5m" and of "x0.5"; also a list.
  static std::string number_in(std::string_view value) {
    std::string number;
    for (const char it : value)
      if ((it >= '0' && it <= '9') || std::string_view(".;-").find(it) != std::string_view::npos)
        number += it;
    return number.find_first_of("0123456789") == std::string::npos ? "" : number;
  }

  void replace_value() {
    const TolerantAttribute* const it = attribute();
    if (it == nullptr || !mends_.empty()) return;
    const auto right = between(message_.hint, "write '", "'");
    if (!right.empty() && !is_cut(right)) set_value(*it, right, Sure::No);
    const Parameter parameter = parameter_for(it->name);
    if (parameter.type != ValueType::String) {
      const std::string number = number_in(it->value);
      if (!number.empty()) set_value(*it, number, Sure::No);
    }
    const std::string value = value_for(parameter);
    if (!value.empty()) set_value(*it, value, Sure::No);
  }

  // A node that the catalog does not have, such as one with a model, has what the message calls it.
  Parameter parameter_for(std::string_view name) const {
    const Parameter* const it = parameter_of(type_of(tree_, *element(), catalog_), name);
    if (it != nullptr) return *it;
    for (const ValueType type : {ValueType::Bool, ValueType::Int, ValueType::Double})
      if (message_.message.find(fmt::format("is not {}", expected_text(type))) != std::string::npos)
        return {.name = name, .type = type, .doc = {}};
    return {.name = name, .type = ValueType::String, .doc = {}};
  }

  void name_entry() {
    const TolerantAttribute* const it = attribute();
    if (it == nullptr) return;
    const bool is_key = is_identifier(it->value);
    set_value(*it, fmt::format("{{{}}}", is_key ? it->value : it->name),
              is_key ? Sure::Yes : Sure::No);
  }

  void write_version() {
    const TolerantAttribute* const it = attribute();
    const auto known = between(message_.hint, "=\"", "\"");
    if (it != nullptr && !known.empty()) set_value(*it, known, Sure::No);
  }

  void compare() {
    if (place_.begin >= tree_.text.size() || tree_.text[place_.begin] != '=') return;
    TextEdit edit;
    edit.insert(place_.begin, "=");
    add("Write '=='", std::move(edit), Sure::No);
  }

  void remove_attribute() {
    const TolerantAttribute* const it = attribute();
    if (it == nullptr || place_.begin != it->begin) return;
    TextEdit edit;
    remove(*it, edit);
    add(fmt::format("Remove '{}'", it->name), std::move(edit), Sure::No);
  }

  // With the blanks before it.
  void remove(const TolerantAttribute& it, TextEdit& edit) const {
    std::size_t begin = it.begin;
    while (begin > 0 &&
           std::string_view(" \t\r\n").find(tree_.text[begin - 1]) != std::string_view::npos)
      --begin;
    edit.remove(begin, range_of(tree_, it.value).end + 1);
  }

  // "the-door" is the_door.
  void join_words() {
    const auto words = quoted_words(message_.message);
    if (words.empty() || is_cut(words.front())) return;
    const std::string_view wrong = words.front();
    std::string right(wrong);
    for (char& it : right)
      if (!is_of_word(it)) it = '_';
    const auto found = find_word(wrong);
    if (!found || right == wrong) return;
    TextEdit edit;
    edit.replace(found->begin, found->end, right);
    add(fmt::format("Replace '{}' by '{}'", wrong, right), std::move(edit), Sure::No);
  }

  void choose_language() {
    if (tree_.elements.empty() || message_.hint.find("write <root ") == std::string::npos) return;
    add_attribute(tree_.elements.front(), "BTCPP_format", "4", Sure::No);
    add_attribute(tree_.elements.front(), "lockstep", "1", Sure::No);
  }

  // "'</BehaviorTree>' closes '<Sequence>', opened at line 4"
  void close_element() {
    const auto closing = between(message_.message, "'</", ">' closes '<");
    const auto open = between(message_.message, ">' closes '<", ">'");
    const std::string there = fmt::format("</{}", closing);
    if (open.empty() || !tree_.text.substr(place_.begin).starts_with(there)) return;
    TextEdit edit;
    const bool is_open_around = std::ranges::any_of(tree_.elements, [&](const TolerantElement& it) {
      return it.begin < place_.begin && it.tag == closing;
    });
    if (is_open_around) {
      edit.insert(place_.begin, fmt::format("</{}>", open));
      return add(fmt::format("Close <{}>", open), std::move(edit), Sure::No);
    }
    if (is_known(closing) && !is_known(open)) rename_start(open, closing);
    edit.replace(place_.begin + 2, place_.begin + there.size(), std::string(open));
    add(fmt::format("Replace '</{}>' by '</{}>'", closing, open), std::move(edit),
        is_known(open) && !is_known(closing) ? Sure::Yes : Sure::No);
  }

  bool is_known(std::string_view tag) const {
    constexpr std::string_view kAroundNodes[] = {"root", "BehaviorTree", "TreeNodesModel"};
    return catalog_.find(tag) != nullptr ||
           std::ranges::find(kAroundNodes, tag) != std::end(kAroundNodes);
  }

  // "<Inverer>" that "</Inverter>" closes.
  void rename_start(std::string_view wrong, std::string_view right) {
    const TolerantElement* open = nullptr;
    for (const TolerantElement& it : tree_.elements)
      if (it.tag == wrong && it.tag_end <= place_.begin && (!it.is_closed || it.end > place_.begin))
        open = &it;
    if (open == nullptr) return;
    const ByteRange name = range_of(tree_, open->tag);
    TextEdit edit;
    edit.replace(name.begin, name.end, std::string(right));
    add(fmt::format("Replace '<{}>' by '<{}>'", wrong, right), std::move(edit),
        is_slip_of(wrong, right) ? Sure::Yes : Sure::No);
  }

  void write_category() {
    const auto right = between(message_.hint, "write <", ">");
    const TolerantElement* const it = element();
    if (right.empty() || it == nullptr || it->tag.empty()) return;
    const ByteRange name = range_of(tree_, it->tag);
    TextEdit edit;
    edit.replace(name.begin, name.end, std::string(right));
    add_end_tag(name, right, edit);
    for (const TolerantAttribute& each : tree_.attributes_of(*it))
      if (each.name == "ID" && each.value == right) remove(each, edit);
    add(fmt::format("Write <{}>", right), std::move(edit), Sure::Yes);
  }

  void choose_tree() {
    const auto trees = quoted_words(rest_of_line(message_.hint, "trees: "));
    if (trees.empty() || is_cut(trees.front()) || tree_.elements.empty()) return;
    add_attribute(tree_.elements.front(), "main_tree_to_execute", trees.front(), Sure::No);
  }

  // "trees in this project: 'Main', 'Open'"
  void take_known() {
    const TolerantAttribute* const it = attribute();
    if (it == nullptr || !mends_.empty()) return;
    for (const auto right : quoted_words(rest_of_line(message_.hint, "project: ")))
      if (!is_cut(right)) set_value(*it, right, Sure::No);
  }

  void declare_group() {
    const auto words = quoted_words(message_.message);
    const auto tag = between(message_.message, "unknown ", " '");
    const NodeType* const type = catalog_.find(tag);
    if (type == nullptr || words.empty() || tree_.elements.empty() || is_cut(words.front())) return;
    const TolerantElement& root = tree_.elements.front();
    if (!root.is_tag_closed || root.close == root.end) return;
    std::string text = fmt::format("<{} name={}", tag, host::quoted(words.front()));
    for (const Parameter& it : type->parameters) {
      if (it.required && it.name != "name")
        text += fmt::format(" {}={}", it.name, host::quoted(value_for(it)));
    }
    TextEdit edit;
    edit.insert(root.tag_end, fmt::format("\n  {}/>", text));
    add(fmt::format("Declare {}/>", text), std::move(edit), Sure::No);
  }

  std::vector<const TolerantElement*> children_of(const TolerantElement& of) const {
    std::vector<const TolerantElement*> children;
    const auto number = static_cast<std::uint32_t>(&of - tree_.elements.data());
    for (std::uint32_t i = number + 1; i < of.last; ++i)
      if (tree_.elements[i].parent == number) children.push_back(&tree_.elements[i]);
    return children;
  }

  // A node with too few is where the message is; of too many, it is at the first that is too much.
  void mend_children() {
    const TolerantElement* const it = element_that_begins_here();
    if (it == nullptr) return;
    if (message_.message.find("' needs ") != std::string::npos) return put_child();
    const TolerantElement* const parent = tree_.parent_of(*it);
    if (parent == nullptr || message_.message.find("' has more than ") == std::string::npos) return;
    const auto children = children_of(*parent);
    const std::size_t begin = children.front()->begin, end = children.back()->end;
    TextEdit edit;
    edit.insert(begin, "<Sequence>");
    edit.insert(end, "</Sequence>");
    add("Put the children into a Sequence", std::move(edit), Sure::No);
  }

  void put_child() {
    const TolerantElement* const it = element_that_begins_here();
    constexpr std::string_view kNode = "<AlwaysSuccess/>";
    if (it == nullptr || !it->is_tag_closed || catalog_.find("AlwaysSuccess") == nullptr) return;
    TextEdit edit;
    if (it->close != it->end) {
      edit.insert(it->close, std::string(kNode));
    } else {
      edit.replace(it->tag_end - 2, it->tag_end, fmt::format(">{}</{}>", kNode, it->tag));
    }
    add("Put an AlwaysSuccess into it", std::move(edit), Sure::No);
  }

  const TolerantTree& tree_;
  const Catalog& catalog_;
  const Diagnostic& message_;
  ByteRange place_;
  std::vector<Mend> mends_;
};

}  // namespace

Mends::Mends(const TolerantTree& tree, const Catalog& catalog)
    : tree_(tree),
      catalog_(catalog),
      mark_(byte_order_mark(tree.text).size()),
      lines_(tree.text.substr(mark_)) {}

ByteRange Mends::place_of(const Diagnostic& message) const {
  const ByteRange place = range_of(tree_.text.substr(mark_), lines_, message.location);
  return {place.begin + mark_, place.end + mark_};
}

std::vector<Mend> Mends::of(const Diagnostic& message) const {
  return Mending(tree_, catalog_, message, place_of(message)).all();
}

}  // namespace lockstep::host
