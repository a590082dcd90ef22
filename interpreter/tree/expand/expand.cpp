#include "tree/expand/expand.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <utility>

#include "base/blackboard/conversion.h"
#include "base/core/audience.h"
#include "base/core/parameter_value.h"
#include "base/core/pre_order.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "tree/expand/readings.h"
#include "tree/expand/robots.h"
#include "tree/expand/scope.h"
#include "tree/types/literal.h"
#include "tree/types/script_entries.h"
#include "tree/types/type_words.h"

namespace lockstep::host {
namespace {

class Expander {
 public:
  Expander(CheckedTrees& trees, const StartValues& values, const Reporter& report,
           Expansion expansion, const StartValues& later)
      : trees_(trees),
        values_(values),
        later_(later),
        report_(report),
        is_part_(expansion == Expansion::OfPart) {}

  Definition expand(std::string_view main) {
    definition_.id = main;
    definition_.rules = trees_.rules;
    definition_.words = trees_.words;
    definition_.values = std::move(trees_.values);
    definition_.written = std::move(trees_.written);
    definition_.texts = std::move(trees_.texts);
    trees_.shared.resize(trees_.ports.size(), Port::kNone);
    members_.resize(trees_.groups.size());
    for (std::size_t i = 0; i < members_.size(); ++i) groups_.emplace(trees_.groups[i].name, i);
    definition_.nodes.reserve(trees_.nodes.size());  // without subtrees, all that will be needed
    definition_.ports.reserve(trees_.ports.size());
    const CheckedTree& tree = trees_.trees.at(main);
    Scope scope(definition_.entries, *trees_.rules, trees_.has_outside, groups_, tree.space);
    for (const auto& [key, text] : values_) scope.set_text(key, text);
    if (trees_.names_at_run_time) definition_.boards.emplace_back();
    definition_.shares_entries = trees_.shares_entries;
    add(tree.root, 0, scope);
    add_groups(scope);
    keep_board(0, scope);
    if (is_strict() && !is_part_)
      declare_entries(definition_, literals_, report_, guessed_, later_texts());
    for (const Hint& hint : hints_) compare(hint);
    check_set_keys(scope);
    for (const std::uint32_t it : shared_) trees_.shared[it] = Port::kNone;  // for the next tree
    return std::move(definition_);
  }

 private:
  void add(std::uint32_t from, std::uint32_t parent, Scope& scope) {
    const CheckedNode& checked = trees_.nodes[from];
    if (checked.type == nullptr) return;  // reported already
    const auto place = static_cast<std::uint32_t>(definition_.nodes.size());
    definition_.nodes.push_back({.type = checked.type,
                                 .end = 0,
                                 .parent = parent,
                                 .children = checked.children,
                                 .first = 0,
                                 .name = checked.name,
                                 .place = checked.place,
                                 .written = checked.written,
                                 .at_cut = checked.at_cut});
    if (checked.scripts != Port::kNone) {
      definition_.nodes[place].hooks = bind_hooks(checked.scripts, scope);
    }
    const CheckedNode* group = nullptr;
    if (checked.type->category == NodeCategory::SubTree) {
      definition_.nodes[place].children = 1;
      enter_subtree(trees_.subtrees[checked.first], checked.name, place, scope);
    } else if (!checked.type->parameters.empty()) {
      definition_.nodes[place].first = bind_ports(checked, scope);
      group = join_group(place, checked, scope);
    }
    for (const std::uint32_t child : children_in(trees_.nodes, from)) {
      add(child, place, scope);
    }
    if (group != nullptr) add_others(place, *group);
    definition_.nodes[place].end = static_cast<std::uint32_t>(definition_.nodes.size());
  }

  // The team of that name in the file that declares the pool, else in one that includes it: a file
  // that is included with as="north" declares "north.trucks".
  Scope::Groups::const_iterator find_team(std::string_view name, std::string_view pool) const {
    for (std::string_view space = pool; !space.empty(); space.remove_suffix(1)) {
      space = space.substr(0, space.rfind('.') + 1);
      const auto it = groups_.find(std::string(space) + std::string(name));
      if (it != groups_.end() && trees_.groups[it->second].type->is_of_robots) return it;
      if (space.empty()) break;
    }
    return groups_.end();
  }

  // A node inside of one that uses resources which the team shares: another robot may wait for
  // these while it is waited for.
  void warn_of_waiting(std::uint32_t place, std::string_view team, std::string_view what,
                       std::string_view hint) {
    for (std::uint32_t node = place; definition_.nodes[node].parent != node;) {
      node = definition_.nodes[node].parent;
      for (std::size_t i = 0; i < members_.size(); ++i) {
        const CheckedNode& pool = trees_.groups[i];
        if (pool.type->synchronization != Synchronization::Resources) continue;
        if (std::ranges::find(members_[i], node) == members_[i].end()) continue;
        const auto shared_by = find_team(team_of(trees_, definition_.values, pool), pool.name);
        if (shared_by == groups_.end() || shared_by->first != team) continue;
        report_.at("deadlock"_code, definition_.nodes[place].place,
                   fmt::format("'{}' {} while this robot has resources of the pool '{}', for which "
                               "another one may wait",
                               brief(definition_.nodes[place].name), what, brief(pool.name)),
                   std::string(hint), Severity::Warning);
        return;
      }
    }
  }

  // What stands for other robots, where the group is one of them or is shared by them.
  void add_others(std::uint32_t place, const CheckedNode& group) {
    if (group.type->is_of_robots) {
      warn_of_waiting(place, group.name, "waits for the other robots",
                      "use them between two barriers, and verify the trees of all robots together");
      return add_robots(definition_, trees_, group, place, report_);
    }
    if (group.type->synchronization != Synchronization::Resources) return;
    const std::string_view name = team_of(trees_, definition_.values, group);
    if (name.empty()) return;
    const auto team = find_team(name, group.name);
    if (team == groups_.end()) {
      if (unknown_groups_.emplace(group.place.byte, name).second) {
        report_.at("unknown-group"_code, group.place, fmt::format("unknown team '{}'", brief(name)),
                   fmt::format("declare it in 'root': <team name=\"{}\" …/>", brief(name)));
      }
      return;
    }
    const auto [pool, is_first] = pool_of_team_.emplace(team->second, &group);
    if (!is_first && pool->second != &group) {
      report_.at("member-twice"_code, group.place,
                 fmt::format("the team '{}' shares the pool '{}' already", brief(name),
                             brief(pool->second->name)),
                 "a team shares one pool: put the resources into that one");
      return;
    }
    warn_of_waiting(place, team->first, "asks for more of them",
                    "name all that it needs in the outer UseResources");
    add_asker(definition_, trees_, group, trees_.groups[team->second], place, askers_[&group]++,
              report_);
  }

  void enter_subtree(const CheckedSubTree& subtree, std::string_view name, std::uint32_t place,
                     Scope& outer) {
    const auto tree = trees_.trees.find(subtree.id);
    if (tree == trees_.trees.end()) return;  // reported already
    Scope scope(outer, name, subtree.autoremap, tree->second.space);
    const auto remappings = std::span(trees_.remappings).subspan(subtree.first, subtree.remappings);
    for (const Remapping& it : remappings) {
      it.is_entry ? scope.remap(it.key, it.value) : scope.set_text(it.key, it.value);
    }
    add_inner(tree->second.root, place, scope);
    for (const Remapping& it : remappings) {
      const bool may_be_used = trees_.names_at_run_time || scope.used(it.key);
      if (!it.is_written || may_be_used || report_.counted_only(Severity::Warning)) continue;
      auto keys = scope.open_keys();
      for (const Remapping& other : remappings)  // what has only the default of the model
        if (!other.is_written) keys.push_back(other.key);
      report_.at(
          "unused-entry"_code, it.place,
          fmt::format("the tree '{}' does not use '{{{}}}'", brief(subtree.id), brief(it.key)),
          suggest(it.key, keys, "it also uses"), Severity::Warning);
    }
  }

  // The tree of the SubTree at `place`, with a board for it.
  void add_inner(std::uint32_t root, std::uint32_t place, Scope& scope) {
    const std::uint32_t outside = std::exchange(board_, count(definition_.boards));
    if (trees_.names_at_run_time) {
      definition_.boards.push_back({.parent = outside, .node = place});
    }
    const std::uint32_t around = std::exchange(inside_, place);
    add(root, place, scope);
    inside_ = around;
    keep_board(board_, scope);
    board_ = outside;
  }

  // When all of its entries are known.
  void keep_board(std::uint32_t number, const Scope& scope) {
    if (!trees_.names_at_run_time) return;
    Board& board = definition_.boards[number];
    Board kept = scope.board();
    kept.parent = board.parent;
    kept.node = board.node;
    board = std::move(kept);
  }

  template <class T>
  static std::uint32_t count(const std::vector<T>& all) {
    return static_cast<std::uint32_t>(all.size());
  }

  // The groups that have members, each with its parameters in the scope of the main tree.
  void add_groups(Scope& scope) {
    for (std::size_t i = 0; i < trees_.groups.size(); ++i) {
      const CheckedNode& group = trees_.groups[i];
      if (group.type->is_of_robots && members_[i].size() > 1 && !is_part_) {
        report_.at("member-twice"_code, definition_.nodes[members_[i][1]].place,
                   fmt::format("two nodes of '{}' are in step with the team '{}'",
                               brief(definition_.id), brief(group.name)),
                   "a robot is one member, once: declare a team for each");
      }
      if (group.type->is_of_robots && (!members_[i].empty() || pool_of_team_.contains(i))) continue;
      if (members_[i].empty()) {
        if (is_part_ || report_.has_errors()) continue;  // it may be for want of what they refuse
        // A file that has a name declares it for a run alone, and a SubTree gives another one.
        if (group.name.find('.') != std::string_view::npos) continue;
        report_.at("unused-group"_code, group.place,
                   fmt::format("no node of '{}' uses the {} '{}'", brief(definition_.id),
                               group.type->id, brief(group.name)),
                   {}, Severity::Note);
        continue;
      }
      const auto place = static_cast<std::uint32_t>(definition_.nodes.size());
      definition_.groups.push_back({place, std::move(members_[i])});
      definition_.nodes.push_back({.type = group.type,
                                   .end = place + 1,
                                   .parent = place,
                                   .children = 0,
                                   .first = bind_ports(group, scope),
                                   .name = group.name,
                                   .place = group.place,
                                   .written = group.written});
    }
  }

  // Adds a node to the group that one of its parameters names, if there is such a parameter.
  const CheckedNode* join_group(std::uint32_t place, const CheckedNode& checked, Scope& scope) {
    const auto& parameters = checked.type->parameters;
    for (std::uint32_t i = 0; i < parameters.size(); ++i) {
      const CheckedPort& port = trees_.ports[checked.first + i];
      if (parameters[i].group.empty() || port.value == Port::kNone) continue;
      const std::string_view written = std::get<std::string>(definition_.values[port.value]);
      const std::string_view name = scope.group(written);
      const auto group = groups_.find(name);
      if (group != groups_.end() && trees_.groups[group->second].type->id == parameters[i].group) {
        members_[group->second].push_back(place);
        return &trees_.groups[group->second];
      }
      if (unknown_groups_.emplace(port.place.byte, name).second)
        unknown_group(parameters[i], port.place, written, name);
      break;
    }
    return nullptr;
  }

  void unknown_group(const Parameter& parameter, Place place, std::string_view written,
                     std::string_view name) const {
    if (is_part_ || report_.counted_only(Severity::Error)) return;
    const std::string_view type = parameter.group;
    std::vector<std::string_view> names;
    for (const CheckedNode& it : trees_.groups) {
      if (it.type->id == type) names.push_back(it.name);
    }
    std::string hint = suggest(name, names, fmt::format("declared with <{}>", type));
    if (hint.empty())
      hint = fmt::format("declare it in 'root': <{} name=\"{}\" …/>", type, brief(name));
    const std::string origin =
        name == written ? "" : fmt::format(", which a SubTree gives for '{}'", brief(written));
    report_.at_value("unknown-group"_code, place,
                     fmt::format("unknown {} '{}'{}", parameter.name, brief(name), origin), hint);
  }

  // Where nothing comes from an entry, all expansions of a tree share their ports.
  std::uint32_t bind_ports(const CheckedNode& checked, Scope& scope) {
    if (trees_.shared[checked.first] != Port::kNone) return trees_.shared[checked.first];
    const auto first = static_cast<std::uint32_t>(definition_.ports.size());
    const auto& parameters = checked.type->parameters;
    definition_.ports.resize(first + parameters.size());
    Port* bound = definition_.ports.data() + first;
    const CheckedPort* port = trees_.ports.data() + checked.first;
    bool constant = true;
    for (const Parameter& parameter : parameters) {
      const bool is_script = port->value != Port::kNone && parameter.is_script;
      if (port->key.empty() && !is_script) {
        bound->value = port->value;
      } else {
        constant = false;
        *bound = bind(*port, parameter, *checked.type, scope);
      }
      ++bound, ++port;
    }
    if (constant) {
      trees_.shared[checked.first] = first;
      shared_.push_back(checked.first);
    }
    return first;
  }

  // Binds a parameter that is not a constant.
  Port bind(const CheckedPort& port, const Parameter& parameter, const NodeType& type,
            Scope& scope) {
    if (port.key.empty()) return {.script = bind_script(trees_.scripts[port.value], scope)};
    if (parameter.is_script) {
      return {.script = add_script({.entries = {use(port, parameter, scope)}})};
    }
    const bool is_none = parameter.own_only && port.is_name(parameter) && !scope.is_own(port.key);
    Port bound{.value = port.value};
    if (!is_none) {
      if (parameter.is_hint) {
        bound.entry = use_hinted(port, parameter, type, scope);
      } else if (is_guessed(type, parameter)) {
        bound.entry = use_guessed(port, scope);
      } else {
        bound.entry = use(port, parameter, scope);
      }
    }
    return bound;
  }

  // Those of one node; `script` is its first.
  std::uint32_t bind_hooks(std::uint32_t script, Scope& scope) {
    NodeHooks hooks;
    hooks.fill(Port::kNone);
    while (true) {
      const CheckedScript& it = trees_.scripts[script++];
      hooks[static_cast<std::size_t>(it.hook)] = bind_script(it, scope);
      if (it.is_last) break;
    }
    definition_.hooks.push_back(hooks);
    return static_cast<std::uint32_t>(definition_.hooks.size() - 1);
  }

  std::uint32_t bind_script(const CheckedScript& script, Scope& scope) {
    BoundScript bound{.code = script.code, .inside = inside_, .place = script.place};
    for (const std::string& name : script.code->names()) {
      bound.entries.push_back(find(name, scope));
    }
    bind_renamed(bound, scope);
    return add_script(std::move(bound));
  }

  static void bind_renamed(BoundScript& script, Scope& scope) {
    const auto readings = script.code->readings();
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const std::string_view group = scope.renamed_group(group_in(readings[i]));
      if (group.empty()) continue;
      script.renamed.resize(readings.size());
      script.renamed[i] = group;
    }
  }

  std::uint32_t add_script(BoundScript script) {
    definition_.scripts.push_back(std::move(script));
    return static_cast<std::uint32_t>(definition_.scripts.size() - 1);
  }

  // Without strict types, a start value has a type by itself until a port has another one.
  std::uint32_t find(std::string_view key, Scope& scope) {
    const Scope::Found found = scope.find(key);
    if (!found.has_text) return found.entry;
    literals_.emplace(found.entry, found.text);
    if (is_strict()) return found.entry;
    BlackboardEntry& entry = definition_.entries[found.entry];
    entry.type = literal_type(found.text);
    entry.initial = value_from_text(entry.type, nullptr, found.text)->value;
    entry.typing = Typing::Declared;
    entry.is_present = true;
    return found.entry;
  }

  // The entry of a stand-in for a node that no plugin has, and of an input of any type, gets the
  // type that others give it.
  bool is_guessed(const NodeType& type, const Parameter& parameter) const {
    const bool takes_any = type.mock != nullptr || parameter.direction == Direction::Input;
    return is_strict() && takes_any && parameter.is_generic;
  }

  std::uint32_t use_guessed(const CheckedPort& port, Scope& scope) {
    guessed_.push_back(find(port.key, scope));
    BlackboardEntry& entry = definition_.entries[guessed_.back()];
    if (!entry.is_present) entry.first_use = port.place;
    return guessed_.back();
  }

  // The type that a model says is none of the entry: the leaf may have another one.
  std::uint32_t use_hinted(const CheckedPort& port, const Parameter& parameter,
                           const NodeType& type, Scope& scope) {
    Parameter any = parameter;
    any.is_generic = true;
    any.type = ValueType::String;
    const std::uint32_t entry = is_strict() ? use_guessed(port, scope) : use(port, any, scope);
    if (!parameter.is_generic) hints_.push_back({entry, port.place, &parameter, type.id});
    return entry;
  }

  // What a model says of an entry.
  struct Hint {
    std::uint32_t entry;
    Place place;
    const Parameter* parameter;
    std::string_view node;  // the type
  };

  // With the type of the entry or, where it has none, with the first model that says one.
  void compare(const Hint& hint) {
    const Parameter& parameter = *hint.parameter;
    BlackboardEntry entry = definition_.entries[hint.entry];
    if (entry.typing == Typing::Any) {
      const Hint& first = first_hints_.try_emplace(hint.entry, hint).first->second;
      entry.type = first.parameter->type;
      entry.typing = Typing::Declared;
      entry.first_use = first.place;
    }
    if (fits(parameter, entry) || !told_hints_.emplace(hint.node, parameter.name).second) return;
    if (report_.counted_only(Severity::Warning)) return;
    report_.at_value(
        "entry-type"_code, hint.place,
        fmt::format("'{}' is {} for '{}' in the model of '{}', but {} elsewhere", brief(entry.name),
                    with_article(parameter.type, nullptr), parameter.name, brief(hint.node),
                    with_article(entry.type, entry.object)),
        other_use(entry) + "; a model is a hint: if it is older than the leaf, update it",
        Severity::Warning);
  }

  std::uint32_t use(const CheckedPort& port, const Parameter& parameter, Scope& scope) {
    const std::uint32_t index = find(port.key, scope);
    if (port.is_name(parameter)) return index;
    BlackboardEntry& entry = definition_.entries[index];
    const auto literal = literals_.find(index);
    if (literal != literals_.end() && takes_type(parameter, entry)) {
      set_type(port.place, parameter, entry);
      set_initial(port.place, parameter, literal->second, entry);
      literals_.erase(literal);
    } else if (!entry.is_present) {
      set_type(port.place, parameter, entry);
    } else if (entry.type == ValueType::Number && is_number(parameter.type)) {
      narrow(port.place, parameter, entry);
    } else if (!fits(parameter, entry)) {
      report_.at_value("entry-type"_code, port.place,
                       fmt::format("'{{{}}}' is {} for '{}', but {} elsewhere", brief(port.key),
                                   with_article(parameter.type, parameter.object), parameter.name,
                                   with_article(entry.type, entry.object)),
                       other_use(entry));
    } else if (!can_cross(parameter, entry)) {
      report_.at_value(
          "process-border"_code, port.place,
          fmt::format("'{{{}}}' carries a {} between processes, but the plugin of one of its uses "
                      "has no to_bytes and from_bytes for it",
                      brief(port.key), entry.object->name()),
          other_use(entry));
    }
    return index;
  }

  // Whether a start value is read as the port says. Without strict types, a text stays one: ports
  // of other types read it.
  bool takes_type(const Parameter& parameter, const BlackboardEntry& entry) const {
    return !is_generic(parameter) && (is_strict() || entry.type != ValueType::String);
  }

  void set_type(Place place, const Parameter& parameter, BlackboardEntry& entry) const {
    entry.is_present = true;
    entry.typing = is_strict()             ? Typing::Strict
                   : is_generic(parameter) ? Typing::Any
                                           : Typing::Declared;
    entry.type = parameter.type;
    entry.object = parameter.object;
    entry.first_use = place;
  }

  // Takes an entry of any type.
  static bool is_generic(const Parameter& parameter) {
    return parameter.names_entry || parameter.is_generic;
  }

  bool is_strict() const { return trees_.rules->strict_types; }

  bool fits(const Parameter& parameter, const BlackboardEntry& entry) const {
    if (!is_strict() &&
        (is_generic(parameter) || entry.typing == Typing::Any || entry.type == ValueType::String)) {
      return true;
    }
    if (parameter.type == ValueType::Number && is_number(entry.type)) return true;
    if (parameter.type != entry.type) return false;
    if (parameter.type != ValueType::Object) return true;
    const std::string_view name = entry.object->name();
    return parameter.direction == Direction::Input && !is_strict()
               ? parameter.object->reads(name)
               : parameter.object->name() == name;
  }

  // An object of another process is bytes in this one. What is no object yet, such as a text that a
  // port of an object reads, becomes one where it is read.
  static bool can_cross(const Parameter& parameter, const BlackboardEntry& entry) {
    if (parameter.object == nullptr || entry.object == nullptr) return true;
    return parameter.object->is_packed() == entry.object->is_packed() ||
           (parameter.object->has_bytes() && entry.object->has_bytes());
  }

  std::string other_use(const BlackboardEntry& entry) const {
    return fmt::format("the other use is at {}",
                       to_text(report_.sources().locate(entry.first_use)));
  }

  static bool is_number(ValueType type) {
    return type == ValueType::Int || type == ValueType::Double;
  }

  // Until now, all uses of the entry took an int or a double; this one takes one of them.
  void narrow(Place place, const Parameter& parameter, BlackboardEntry& entry) {
    entry.type = parameter.type;
    if (std::holds_alternative<NoValue>(entry.initial)) return;
    const std::string text = to_text(std::exchange(entry.initial, Value()));
    set_initial(place, parameter, text, entry);
  }

  void set_initial(Place place, const Parameter& parameter, std::string_view text,
                   BlackboardEntry& entry) {
    if (auto value = start_value(parameter, text)) {
      entry.initial = *std::move(value);
      return;
    }
    const std::string why = why_no_object(parameter.object, text);
    report_.at_value("bad-start-value"_code, place,
                     fmt::format("the start value '{}' of '{}' is not {}, which '{}' must be",
                                 brief(text), brief(entry.name),
                                 expected_text(parameter.type, parameter.object), parameter.name),
                     fmt::format("it comes from {} or from an attribute of a SubTree{}{}",
                                 worded("--set", "the project"), why.empty() ? "" : "; ", why));
  }

  std::optional<Value> start_value(const Parameter& parameter, std::string_view text) const {
    if (is_strict()) return parse_value(parameter.type, parameter.object, text);
    auto read = value_from_text(parameter.type, parameter.object, text);
    if (!read || read->has_rest) return std::nullopt;
    return std::move(read->value);
  }

  StartTexts later_texts() const {
    StartTexts texts;
    for (std::uint32_t i = 0; i < definition_.entries.size(); ++i) {
      const auto value = later_.find(definition_.entries[i].name);
      if (value != later_.end()) texts.emplace(i, value->second);
    }
    return texts;
  }

  void check_set_keys(const Scope& scope) {
    std::vector<std::string_view> keys;
    for (const BlackboardEntry& entry : definition_.entries) {
      if (entry.name.find('/') == std::string::npos) keys.push_back(entry.name);
    }
    for (const auto& [key, text] : values_) {
      if (scope.used(key)) continue;
      report_.nowhere("bad-option"_code,
                      fmt::format("{0} {1}: the main tree does not use '{{{1}}}'",
                                  worded("--set", "start value of"), key),
                      suggest(key, keys, "entries of the main tree"));
    }
  }

  CheckedTrees& trees_;
  const StartValues& values_;
  const StartValues& later_;
  const Reporter& report_;
  const bool is_part_;
  Definition definition_;
  Scope::Groups groups_;                             // by name: its place in trees_.groups
  std::vector<std::vector<std::uint32_t>> members_;  // of each of them
  std::set<std::pair<std::uint32_t, std::string>> unknown_groups_;  // reported: where, name
  std::map<std::size_t, const CheckedNode*> pool_of_team_;          // by the place of the team
  std::map<const CheckedNode*, std::uint32_t> askers_;  // how many nodes use it, of such pools
  StartTexts literals_;                                 // those whose type no port gave yet
  std::vector<std::uint32_t> guessed_;                  // entries that stand-ins use
  std::vector<Hint> hints_;
  std::map<std::uint32_t, Hint> first_hints_;                           // by their entry
  std::set<std::pair<std::string_view, std::string_view>> told_hints_;  // node, port
  std::uint32_t inside_ = 0;           // the SubTree whose tree is being added
  std::uint32_t board_ = 0;            // of the tree that is being added, when boards are kept
  std::vector<std::uint32_t> shared_;  // those of CheckedTrees::shared that are set
};

}  // namespace

Definition expand(CheckedTrees& trees, std::string_view main, const StartValues& values,
                  const Reporter& report, Expansion expansion, const StartValues& later) {
  return Expander(trees, values, report, expansion, later).expand(main);
}

void take_back(CheckedTrees& trees, Definition definition) {
  trees.values = std::move(definition.values);
  trees.written = std::move(definition.written);
  trees.texts = std::move(definition.texts);
}

}  // namespace lockstep::host
