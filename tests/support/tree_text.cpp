#include "support/tree_text.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <stdexcept>

#include "support/scripted_leaf.h"

namespace lockstep::test {
namespace {

const NodeType kScriptedActionType{.id = "Scripted",
                                   .category = NodeCategory::Action,
                                   .doc = "",
                                   .arity = {0, 0},
                                   .binding = &kScriptedAction};
const NodeType kScriptedConditionType{.id = "ScriptedCondition",
                                      .category = NodeCategory::Condition,
                                      .doc = "",
                                      .arity = {0, 0},
                                      .binding = &kScriptedCondition};
const NodeType kBareActionType{.id = "Bare",
                               .category = NodeCategory::Action,
                               .doc = "",
                               .arity = {0, 0},
                               .has_progress = false,
                               .binding = &kBareAction};

struct Attribute {
  std::string_view name, value;
};

class Builder {
 public:
  explicit Builder(std::string_view text) : all_(text), rest_(text) {}

  Tree build() {
    node(0);
    skip_blanks();
    if (!rest_.empty()) fail("text after the tree");
    tree_.id = "Test";
    return std::move(tree_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw std::invalid_argument("tree text '" + std::string(all_) + "' at '" + std::string(rest_) +
                                "': " + reason);
  }
  void skip_blanks() {
    while (rest_.starts_with(' ')) rest_.remove_prefix(1);
  }
  bool take(char character) {
    if (!rest_.starts_with(character)) return false;
    rest_.remove_prefix(1);
    return true;
  }
  std::string_view take_until(std::string_view ends) {
    const auto length = std::min(rest_.find_first_of(ends), rest_.size());
    const auto taken = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return taken;
  }

  std::vector<Attribute> attributes() {
    std::vector<Attribute> list;
    if (!take('[')) return list;
    for (skip_blanks(); !take(']'); skip_blanks()) {
      if (rest_.empty()) fail("expected ']'");
      const auto text = take_until(" ]");
      const auto equal = std::min(text.find('='), text.size());
      list.push_back({text.substr(0, equal), text.substr(std::min(equal + 1, text.size()))});
    }
    return list;
  }

  void node(NodeIndex parent) {
    skip_blanks();
    const auto name = take_until(" ()[]?");
    if (name.empty()) fail("expected a name");
    const auto self = static_cast<NodeIndex>(tree_.nodes.size());
    tree_.nodes.push_back({});
    tree_.labels.push_back({std::string(name), std::string(name), nullptr, parent});
    if (std::isupper(static_cast<unsigned char>(name[0])) != 0) {
      built_in(self, name);
    } else {
      scripted(self);
    }
    tree_.nodes[self].end = static_cast<NodeIndex>(tree_.nodes.size());
  }

  void scripted(NodeIndex self) {
    const bool condition = take('?');
    const bool bare = !attributes().empty();
    const NodeType& type = condition ? kScriptedConditionType
                           : bare    ? kBareActionType
                                     : kScriptedActionType;
    tree_.labels[self].type = &type;
    tree_.nodes[self].kind = condition ? &kPluginCondition : &kPluginAction;
    tree_.nodes[self].params = static_cast<std::uint32_t>(tree_.leaves.size());
    tree_.leaves.push_back({self, &type, 0});
    reserve_state(self);
  }

  void built_in(NodeIndex self, std::string_view name) {
    const auto kinds = built_in_kinds();
    const auto found = std::find_if(kinds.begin(), kinds.end(),
                                    [&](const NodeKind* kind) { return kind->type.id == name; });
    if (found == kinds.end()) fail("no node '" + std::string(name) + "'");
    const NodeType& type = (*found)->type;
    tree_.nodes[self].kind = *found;
    tree_.labels[self].type = &type;
    const auto given = attributes();
    if (take('(')) {
      for (skip_blanks(); !take(')'); skip_blanks()) {
        if (rest_.empty()) fail("expected ')'");
        node(self);
        ++tree_.nodes[self].children;
      }
    }
    const std::uint32_t children = tree_.nodes[self].children;
    if (children < type.arity.min || children > type.arity.max)
      fail("arity of " + std::string(name));
    lay_out(self, type, values(type, given, children));
    reserve_state(self);
  }

  std::vector<Value> values(const NodeType& type, const std::vector<Attribute>& given,
                            std::uint32_t children) const {
    std::vector<Value> list;
    std::size_t used = 0;
    for (const Parameter& parameter : type.parameters) {
      std::optional<std::string_view> text = parameter.default_text;
      for (const Attribute& attribute : given) {
        if (attribute.name != parameter.name) continue;
        text = attribute.value;
        ++used;
      }
      if (parameter.required && !text) fail("missing " + std::string(parameter.name));
      const auto value = text ? parse_value(parameter.type, *text) : Value();
      if (!value) fail("value of " + std::string(parameter.name));
      list.push_back(*value);
    }
    if (used != given.size()) fail("unknown parameter of " + std::string(type.id));
    if (type.rule != nullptr) {
      if (const auto broken = type.rule(list, children)) fail(broken->message);
    }
    return list;
  }

  void lay_out(NodeIndex self, const NodeType& type, const std::vector<Value>& list) {
    tree_.nodes[self].params = static_cast<std::uint32_t>(tree_.cells.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      tree_.cells.push_back(cell(type.parameters[i], list[i]));
    }
  }

  Cell cell(const Parameter& parameter, const Value& value) {
    Cell cell{};
    if (const auto* flag = std::get_if<bool>(&value)) cell.boolean = *flag;
    if (const auto* number = std::get_if<std::int64_t>(&value)) cell.integer = *number;
    if (const auto* number = std::get_if<double>(&value)) cell.number = *number;
    if (const auto* text = std::get_if<std::string>(&value)) {
      const auto choice = std::find(parameter.choices.begin(), parameter.choices.end(), *text);
      if (choice == parameter.choices.end()) fail("value of " + std::string(parameter.name));
      cell.integer = choice - parameter.choices.begin();
    }
    if (const auto* list = std::get_if<std::vector<double>>(&value)) {
      cell.list = {static_cast<std::uint32_t>(tree_.numbers.size()),
                   static_cast<std::uint32_t>(list->size())};
      tree_.numbers.insert(tree_.numbers.end(), list->begin(), list->end());
    }
    return cell;
  }

  void reserve_state(NodeIndex self) {
    Node& node = tree_.nodes[self];
    node.state = static_cast<std::uint32_t>(tree_.state_size);
    const std::size_t size = node.kind->state_size + node.kind->state_per_child * node.children;
    tree_.state_size += (size + 7) / 8 * 8;
  }

  std::string_view all_, rest_;
  Tree tree_;
};

}  // namespace

Tree tree_from_text(std::string_view text) {
  return Builder(text).build();
}

}  // namespace lockstep::test
