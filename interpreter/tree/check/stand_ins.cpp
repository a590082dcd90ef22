#include "tree/check/stand_ins.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <iterator>
#include <ranges>
#include <set>
#include <vector>

#include "base/blackboard/conversion.h"
#include "base/core/any_value.h"
#include "base/core/element_types.h"
#include "base/core/identifier.h"
#include "base/core/pre_order.h"
#include "base/core/suggest.h"
#include "base/core/typo.h"
#include "base/core/value_types.h"
#include "base/core/wording.h"
#include "tree/check/foreign_hints.h"
#include "tree/check/node_check.h"
#include "tree/check/other_tools.h"
#include "tree/check/references.h"
#include "tree/language_reader.h"

namespace lockstep::host {

class StandIns {
 public:
  std::string_view keep(std::string_view text) { return texts_.emplace_back(text); }
  const NodeType* add(NodeType type, std::vector<Parameter> ports, const Mock& mock) {
    type.parameters = ports_.emplace_back(std::move(ports));
    type.mock = &mocks_.emplace_back(mock);
    return &types_.emplace_back(type);
  }
  bool is_empty() const { return types_.empty(); }

 private:
  std::deque<std::string> texts_;
  std::deque<std::vector<Parameter>> ports_;
  std::deque<Mock> mocks_;
  std::deque<NodeType> types_;
};

namespace {

// An attribute, at its first use.
struct UsedAttribute {
  Place place;
  std::string_view value;
};
using UsedAttributes = std::map<std::string_view, UsedAttribute>;

// How the trees use a node.
struct Use {
  Place place;                                // the first
  std::optional<NodeCategory> category = {};  // as an explicit tag says
  bool is_tree = false;         // of a SubTree; `place` is that of the attribute that has its ID
  std::string_view space = {};  // then Project::prefixes of its file
  bool opens_entries = false;
  std::uint32_t fewest_children = 0xffffffff, children = 0;  // the most
  UsedAttributes attributes = {};
  UsedAttributes misfits = {};  // constants that are no values of their ports in the model
};

std::string kind_words(NodeCategory category) {
  return fmt::format("{} {}", category == NodeCategory::Action ? "an" : "a", to_string(category));
}

bool names_entry(std::string_view value) {
  value = without_blanks_around(value);
  return value == "=" || (value.starts_with('{') && value.ends_with('}') && value.size() > 2);
}

// A plugin may have a port of this name, by pattern also one with dots: "goal.x".
bool may_be_port(std::string_view name) {
  if (name.ends_with('.')) return false;
  std::string without_dots(name);
  std::ranges::replace(without_dots, '.', '-');
  return is_port_name(without_dots);
}

constexpr std::string_view kReserved[] = {"root",   "BehaviorTree",   "SubTree", "include",
                                          "plugin", "TreeNodesModel", "arg"};

constexpr std::string_view kTreeDoc = "A stand-in for a tree.";

class Builder {
 public:
  Builder(const Project& project, const Models& models, const MockOutputs& outputs,
          const TreeIds& elsewhere, Catalog& catalog, const Reporter& report)
      : project_(project),
        models_(models),
        outputs_(outputs),
        elsewhere_(elsewhere),
        catalog_(catalog),
        report_(report) {}

  std::shared_ptr<const StandIns> build(MissingNodes unknown, const Mocks& mocks) {
    find_trees();
    for (std::size_t i = 0; i < project_.documents.size(); ++i) {
      space_ = project_.prefixes[i];
      find_uses(*project_.documents[i], unknown, mocks);
    }
    for (const auto& [id, use] : uses_) add(id, use, mocks);
    if (unknown == MissingNodes::AreMocked) tell_guessed();
    for (const auto& [id, mock] : mocks) check_mock(id);
    for (const auto& [port, text] : outputs_) check_output(port);
    return made_->is_empty() ? nullptr : made_;
  }

 private:
  template <class Visit>
  static void for_each_tree(const Document& document, Visit visit) {
    const auto elements = document.elements();
    for (const std::uint32_t child : children_in(elements, 0)) {
      if (elements[child].tag == "BehaviorTree") visit(child);
    }
  }

  void find_trees() {
    for (const auto& document : project_.documents) {
      for_each_tree(*document, [&](std::uint32_t tree) {
        if (const auto* id = document->find_attribute(tree, "ID")) trees_.insert(id->value);
      });
    }
    for (const Project::NamedFile& file : project_.named) trees_.insert(file.name);
  }

  void find_uses(const Document& document, MissingNodes unknown, const Mocks& mocks) {
    for_each_tree(document, [&](std::uint32_t tree) {
      for (auto node = tree + 1; node < document.elements()[tree].end; ++node) {
        if (is_subtree(document, node)) {
          find_tree(document, node, unknown);
          continue;
        }
        const std::string_view id = id_of(document, node);
        ids_.insert(id);
        if (mocks.contains(id) || (unknown != MissingNodes::AreErrors && is_unknown(id))) {
          const auto first = Use{.place = document.elements()[node].place};
          note_use(document, node, uses_.try_emplace(id, first).first->second, model_of(id));
        }
      }
    });
  }

  static bool is_subtree(const Document& document, std::uint32_t node) {
    const std::string_view tag = document.elements()[node].tag;
    if (tag != "SubTreePlus") return tag == "SubTree";
    const Attribute* format = document.find_attribute(0, "BTCPP_format");
    return format == nullptr || format->value != "4";  // a name of version 3
  }

  void find_tree(const Document& document, std::uint32_t node, MissingNodes unknown) {
    const Attribute* id = document.find_attribute(node, "ID");
    if (id == nullptr || id->value.empty() || trees_.contains(id->value)) return;
    if (catalog_.find(id->value) != nullptr) return;
    if (unknown == MissingNodes::AreErrors && !elsewhere_.contains(id->value)) return;
    ids_.insert(id->value);
    Use& use = uses_.try_emplace(id->value, Use{.place = id->place}).first->second;
    use.is_tree = true;
    use.space = space_;
    const Attribute* autoremap = document.find_attribute(node, "_autoremap");
    use.opens_entries |= autoremap != nullptr && parse_flag(autoremap->value) == true;
    note_use(document, node, use, nullptr);
  }

  static std::string_view id_of(const Document& document, std::uint32_t node) {
    const std::string_view tag = document.elements()[node].tag;
    if (!is_explicit_tag(tag)) return tag;
    const Attribute* id = document.find_attribute(node, "ID");
    return id == nullptr ? std::string_view() : id->value;
  }

  bool is_unknown(std::string_view id) const {
    return !id.empty() && catalog_.find(id) == nullptr && !trees_.contains(id) &&
           std::ranges::find(kReserved, id) == std::end(kReserved) && !is_old_name(id);
  }

  // The reader has a better message for it.
  static bool is_old_name(std::string_view id) {
    return std::ranges::any_of(languages(), [id](const LanguageRules* it) {
      return it->reader->is_old_name != nullptr && it->reader->is_old_name(id);
    });
  }

  // Null: a plugin has the leaf, or there is none.
  const Model* model_of(std::string_view id) const {
    const auto model = models_.nodes.find(id);
    return model == models_.nodes.end() || catalog_.find(id) != nullptr ? nullptr : &model->second;
  }

  void note_use(const Document& document, std::uint32_t node, Use& use, const Model* model) const {
    const auto elements = document.elements();
    const Element& element = elements[node];
    std::uint32_t children = 0;
    for ([[maybe_unused]] const auto child : children_in(elements, node)) ++children;
    use.children = std::max(use.children, children);
    use.fewest_children = std::min(use.fewest_children, children);
    for (const NodeCategory category : {NodeCategory::Action, NodeCategory::Condition,
                                        NodeCategory::Control, NodeCategory::Decorator}) {
      if (element.tag == explicit_tag(category)) use.category = category;
    }
    for (const Attribute& attribute : document.attributes(node)) {
      const bool is_own = attribute.name == "name" || attribute.name == "ID" ||
                          hook_named(attribute.name, *project_.rules).has_value() ||
                          is_of_actions(attribute.name, *project_.rules);
      if (is_own || !may_be_port(attribute.name)) continue;
      use.attributes.try_emplace(attribute.name, UsedAttribute{attribute.place, attribute.value});
      const ModelPort* port = model == nullptr ? nullptr : model->port(attribute.name);
      if (port == nullptr || fits(*port, attribute.value)) continue;
      use.misfits.try_emplace(attribute.name, UsedAttribute{attribute.place, attribute.value});
    }
  }

  bool fits(const ModelPort& port, std::string_view text) const {
    const auto type = type_of_cpp(port.type);
    if (names_entry(text)) return true;
    if (port.direction == Direction::Output) return false;
    if (!type) return true;
    if (project_.rules->strict_types) return parse_value(*type, text).has_value();
    const auto value = value_from_text(*type, nullptr, text);
    return value && !value->has_rest;
  }

  void add(std::string_view id, const Use& use, const Mocks& mocks) {
    const auto mock = mocks.find(id);
    const Model* const model = model_of(id);
    NodeType type{.id = made_->keep(id), .category = category(use), .doc = "A stand-in."};
    std::vector<Parameter> ports;
    const NodeType* known = catalog_.find(id);
    if (known != nullptr) {
      type.category = known->category;
      ports = ports_of(*known, use);
    } else if (model != nullptr) {
      if (is_as_modeled(use, model->category)) type.category = model->category;
      ports = ports_of(*model, use);
      warn_of_old_model(id, use, *model);
    } else {
      ports = ports_of(use);
    }
    type.arity = arity(type.category);
    type.can_run = type.category == NodeCategory::Action;
    type.reads_ports = true;
    if (use.is_tree) type.doc = kTreeDoc;
    type.opens_entries = use.opens_entries;
    const bool has_model = model != nullptr;
    type.is_guess = known == nullptr && !use.is_tree && !has_model && !use.category &&
                    mock == mocks.end() && type.category == NodeCategory::Action;
    Mock played = mock == mocks.end() ? Mock() : mock->second;
    played.outputs = outputs_of(id, ports);
    catalog_.replace(made_->add(type, std::move(ports), played));
    if (known != nullptr) return;
    if (use.is_tree) return tell_of_tree(id, use);
    if (type.is_guess) guessed_.push_back(id);
    tell(id, use.place, has_model, type.is_guess);
  }

  // Empty: it writes nothing.
  std::vector<Value> outputs_of(std::string_view id, std::span<const Parameter> ports) {
    std::vector<Value> outputs;
    for (const Parameter& port : ports) outputs.push_back(output_of(id, port));
    const bool writes = std::ranges::any_of(
        outputs, [](const Value& it) { return !std::holds_alternative<NoValue>(it); });
    if (!writes) outputs.clear();
    return outputs;
  }

  Value output_of(std::string_view id, const Parameter& port) {
    if (port.direction == Direction::Input) return {};
    auto given = outputs_.find(fmt::format("{}.{}", id, port.name));
    if (given == outputs_.end()) given = outputs_.find(port.name);
    if (given != outputs_.end()) {
      used_outputs_.insert(given->first);
      auto value = value_from_outside(port.is_generic, port.type, given->second);
      if (value) return *std::move(value);
      report_.nowhere("bad-option"_code,
                      fmt::format("--mock-output {}={}: '{}' of '{}' is {}", given->first,
                                  given->second, port.name, brief(id), expected_text(port.type)));
      return {};
    }
    const bool has_type = !port.is_generic && port.type != ValueType::Object;
    if (port.direction != Direction::Output || !has_type) return {};
    if (port.type == ValueType::Number) return std::int64_t{0};
    return with_type(port.type, []<class T>(std::type_identity<T>) { return Value(T{}); });
  }

  void check_output(std::string_view port) const {
    if (used_outputs_.contains(port)) return;
    report_.nowhere("bad-option"_code,
                    fmt::format("--mock-output {}: no stand-in has such an output", brief(port)),
                    "write PORT=VALUE, or ID.PORT=VALUE for one leaf");
  }

  std::vector<std::string_view> find_known_ids() const {
    std::vector<std::string_view> ids = catalog_.ids();
    if (project_.rules->reader->old_names != nullptr)
      std::ranges::copy(project_.rules->reader->old_names(*project_.documents.front()),
                        std::back_inserter(ids));
    return ids;
  }

  // A leaf with a model is meant only where a few letters differ: others may lack a model.
  std::vector<std::string_view> known_ids_near(std::string_view id) const {
    std::vector<std::string_view> ids = known_ids_;
    constexpr std::size_t kMostModels = 1000;  // a file may have a million
    for (const auto& [known, model] : models_.nodes | std::views::take(kMostModels))
      if (is_typo_of(id, known)) ids.push_back(known);
    return ids;
  }

  std::vector<std::string_view> unknown_ids() const {
    std::vector<std::string_view> ids;
    for (const auto& [id, use] : uses_) ids.push_back(id);
    return ids;
  }

  void check_mock(std::string_view id) const {
    if (!uses_.contains(id)) {
      const std::vector<std::string_view> ids(ids_.begin(), ids_.end());
      std::string hint = did_you_mean(id, ids);
      if (hint.empty()) {
        hint = "it takes the ID of a leaf, not its name";
        if (!uses_.empty()) hint += fmt::format(": {}", listed(unknown_ids()));
      }
      report_.nowhere("bad-option"_code,
                      fmt::format("--mock-leaf {}: the tree has no such node", brief(id)),
                      std::move(hint));
      return;
    }
    const NodeCategory category = catalog_.find(id)->category;
    if (category == NodeCategory::Action || category == NodeCategory::Condition) return;
    report_.nowhere("bad-option"_code,
                    fmt::format("--mock-leaf {}: only a leaf has a result", brief(id)),
                    "the result of other nodes comes from their children");
  }

  void tell(std::string_view id, Place place, bool has_model, bool is_guessed) const {
    std::string hint = has_model ? "the model in the file is used as a hint" : hint_of_plugin(id);
    if (hint.empty()) hint = hint_for_other_tools(id, catalog_);
    const std::string near = hint.empty() ? did_you_mean(id, known_ids_near(id)) : "";
    if (hint.empty()) hint = near;
    const Severity severity = near.empty() ? Severity::Note : Severity::Warning;
    if (report_.counted_only(severity)) return;
    if (hint.empty()) {
      hint = "its ports are not known, so they are not checked; --plugin loads a plugin";
    }
    report_.at("mocked-node"_code, place,
               fmt::format("no plugin has '{}'{}", brief(id),
                           is_guessed ? "; it is taken for an action" : ""),
               hint, severity);
  }

  void tell_of_tree(std::string_view full_id, const Use& use) const {
    const bool is_elsewhere = elsewhere_.contains(full_id);
    const Severity severity = is_elsewhere ? Severity::Note : Severity::Warning;
    if (report_.counted_only(severity)) return;
    // As the file has it, also where it is included under a name.
    const std::string_view id = id_in(use.space, full_id);
    if (is_elsewhere) {
      report_.at_value("tree-elsewhere"_code, use.place,
                       fmt::format("the tree '{}' is in another file", brief(id)),
                       "here it stands for an action", severity);
      return;
    }
    auto known = ids_in(use.space, trees_);
    if (use.space.empty()) {
      std::ranges::copy(elsewhere_, std::back_inserter(known));
      std::ranges::copy(project_.library_trees, std::back_inserter(known));
    }
    report_.at_value("unknown-tree"_code, use.place, fmt::format("unknown tree '{}'", brief(id)),
                     join_hints(did_you_mean(id, known),
                                "if another file has it, include that file; until then it stands "
                                "for an action"),
                     severity);
  }

  // Such a leaf takes a second, also where it is a condition.
  void tell_guessed() const {
    if (guessed_.empty()) return;
    const auto is_before = [this](std::string_view one, std::string_view other) {
      return uses_.at(one).place.byte < uses_.at(other).place.byte;
    };
    const std::string_view first = *std::ranges::min_element(guessed_, is_before);
    report_.at("mocked-node"_code, uses_.at(first).place,
               fmt::format("no plugin has {}: taken for {}", listed(guessed_),
                           guessed_.size() == 1 ? "an action" : "actions"),
               fmt::format("a condition is written <Condition ID=\"{}\"/>", brief(first)),
               Severity::Warning);
  }

  static NodeCategory category(const Use& use) {
    if (use.category) return *use.category;
    if (use.children == 0) return NodeCategory::Action;
    return use.children == 1 ? NodeCategory::Decorator : NodeCategory::Control;
  }

  static bool is_as_modeled(const Use& use, NodeCategory category) {
    const Arity allowed = arity(category);
    return use.fewest_children >= allowed.min && use.children <= allowed.max &&
           use.category.value_or(category) == category;
  }

  // The leaf decides what it takes, and a model may be older than the leaf: one warning for each
  // port.
  void warn_of_old_model(std::string_view id, const Use& use, const Model& model) const {
    constexpr std::string_view kHint = "a model is a hint: if it is older than the leaf, update it";
    const auto warn = [&](auto report_at, Place place, std::string message, std::string hint) {
      if (report_.counted_only(Severity::Warning)) return;
      (report_.*report_at)("old-model"_code, place, std::move(message),
                           join_hints(std::move(hint), kHint), Severity::Warning);
    };
    if (!is_as_modeled(use, model.category)) {
      warn(&Reporter::at, use.place,
           fmt::format("the model of '{}' declares {}, but the tree uses it as {}", brief(id),
                       kind_words(model.category), kind_words(category(use))),
           {});
    }
    std::vector<std::string_view> names;
    for (const ModelPort& port : model.ports) names.push_back(port.name);
    for (const auto& [name, attribute] : use.attributes) {
      if (model.port(name) != nullptr) continue;
      warn(&Reporter::at, attribute.place,
           fmt::format("the model of '{}' has no port '{}'", brief(id), brief(name)),
           did_you_mean(name, names));
    }
    for (const auto& [name, attribute] : use.misfits) {
      const ModelPort& port = *model.port(name);
      warn(&Reporter::at_value, attribute.place,
           port.direction == Direction::Output
               ? fmt::format("'{}' is an output in the model of '{}': what it writes is lost",
                             brief(name), brief(id))
               : fmt::format("'{}' is not {}, which '{}' is in the model of '{}'",
                             brief(attribute.value), expected_text(*type_of_cpp(port.type)),
                             brief(name), brief(id)),
           port.direction == Direction::Output ? fmt::format("write {}=\"{{key}}\"", brief(name))
                                               : "");
    }
  }

  static Arity arity(NodeCategory category) {
    if (category == NodeCategory::Control) return {.min = 1};
    return category == NodeCategory::Decorator ? Arity{1, 1} : Arity{0, 0};
  }

  // Those of the model, as far as the trees use them so, and those that the trees use.
  std::vector<Parameter> ports_of(const Model& model, const Use& use) {
    std::vector<Parameter> ports;
    for (const ModelPort& it : model.ports) {
      const auto type = type_of_cpp(it.type);
      if (use.misfits.contains(it.name)) {
        ports.push_back(generic(it.name));
      } else {
        ports.push_back({.name = made_->keep(it.name),
                         .type = type.value_or(ValueType::String),
                         .doc = {},
                         .direction = it.direction,
                         .is_generic = !type,
                         .is_hint = true});
      }
    }
    for (const auto& [name, attribute] : use.attributes) {
      if (model.port(name) == nullptr) ports.push_back(generic(name));
    }
    return ports;
  }

  std::vector<Parameter> ports_of(const Use& use) {
    std::vector<Parameter> ports;
    for (const auto& [name, attribute] : use.attributes) ports.push_back(generic(name));
    return ports;
  }

  // Those by pattern are not described for a leaf that does nothing.
  std::vector<Parameter> ports_of(const NodeType& known, const Use& use) {
    std::vector<Parameter> ports(known.parameters.begin(), known.parameters.end());
    for (const auto& [name, attribute] : use.attributes) {
      if (matches_any(known.more_parameters, name)) ports.push_back(generic(name));
    }
    return ports;
  }

  Parameter generic(std::string_view name) {
    return {.name = made_->keep(name),
            .type = ValueType::String,
            .doc = {},
            .direction = Direction::InOut,
            .is_generic = true};
  }

  const Project& project_;
  const Models& models_;
  const MockOutputs& outputs_;
  const TreeIds& elsewhere_;
  Catalog& catalog_;
  const Reporter& report_;
  std::shared_ptr<StandIns> made_ = std::make_shared<StandIns>();
  const std::vector<std::string_view> known_ids_ = find_known_ids();
  std::set<std::string_view> trees_, ids_, used_outputs_;
  std::string_view space_;  // of the document whose uses are found
  std::map<std::string_view, Use> uses_;
  std::vector<std::string_view> guessed_;  // leaves in compact form, without a model
};

}  // namespace

std::shared_ptr<const StandIns> add_stand_ins(const Project& project, const Models& models,
                                              MissingNodes unknown, const Mocks& mocks,
                                              const MockOutputs& outputs, const TreeIds& elsewhere,
                                              Catalog& catalog, const Reporter& report) {
  const bool may_lack = project.rules->may_lack_nodes;
  if (!may_lack && unknown == MissingNodes::AreNoted) unknown = MissingNodes::AreErrors;
  if (unknown == MissingNodes::AreErrors && mocks.empty() && elsewhere.empty()) return nullptr;
  return Builder(project, models, outputs, elsewhere, catalog, report).build(unknown, mocks);
}

const NodeType* stand_in_for_tree(std::span<const Attribute> attributes, const Catalog& catalog) {
  const Attribute* id = find_attribute(attributes, "ID");
  const NodeType* type = id == nullptr ? nullptr : catalog.find(id->value);
  return type != nullptr && type->doc == kTreeDoc ? type : nullptr;
}

}  // namespace lockstep::host
