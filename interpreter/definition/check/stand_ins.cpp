#include "definition/check/stand_ins.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <set>
#include <vector>

#include "core/element_types.h"
#include "core/identifier.h"
#include "core/pre_order.h"
#include "core/suggest.h"
#include "core/wording.h"
#include "definition/check/node_check.h"
#include "definition/language_reader.h"

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

// How the trees use a node.
struct Use {
  Place place;                                // the first
  std::optional<NodeCategory> category = {};  // as an explicit tag says
  std::uint32_t children = 0;                 // the most
  std::set<std::string_view> attributes = {};
};

// A plugin may have a port of this name, by pattern also one with dots: "goal.x".
bool may_be_port(std::string_view name) {
  if (name.ends_with('.')) return false;
  std::string without_dots(name);
  std::ranges::replace(without_dots, '.', '-');
  return is_port_name(without_dots);
}

constexpr std::string_view kReserved[] = {"root",   "BehaviorTree",   "SubTree", "include",
                                          "plugin", "TreeNodesModel", "arg"};

class Builder {
 public:
  Builder(const Project& project, const Models& models, Catalog& catalog, const Reporter& report)
      : project_(project), models_(models), catalog_(catalog), report_(report) {}

  std::shared_ptr<const StandIns> build(MissingNodes unknown, const Mocks& mocks) {
    find_trees();
    for (const auto& document : project_.documents) find_uses(*document, unknown, mocks);
    for (const auto& [id, use] : uses_) add(id, use, mocks);
    if (unknown == MissingNodes::AreMocked) tell_guessed();
    for (const auto& [id, mock] : mocks) check_mock(id);
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
  }

  void find_uses(const Document& document, MissingNodes unknown, const Mocks& mocks) {
    for_each_tree(document, [&](std::uint32_t tree) {
      for (auto node = tree + 1; node < document.elements()[tree].end; ++node) {
        const std::string_view id = id_of(document, node);
        ids_.insert(id);
        if (mocks.contains(id) || (unknown != MissingNodes::AreErrors && is_unknown(id))) {
          note_use(
              document, node,
              uses_.try_emplace(id, Use{.place = document.elements()[node].place}).first->second);
        }
      }
    });
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

  void note_use(const Document& document, std::uint32_t node, Use& use) const {
    const auto elements = document.elements();
    const Element& element = elements[node];
    std::uint32_t children = 0;
    for ([[maybe_unused]] const auto child : children_in(elements, node)) ++children;
    use.children = std::max(use.children, children);
    for (const NodeCategory category : {NodeCategory::Action, NodeCategory::Condition,
                                        NodeCategory::Control, NodeCategory::Decorator}) {
      if (element.tag == explicit_tag(category)) use.category = category;
    }
    for (const Attribute& attribute : document.attributes(node)) {
      const bool is_own = attribute.name == "name" || attribute.name == "ID" ||
                          hook_named(attribute.name, *project_.rules).has_value();
      if (!is_own && may_be_port(attribute.name)) use.attributes.insert(attribute.name);
    }
  }

  void add(std::string_view id, const Use& use, const Mocks& mocks) {
    const auto mock = mocks.find(id);
    const auto model = models_.nodes.find(id);
    NodeType type{.id = made_->keep(id), .category = category(use), .doc = "A stand-in."};
    std::vector<Parameter> ports;
    const NodeType* known = catalog_.find(id);
    if (known != nullptr) {
      type.category = known->category;
      ports = ports_of(*known, use);
    } else if (model != models_.nodes.end()) {
      type.category = model->second.category;
      ports = ports_of(model->second);
    } else {
      ports = ports_of(use);
    }
    type.arity = arity(type.category);
    type.can_run = type.category == NodeCategory::Action;
    type.reads_ports = true;
    catalog_.replace(
        made_->add(type, std::move(ports), mock == mocks.end() ? Mock() : mock->second));
    if (known != nullptr) return;
    const bool has_model = model != models_.nodes.end();
    const bool is_guessed =
        !has_model && !use.category && mock == mocks.end() && type.category == NodeCategory::Action;
    if (is_guessed) guessed_.push_back(id);
    tell(id, use.place, has_model, is_guessed);
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
      report_.nowhere(fmt::format("--mock-leaf {}: the tree has no such node", brief(id)),
                      std::move(hint));
      return;
    }
    const NodeCategory category = catalog_.find(id)->category;
    if (category == NodeCategory::Action || category == NodeCategory::Condition) return;
    report_.nowhere(fmt::format("--mock-leaf {}: only a leaf has a result", brief(id)),
                    "the result of other nodes comes from their children");
  }

  void tell(std::string_view id, Place place, bool has_model, bool is_guessed) const {
    if (report_.counted_only(Severity::Note)) return;
    std::string hint =
        has_model ? "it is checked against the model in the file" : did_you_mean(id, known_ids_);
    if (hint.empty()) {
      hint = "its ports are not known, so they are not checked; --plugin loads a plugin";
    }
    report_.at(place,
               fmt::format("no plugin has '{}'{}", brief(id),
                           is_guessed ? "; it is taken for an action" : ""),
               hint, Severity::Note);
  }

  // Such a leaf takes a second, also where it is a condition.
  void tell_guessed() const {
    if (guessed_.empty()) return;
    const auto is_before = [this](std::string_view one, std::string_view other) {
      return uses_.at(one).place.byte < uses_.at(other).place.byte;
    };
    const std::string_view first = *std::ranges::min_element(guessed_, is_before);
    report_.at(uses_.at(first).place,
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

  static Arity arity(NodeCategory category) {
    if (category == NodeCategory::Control) return {.min = 1};
    return category == NodeCategory::Decorator ? Arity{1, 1} : Arity{0, 0};
  }

  std::vector<Parameter> ports_of(const Model& model) {
    std::vector<Parameter> ports;
    for (const ModelPort& it : model.ports) {
      const auto type = type_of_cpp(it.type);
      ports.push_back({.name = made_->keep(it.name),
                       .type = type.value_or(ValueType::String),
                       .doc = {},
                       .direction = it.direction,
                       .is_generic = !type});
    }
    return ports;
  }

  std::vector<Parameter> ports_of(const Use& use) {
    std::vector<Parameter> ports;
    for (const std::string_view name : use.attributes) ports.push_back(generic(name));
    return ports;
  }

  // Those by pattern are not described for a leaf that does nothing.
  std::vector<Parameter> ports_of(const NodeType& known, const Use& use) {
    std::vector<Parameter> ports(known.parameters.begin(), known.parameters.end());
    for (const std::string_view name : use.attributes) {
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
  Catalog& catalog_;
  const Reporter& report_;
  std::shared_ptr<StandIns> made_ = std::make_shared<StandIns>();
  const std::vector<std::string_view> known_ids_ = catalog_.ids();
  std::set<std::string_view> trees_, ids_;
  std::map<std::string_view, Use> uses_;
  std::vector<std::string_view> guessed_;  // leaves in compact form, without a model
};

}  // namespace

std::shared_ptr<const StandIns> add_stand_ins(const Project& project, const Models& models,
                                              MissingNodes unknown, const Mocks& mocks,
                                              Catalog& catalog, const Reporter& report) {
  const bool may_lack = project.rules->may_lack_nodes;
  if (!may_lack && unknown == MissingNodes::AreNoted) unknown = MissingNodes::AreErrors;
  if (unknown == MissingNodes::AreErrors && mocks.empty()) return nullptr;
  return Builder(project, models, catalog, report).build(unknown, mocks);
}

}  // namespace lockstep::host
