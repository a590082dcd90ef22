#include "author/convert/convert.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "author/convert/blackboard_check.h"
#include "author/convert/circumstances.h"
#include "author/convert/declared_arguments.h"
#include "author/convert/entry_types.h"
#include "author/convert/marked_keys.h"
#include "author/convert/number_names.h"
#include "author/convert/script_text.h"
#include "author/convert/set_blackboard.h"
#include "author/convert/since_4.h"
#include "author/convert/start_value.h"
#include "author/convert/strict_xml.h"
#include "author/convert/switch_node.h"
#include "base/core/identifier.h"
#include "base/core/pre_order.h"
#include "base/core/wording.h"
#include "dialect/btcpp/pairs.h"
#include "dialect/btcpp/version_3.h"
#include "dialect/btcpp/words.h"
#include "language/document/scanner.h"
#include "language/document/text_edit.h"
#include "language/document/value_text.h"
#include "language/expression/reading.h"
#include "tree/check/node_check.h"
#include "tree/types/literal.h"

namespace lockstep::host {
namespace {

using btcpp::AttributePair;
using btcpp::Conversions;
using btcpp::FixedAttribute;
using btcpp::NodePair;
using btcpp::Side;

constexpr std::string_view kModels = "TreeNodesModel";
// BehaviorTree.CPP 4.10 refuses elements that are deeper below BehaviorTree.
constexpr std::size_t kMostLevels = 256;

// Whether some value looks as a script that reads a node: status(arm).
bool reads_nodes(const Document& document) {
  const auto reads = [](const Attribute& it) {
    return std::ranges::any_of(kReadings, [&](const ReadingRow& row) {
      for (auto at = it.value.find(row.name); at != it.value.npos;
           at = it.value.find(row.name, at + 1)) {
        const auto behind = it.value.find_first_not_of(" \t\r\n", at + row.name.size());
        if (behind != it.value.npos && it.value[behind] == '(') return true;
      }
      return false;
    });
  };
  for (std::uint32_t element = 0; element < document.elements().size(); ++element) {
    if (std::ranges::any_of(document.attributes(element), reads)) return true;
  }
  return false;
}

class Converter {
 public:
  Converter(const Document& document, const Conversion& conversion, const Reporter& report)
      : document_(document),
        conversion_(conversion),
        report_(report),
        circumstances_(document, conversion),
        marked_keys_(document, conversion, circumstances_),
        types_(conversion.meaning),
        numbers_(document, conversion),
        text_(document.source()->text()),
        scanner_(text_, to_ours() ? Grammar::Lenient : Grammar::Strict),
        reads_nodes_(reads_nodes(document)),
        is_older_(is_older_form(document)),
        arguments_(document) {}

  std::optional<std::string> convert() {
    bool before_end = true;
    while (before_end) {
      const XmlToken token = scanner_.next();
      before_end = token.kind != TokenKind::End && token.kind != TokenKind::Fault;
      convert(token);
    }
    if (report_.has_errors()) return std::nullopt;
    return edits_.apply(text_);
  }

 private:
  bool to_ours() const { return &conversion_.to == &kLockstepRules; }

  // An element of the text that is not closed yet.
  struct Open {
    std::uint32_t element;
    std::size_t begin;
    std::string tag;
    bool is_left_out = false;
    std::string before_children = {}, behind_children = {};
  };

  void convert(const XmlToken& token) {
    const bool is_prolog = std::exchange(is_prolog_, false);
    switch (token.kind) {
      case TokenKind::OpenTag:
        return open(token);
      case TokenKind::Attribute:
        return attribute(token);
      case TokenKind::TagEnd:
        insert(end_of_attributes_, std::exchange(added_, {}));
        if (!open_.empty()) insert(token.begin + 1, open_.back().before_children);
        return;
      case TokenKind::EmptyTagEnd:
        insert(end_of_attributes_, std::exchange(added_, {}));
        return close(token.begin + 2);
      case TokenKind::CloseTag:
        return close_tag(token);
      case TokenKind::Text:
        if (to_ours() && !is_left_out() && !is_in_models())
          edits_.remove(token.begin, end_of_text(text_, token));
        return;
      case TokenKind::Comment:
        return comment(token);
      case TokenKind::Instruction:
        is_prolog_ = is_prolog;
        if (to_ours() ? !is_strict_xml(text_, token) : !is_prolog) leave_out_instruction(token);
        return;
      case TokenKind::Doctype:
        if (to_ours() &&
            (next_ > 0 || !is_strict_xml(text_, token) || std::exchange(has_doctype_, true))) {
          leave_out_instruction(token);
        }
        return;
      default:
        return;
    }
  }

  bool is_left_out() const {
    return std::ranges::any_of(open_, [](const Open& it) { return it.is_left_out; });
  }

  // Models are for editors, so they stay as they are.
  bool is_in_models() const { return open_.size() > 1 && open_[1].tag == kModels; }

  void open(const XmlToken& token) {
    const std::uint32_t element = next_++;
    open_.push_back({element, token.begin, std::string(token.name)});
    pair_ = nullptr;
    is_switch_ = is_setter_ = is_check_ = false;
    new_id_.clear();
    end_of_attributes_ = token.begin + 1 + token.name.size();
    if (element >= document_.elements().size()) {  // a second root
      open_.back().is_left_out = true;
    } else if (open_.size() > 2 && !is_left_out() && !is_in_models()) {
      if (!to_ours() && open_.size() == 3 + kMostLevels) {
        cannot(place_of(element), fmt::format("a node {} levels below its tree", kMostLevels + 1),
               fmt::format("it takes {}: make a tree of a part, and a SubTree in its place",
                           kMostLevels));
      }
      convert_node(element, token.name);
      if (reads_nodes_) keep_default_name(element, token);
    } else if (open_.size() == 2) {
      convert_child_of_root(element);
    } else if (open_.size() == 1) {
      convert_root(element, token);
    }
    if (open_.back().tag != token.name) rename(token.begin + 1, token.name);
  }

  void insert(std::size_t at, const std::string& text) {
    if (!text.empty()) edits_.insert(at, text);
  }

  // A script may name a node by its type, or by its number among those of the type: Sequence#2.
  void keep_default_name(std::uint32_t element, const XmlToken& token) {
    const Attribute* id =
        is_explicit_tag(token.name) ? document_.find_attribute(element, "ID") : nullptr;
    const std::string_view type = id != nullptr ? id->value : token.name;
    const bool is_named = document_.find_attribute(element, "name") != nullptr;
    if (!is_named && open_.back().tag != token.name && open_.back().tag != type)
      added_.insert(0, written("name", type));
  }

  void rename(std::size_t at, std::string_view name) {
    edits_.replace(at, at + name.size(), open_.back().tag);
  }

  void convert_root(std::uint32_t root, const XmlToken& token) {
    const bool has_format = document_.find_attribute(root, "BTCPP_format") != nullptr;
    const std::size_t behind_tag = token.begin + 1 + token.name.size();
    if (to_ours() && !has_format) edits_.insert(behind_tag, written("lockstep", "1"));
  }

  static std::string written(std::string_view name, std::string_view value) {
    return fmt::format(" {}={}", name, quoted(value));
  }

  // Behind those that the node has: a reader looks for ID and name first.
  void add_attribute(std::string_view name, std::string_view value) {
    added_ += written(name, value);
  }

  void convert_child_of_root(std::uint32_t element) {
    const std::string_view tag = document_.elements()[element].tag;
    const Place place = place_of(element);
    constexpr std::string_view kBoth[] = {"BehaviorTree", "include", "plugin",    "arg",
                                          kModels,        "barrier", "resources", "team"};
    if (std::ranges::find(kBoth, tag) != std::end(kBoth)) {
      if (to_ours() && tag == "BehaviorTree") check_tree(element);
      if (!to_ours() && tag == "BehaviorTree") warn_of_id(element);
      if (!to_ours() && tag == "arg") warn_of_argument(element);
      return;
    }
    if (!to_ours() && tag == "property") {
      open_.back().is_left_out = true;
      report_.at("not-the-same"_code, place, "'property' is left out",
                 "trees for BehaviorTree.CPP declare none: give it to each run with --property",
                 Severity::Warning);
    } else if (to_ours()) {
      open_.back().is_left_out = true;
      report_.at("left-out"_code, place, fmt::format("'{}' is left out", brief(tag)),
                 "lockstep's language does not have it; it has no effect on a run", Severity::Note);
    } else {
      cannot(place, fmt::format("'{}'", brief(tag)));
    }
  }

  // lockstep reads it in both languages.
  void warn_of_argument(std::uint32_t argument) const {
    if (report_.counted_only(Severity::Warning)) return;
    const Attribute* name = document_.find_attribute(argument, "name");
    report_.at("not-convertible"_code, place_of(argument), "BehaviorTree.CPP ignores 'arg'",
               fmt::format("'${{{}}}' is a text there: write the value, or an entry in its place",
                           name == nullptr ? "…" : brief(name->value)),
               Severity::Warning);
  }

  // Warns once of each name that this file does not declare.
  void warn_of_arguments(const Attribute& attribute) {
    DeclaredArguments::for_each_in(attribute.value, [&](std::size_t at, std::string_view name) {
      if (arguments_.has(name) || !told_.insert(name).second) return;
      report_.in_value("not-convertible"_code, attribute.place, at,
                       fmt::format("'${{{}}}' is a text for BehaviorTree.CPP", brief(name)),
                       "it has no arguments: write the value, or an entry", Severity::Warning);
    });
  }

  // Releases before 4.8.4 take it, and lockstep does.
  void warn_of_id(std::uint32_t tree) const {
    const Attribute* id = document_.find_attribute(tree, "ID");
    constexpr std::string_view kForbidden = " \t\r\n<>&\"'/\\:*?|.";
    if (id == nullptr) return;
    const bool is_name = id->value.find_first_of(kForbidden) == std::string_view::npos;
    if (is_name && id->value != "Root" && id->value != "root") return;
    if (report_.counted_only(Severity::Warning)) return;
    report_.at_value(
        "bad-name"_code, id->place,
        fmt::format("BehaviorTree.CPP 4.8.4 and later refuse the ID '{}'", brief(id->value)),
        "an ID there has no whitespace and none of <>&\"'/\\:*?|., and is not Root",
        Severity::Warning);
  }

  void check_tree(std::uint32_t tree) const {
    const Attribute* id = document_.find_attribute(tree, "ID");
    const Place place = document_.elements()[tree].place;
    if (id == nullptr || id->value.empty()) {
      report_.at("missing-attribute"_code, place, "a BehaviorTree without 'ID'", "give it one");
    } else if (id->value.find('/') != std::string_view::npos) {
      report_.at_value("bad-name"_code, id->place,
                       fmt::format("the ID '{}' contains '/'", brief(id->value)),
                       "in lockstep's language '/' separates the names in a path");
    }
  }

  void cannot(Place place, std::string_view what, std::string hint = {}) const {
    if (report_.counted_only(Severity::Error)) return;
    report_.at("not-convertible"_code, place,
               fmt::format("{} cannot be expressed in {}", what, conversion_.to.title),
               std::move(hint));
  }

  void not_the_same(Place place, std::string_view what, std::string difference,
                    Severity severity = Severity::Warning) const {
    if (report_.counted_only(severity)) return;
    report_.at("not-the-same"_code, place, fmt::format("'{}' is not quite the same", brief(what)),
               std::move(difference), severity);
  }

  void convert_node(std::uint32_t element, std::string_view tag) {
    const bool is_explicit = is_explicit_tag(tag);
    const Attribute* id = is_explicit ? document_.find_attribute(element, "ID") : nullptr;
    std::string_view type = id != nullptr ? id->value : tag;
    if (is_explicit && id == nullptr) return cannot(place_of(element), "a node without 'ID'");
    if (to_ours() && conversion_.from_nodes.find(type) == nullptr) {
      if (const auto since = btcpp::node_since_4(type); !since.empty()) type = since;
    }
    is_check_ = to_ours() && is_blackboard_check(type);
    if (is_check_) return convert_check(element, type);
    if (conversion_.from_nodes.find(type) == nullptr) {
      if (is_taken(type)) rename_leaf(element, type, is_explicit);
      return;
    }
    is_switch_ = to_ours() ? switch_cases_there(type) != 0 : type == "Switch";
    if (is_switch_) return convert_switch(element, type);
    is_setter_ = to_ours() && type == "SetBlackboard";
    if (is_setter_) return convert_setter(element);
    pair_ = find_pair(element, type);
    if (pair_ == nullptr) {
      return cannot(place_of(element), fmt::format("this '{}'", brief(type)), hint_of(type));
    }
    open_.back().tag = to_ours() ? pair_->ours : pair_->theirs;
    const FixedAttribute& fixed = to_ours() ? pair_->in_ours : pair_->in_theirs;
    if (!fixed.name.empty() && !fixed.is_default) add_attribute(fixed.name, fixed.value);
    for (const AttributePair& it : pair_->attributes) {
      const bool is_absent = document_.find_attribute(element, it.ours) == nullptr;
      if (!to_ours() && it.conversion == Conversions::Rounds && is_absent) {
        add_attribute(it.theirs, "-1");
      }
    }
    for (const btcpp::Difference& it : pair_->differences) {
      if (!circumstances_.apply(it.when, element)) continue;
      // Few leaves do, so one line for each difference is enough.
      const bool is_rare =
          it.when == btcpp::When::LeafSkipsFirst || it.when == btcpp::When::LeafMayRun;
      if (is_rare && !told_of_leaves_.insert(it.what).second) continue;
      not_the_same(place_of(element), type, std::string(it.what),
                   is_rare ? Severity::Note : Severity::Warning);
    }
    if (pair_->ours == "SubTree") convert_subtree(element);
  }

  void convert_subtree(std::uint32_t element) {
    if (const auto keys = marked_keys_.differ(element); !keys.empty()) {
      report_.at("not-the-same"_code, place_of(element),
                 fmt::format("'_autoremap' is not quite the same for {}", listed(keys)),
                 "for BehaviorTree.CPP, a key with '_' in front is an entry of each tree; in "
                 "lockstep's language _autoremap passes it on, and no attribute can: give an entry "
                 "that trees share a name without '_', and others a different name in each tree",
                 Severity::Warning);
    }
    convert_model(element);
  }

  // There, a model gives a SubTree the ports that it leaves out. Here, models are for editors.
  void convert_model(std::uint32_t element) {
    const Attribute* id = document_.find_attribute(element, "ID");
    const auto model = conversion_.models.subtrees.find(id == nullptr ? "" : id->value);
    const bool has_model = model != conversion_.models.subtrees.end();
    if (!has_model || circumstances_.passes_on_all(element)) return;
    for (const ModelPort& port : model->second.ports) {
      const bool is_given = document_.find_attribute(element, port.name) != nullptr;
      if (is_given || !port.default_value) continue;
      to_ours() ? add_default(element, port) : warn_of_default(element, port);
    }
  }

  void add_default(std::uint32_t element, const ModelPort& port) {
    const std::string_view key = btcpp::key_of(*port.default_value, port.name);
    for (const std::string_view name : {port.name, key.empty() ? port.name : key}) {
      if (is_identifier(name) && (name != port.name || !name.starts_with('_'))) continue;
      return cannot(place_of(element),
                    fmt::format("the key '{}', by the model of this SubTree,", brief(name)),
                    fmt::format("a key is {}", kIdentifierRule));
    }
    if (key.empty())
      warn_of_start_text(place_of(element), element, port.name, std::string(*port.default_value));
    add_attribute(port.name,
                  key.empty() ? std::string(*port.default_value) : fmt::format("{{{}}}", key));
  }

  void warn_of_default(std::uint32_t element, const ModelPort& port) const {
    if (report_.counted_only(Severity::Warning)) return;
    report_.at(
        "not-the-same"_code, place_of(element),
        fmt::format("for BehaviorTree.CPP, '{}' of this SubTree is '{}'", brief(port.name),
                    brief(*port.default_value)),
        "that is the default of its model, which has no effect in lockstep's language: delete it, "
        "or give the SubTree the attribute",
        Severity::Warning);
  }

  // A leaf of a plugin that has the name of a built-in node there.
  bool is_taken(std::string_view type) const {
    return conversion_.from_nodes.find(type) == nullptr &&
           conversion_.to_nodes.find(type) != nullptr;
  }
  static std::string other_name(std::string_view type) { return fmt::format("{}Leaf", type); }

  void rename_leaf(std::uint32_t element, std::string_view type, bool is_explicit) {
    const std::string name = other_name(type);
    if (count_children(element) != 0 || conversion_.to_nodes.find(name) != nullptr) {
      return cannot(place_of(element), fmt::format("a node called '{}'", brief(type)),
                    "there it is the name of a built-in node");
    }
    (is_explicit ? new_id_ : open_.back().tag) = name;
    if (report_.counted_only(Severity::Warning)) return;
    report_.at("not-the-same"_code, place_of(element),
               fmt::format("the leaf '{}' is called '{}'", brief(type), name),
               "there the other name is that of a built-in node: register the leaf as this one",
               Severity::Warning);
  }

  void convert_check(std::uint32_t element, std::string_view type) {
    const ConvertedCheck converted = converted_check(document_, element, type);
    if (!converted.problem.empty()) {
      return cannot(converted.place, converted.problem, converted.hint);
    }
    open_.back().tag = "WhileDoElse";
    open_.back().before_children = fmt::format("<Check code={}/>", host::quoted(converted.code));
    open_.back().behind_children = fmt::format("<{}/>", converted.otherwise);
    not_the_same(place_of(element), type,
                 "an entry without a value was not equal; in a script it is an error");
  }

  void convert_setter(std::uint32_t element) {
    const EntryTypes::Found entry = types_.of(place_of(element), "output_key");
    const ConvertedSetter converted = setter_to_ours(document_, element, entry.type);
    if (!converted.problem.empty()) {
      return cannot(converted.place, converted.problem, converted.hint);
    }
    const bool is_doubtful = !converted.is_text && !entry.type && entry.is_open;
    if (is_doubtful && !std::exchange(told_of_types_, true)) {
      report_.at("not-the-same"_code, place_of(element),
                 fmt::format("the type of the entry in '{}' is not known", brief(converted.code)),
                 "no model describes a leaf that uses it: if its port is a string, write the value "
                 "in quotes",
                 Severity::Note);
    }
    if (!converted.is_entry) warn_of_text(place_of(element), converted.code, entry);
    open_.back().tag = "Script";
    add_attribute("code", converted.code);
  }

  // What is a text there may be a number here, which a script then uses. For example, n := 0,
  // SetBlackboard n="1", n += 1.
  void warn_of_text(Place place, std::string_view what, const EntryTypes::Found& entry) const {
    if (!entry.has_number || entry.has_port) return;
    not_the_same(place, what,
                 "for BehaviorTree.CPP the entry then has a text, to which no script assigns a "
                 "number; in lockstep's language it keeps the type that scripts give it");
  }

  void warn_of_start_text(Place place, std::uint32_t subtree, std::string_view name,
                          const std::string& value) {
    if (literal_type(value) != ValueType::String || !parse_flag(value)) return;
    warn_of_text(place, fmt::format("{}={}", name, value),
                 types_.of_start_value(place_of(subtree), name));
  }

  void convert_switch(std::uint32_t element, std::string_view type) {
    const auto compared = types_.of(place_of(element), to_ours() ? "variable" : "on").type;
    const ConvertedSwitch converted =
        to_ours() ? switch_to_ours(document_, element, switch_cases_there(type), compared)
                  : switch_to_theirs(document_, element, count_children(element), compared);
    if (!converted.problem.empty()) {
      return cannot(converted.place, converted.problem, converted.hint);
    }
    open_.back().tag = "Switch";
    if (!to_ours()) open_.back().tag += std::to_string(converted.attributes.size() - 1);
    for (const auto& [name, value] : converted.attributes) add_attribute(name, value);
    not_the_same(place_of(element), type,
                 "for BehaviorTree.CPP, an entry without a value chooses the last child; in "
                 "lockstep's language it is an error" +
                     converted.difference);
  }

  std::uint32_t count_children(std::uint32_t element) const {
    const auto elements = document_.elements();
    std::uint32_t children = 0;
    for ([[maybe_unused]] const auto child : children_in(elements, element)) ++children;
    return children;
  }

  Place place_of(std::uint32_t element) const { return document_.elements()[element].place; }

  const NodePair* find_pair(std::uint32_t element, std::string_view type) const {
    const auto given = [&](std::string_view name) -> std::optional<std::string_view> {
      const Attribute* it = document_.find_attribute(element, name);
      return it == nullptr ? std::nullopt : std::optional(it->value);
    };
    return btcpp::find_pair(to_ours() ? Side::Theirs : Side::Ours, type, given);
  }

  // If one with another attribute can be said.
  std::string hint_of(std::string_view type) const {
    for (const NodePair& pair : btcpp::node_pairs()) {
      if ((to_ours() ? pair.theirs : pair.ours) != type) continue;
      const FixedAttribute& fixed = to_ours() ? pair.in_theirs : pair.in_ours;
      return fmt::format("one with {}=\"{}\" can", fixed.name, fixed.value);
    }
    if (type == "Precondition") return "give its child failure_if, success_if or skip_if";
    return {};
  }

  void attribute(const XmlToken& token) {
    if (is_left_out()) return;
    end_of_attributes_ = end_of(token);
    const std::uint32_t element = open_.back().element;
    const Attribute* found = document_.find_attribute(element, token.name);
    if (found == nullptr) return;
    if (!to_ours()) warn_of_arguments(*found);
    const bool is_leaf = open_.back().tag == "Action" || open_.back().tag == "Condition";
    if (is_in_models() && is_leaf && found->name == "ID" && is_taken(found->value))
      return replace(token, found->name, other_name(found->value));
    if (is_in_models()) return keep(token, *found);
    if (open_.size() == 1) return root_attribute(token, *found);
    if (open_.size() == 2) return tree_attribute(token, *found);
    node_attribute(token, *found);
  }

  std::string value_of(const Attribute& attribute) const {
    const std::string_view tag = document_.elements()[open_.back().element].tag;
    return is_older_ ? value_since_4(tag, attribute, !arguments_.is_empty(), report_)
                     : std::string(attribute.value);
  }

  void root_attribute(const XmlToken& token, const Attribute& attribute) {
    const std::string_view own = to_ours() ? "BTCPP_format" : "lockstep";
    if (attribute.name == own) {
      replace(token, to_ours() ? "lockstep" : "BTCPP_format", to_ours() ? "1" : "4");
    } else if (to_ours() && attribute.name != "main_tree_to_execute" &&
               attribute.name != "xmlns:xsi" && attribute.name != "xsi:noNamespaceSchemaLocation") {
      leave_out(token, attribute);
    } else {
      keep(token, attribute);
    }
  }

  // Handles an attribute of an element of root.
  void tree_attribute(const XmlToken& token, const Attribute& attribute) {
    const bool is_tree = open_.back().tag == "BehaviorTree";
    if (to_ours() && open_.back().tag == "include" && attribute.name == "ros_pkg") {
      return cannot(attribute.place, "'ros_pkg'", "give the path of the file");
    }
    if (!to_ours() && open_.back().tag == "include" && attribute.name == "as") {
      return cannot(attribute.place, "'as'",
                    "BehaviorTree.CPP ignores it: give the trees IDs of their own");
    }
    const bool is_known = attribute.name == "ID" || attribute.name == "_description";
    if (to_ours() && is_tree && !is_known) return leave_out(token, attribute);
    keep(token, attribute);
  }

  void node_attribute(const XmlToken& token, const Attribute& attribute) {
    const std::string_view name = attribute.name;
    if (is_switch_ && is_switch_attribute(name)) return remove(token);
    if (is_setter_ && (name == "value" || name == "output_key")) return remove(token);
    if (is_check_ && is_attribute_of_check(name)) return remove(token);
    if (name == "ID" && !new_id_.empty()) return replace(token, name, new_id_);
    if (pair_ != nullptr && is_fixed(name)) return remove(token);
    if (const AttributePair* pair = attribute_pair(name)) {
      return convert_value(token, attribute, *pair);
    }
    if (name == "ID" && is_explicit_tag(open_.back().tag)) return keep(token, attribute);
    if (name == "ID" && (is_switch_ || is_setter_ || is_check_)) return remove(token);
    if (name == "ID" && pair_ != nullptr && pair_->ours != "SubTree") return remove(token);
    to_ours() ? to_our_attribute(token, attribute) : to_their_attribute(token, attribute);
  }

  void to_their_attribute(const XmlToken& token, const Attribute& attribute) {
    const auto hook = hook_named(attribute.name, conversion_.from);
    if (hook) return convert_script(token, attribute, attribute_of(*hook, conversion_.to));
    if (is_script(attribute.name)) return convert_script(token, attribute, attribute.name);
    if (convert_at_cut(token, attribute)) return;
    const bool is_subtree = pair_ != nullptr && pair_->ours == "SubTree";
    const bool is_key = is_port_name(attribute.name) && attribute.name != "name" &&
                        attribute.name != "ID" && attribute.value.find('{') == std::string::npos;
    if (is_subtree && is_key) return convert_start(token, attribute);
    keep(token, attribute);
  }

  void convert_start(const XmlToken& token, const Attribute& attribute) {
    const EntryTypes::Found entry =
        types_.of_start_value(place_of(open_.back().element), attribute.name);
    const ConvertedStart start = start_to_theirs(attribute.value, entry);
    if (!start.difference.empty() && !report_.counted_only(Severity::Warning)) {
      report_.at_value(
          "not-the-same"_code, attribute.place,
          fmt::format("'{}' may be another value for BehaviorTree.CPP", brief(attribute.value)),
          start.difference, Severity::Warning);
    }
    start.text == attribute.value ? keep(token, attribute)
                                  : replace(token, attribute.name, start.text);
  }

  bool convert_at_cut(const XmlToken& token, const Attribute& attribute) {
    if (attribute.name == conversion_.from.on_resume) {
      replace(token, conversion_.to.on_resume, attribute.value);
    } else if (attribute.name == conversion_.from.commit) {
      replace(token, conversion_.to.commit, attribute.value);
    } else {
      return false;
    }
    return true;
  }

  // Of a built-in node. That of a SubTree is an entry of its tree.
  bool is_script(std::string_view name) const {
    return pair_ != nullptr && pair_->ours != "SubTree" && name == "code";
  }

  void convert_script(const XmlToken& token, const Attribute& attribute, std::string_view name) {
    const auto script = converted_script(attribute.value);
    if (script) {
      const auto whole = converted_script(arguments_.with_defaults(attribute.value));
      if (!whole || *whole != arguments_.with_defaults(*script)) {
        return cannot(attribute.place, "a script with this argument",
                      "its default is in other words there: write it here in its place");
      }
      if (*script == attribute.value && name == attribute.name) return keep(token, attribute);
      return replace(token, name, *script);
    }
    if (report_.counted_only(Severity::Error)) return;
    report_.in_value(
        "not-convertible"_code, attribute.place, script.error().offset,
        fmt::format("{} cannot be expressed in {}", script.error().message, conversion_.to.title),
        script.error().hint);
  }

  tl::expected<std::string, Expression::Error> converted_script(std::string_view script) const {
    return to_ours() ? script_to_ours(script, numbers_) : script_to_theirs(script);
  }

  bool is_fixed(std::string_view name) const {
    const FixedAttribute& fixed = to_ours() ? pair_->in_theirs : pair_->in_ours;
    return !fixed.name.empty() && fixed.name == name;
  }

  const AttributePair* attribute_pair(std::string_view name) const {
    if (pair_ == nullptr) return nullptr;
    const auto it = std::ranges::find(pair_->attributes, name,
                                      to_ours() ? &AttributePair::theirs : &AttributePair::ours);
    return it == pair_->attributes.end() ? nullptr : &*it;
  }

  void convert_value(const XmlToken& token, const Attribute& attribute, const AttributePair& pair) {
    const std::uint32_t children = count_children(open_.back().element);
    const auto value = to_ours() ? btcpp::value_here(pair.conversion, attribute.value, children)
                                 : btcpp::value_there(pair.conversion, attribute.value);
    if (!value) {
      return cannot(attribute.place,
                    fmt::format("{}=\"{}\"", attribute.name, brief(attribute.value)),
                    std::string(btcpp::hint_of(pair.conversion)));
    }
    if (value->empty()) return remove(token);
    replace(token, to_ours() ? pair.ours : pair.theirs, *value);
  }

  void to_our_attribute(const XmlToken& token, const Attribute& attribute) {
    const std::string_view name = attribute.name;
    const bool is_subtree = pair_ != nullptr && pair_->ours == "SubTree";
    if (is_subtree && (name == "__shared_blackboard" || name == "__autoremap")) {
      return replace(token, "_autoremap", attribute.value);
    }
    if (const auto hook = hook_named(name, conversion_.from)) {
      return convert_script(token, attribute, attribute_of(*hook, conversion_.to));
    }
    if (convert_at_cut(token, attribute)) return;
    if (hook_named(name, conversion_.to)) {
      return cannot(attribute.place, fmt::format("a port called '{}'", name),
                    "there it is a script of the node");
    }
    if (name == "_autoremap" || name == "_description") return keep(token, attribute);
    const bool is_dotted = name.find('.') != name.npos;  // of a leaf of ours: goal.order
    if (!is_port_name(name) && !is_dotted) return leave_out(token, attribute);
    if (name == "name") return convert_name(token, attribute);
    const std::string value = value_of(attribute);
    const std::string_view key = btcpp::key_of(value, name);
    if (key.empty() && is_script(name)) return convert_script(token, attribute, name);
    if (key.empty() && is_subtree)
      warn_of_start_text(attribute.place, open_.back().element, name, value);
    if (key.empty()) return keep(token, attribute);
    if (is_script(name)) {
      return cannot(attribute.place, "a script in an entry", "write the script here");
    }
    if (!is_identifier(key)) {
      return cannot(attribute.place, fmt::format("the key '{}'", brief(key)),
                    fmt::format("a key is {}", kIdentifierRule));
    }
    if (attribute.value == fmt::format("{{{}}}", key)) return keep(token, attribute);
    replace(token, name, fmt::format("{{{}}}", key));
  }

  void convert_name(const XmlToken& token, const Attribute& attribute) {
    if (attribute.value.empty()) return remove(token);
    if (attribute.value.find('/') == std::string_view::npos) return keep(token, attribute);
    cannot(attribute.place, fmt::format("the name '{}'", brief(attribute.value)),
           "'/' separates the names in a path");
  }

  std::size_t end_of(const XmlToken& token) const {
    return scanner_.offset_of(token.value) + token.value.size() + 1;
  }

  void replace(const XmlToken& token, std::string_view name, std::string_view value) {
    edits_.replace(token.begin, end_of(token), fmt::format("{}={}", name, quoted(value)));
  }

  // With the blanks before it.
  void remove(const XmlToken& token) {
    std::size_t begin = token.begin;
    while (begin > 0 && is_xml_blank(text_[begin - 1])) --begin;
    edits_.remove(begin, end_of(token));
  }

  void leave_out(const XmlToken& token, const Attribute& attribute) {
    remove(token);
    if (report_.counted_only(Severity::Note)) return;
    report_.at("left-out"_code, attribute.place,
               fmt::format("'{}' is left out", brief(attribute.name)), "it is for editors",
               Severity::Note);
  }

  // A value that only the lenient grammar accepts is written as XML.
  void keep(const XmlToken& token, const Attribute& attribute) {
    const bool is_glued = !is_xml_blank(text_[token.begin - 1]);
    if (to_ours() && is_glued) edits_.insert(token.begin, " ");
    if (!to_ours() || token.value.find_first_of("<&") == std::string_view::npos) return;
    const auto begin = scanner_.offset_of(token.value) - 1;
    edits_.replace(begin, end_of(token), quoted(attribute.value));
  }

  void close_tag(const XmlToken& token) {
    if (open_.empty()) return;
    const bool is_renamed = open_.back().tag != token.name && !is_left_out();
    if (is_renamed) rename(token.begin + 2, token.name);
    insert(token.begin, open_.back().behind_children);
    close(text_.find('>', token.begin) + 1);
  }

  void close(std::size_t end) {
    if (open_.empty()) return;
    const bool inside = open_.size() > 1 && open_[open_.size() - 2].is_left_out;
    if (open_.back().is_left_out && !inside) {
      std::size_t begin = open_.back().begin;
      while (begin > 0 && is_xml_blank(text_[begin - 1])) --begin;
      edits_.remove(begin, end);
    }
    open_.pop_back();
  }

  // BehaviorTree.CPP takes them at the beginning of a file only, and then any.
  void leave_out_instruction(const XmlToken& token) {
    edits_.remove(token.begin, token.begin + token.value.size());
    if (report_.counted_only(Severity::Note)) return;
    const std::uint32_t element = next_ == 0 ? 0 : next_ - 1;
    report_.at("left-out"_code, place_of(element),
               fmt::format("'{}' is left out", brief(token.value)),
               to_ours() ? "it has no effect, and XML does not have it there"
                         : "BehaviorTree.CPP takes processing instructions only at the beginning "
                           "of a file",
               Severity::Note);
  }

  void comment(const XmlToken& token) {
    const auto begin = token.begin + 4, end = text_.find("-->", begin);
    const auto text = comment_in_xml(text_.substr(begin, end - begin));
    if (to_ours() && text) edits_.replace(begin, end, *text);
  }

  const Document& document_;
  const Conversion& conversion_;
  const Reporter& report_;
  Circumstances circumstances_;
  MarkedKeys marked_keys_;
  EntryTypes types_;
  const NumberNames numbers_;
  std::string_view text_;
  Scanner scanner_;
  const bool reads_nodes_;
  const bool is_older_;  // for version 3 of BehaviorTree.CPP
  const DeclaredArguments arguments_;
  TextEdit edits_;
  std::vector<Open> open_;
  std::uint32_t next_ = 0;             // element
  const NodePair* pair_ = nullptr;     // of the innermost element
  bool is_switch_ = false;             // likewise
  bool is_setter_ = false;             // likewise
  bool is_check_ = false;              // likewise
  std::string new_id_;                 // of the innermost element, if it is explicit
  std::string added_;                  // attributes of the tag
  std::size_t end_of_attributes_ = 0;  // of it
  bool has_doctype_ = false;
  bool told_of_types_ = false;
  bool is_prolog_ = true;            // nothing but processing instructions so far
  std::set<std::string_view> told_;  // names of arguments
  std::set<std::string_view> told_of_leaves_;
};

}  // namespace

std::optional<std::string> convert(const Document& document, const Conversion& conversion,
                                   const Reporter& report) {
  return Converter(document, conversion, report).convert();
}

}  // namespace lockstep::host
