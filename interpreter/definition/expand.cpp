#include "definition/expand.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/identifier.h"
#include "core/suggest.h"
#include "core/wording.h"
#include "definition/attributes.h"
#include "definition/scope.h"
#include "document/reporter.h"

namespace lockstep {
namespace {

std::string with_article(ValueType type) {
  return fmt::format("{} {}", type == ValueType::Int ? "an" : "a", to_string(type));
}

class Expander {
 public:
  Expander(const Project& project, CheckedTrees& trees, const ResolveOptions& options,
           Diagnostics& diagnostics)
      : project_(project), trees_(trees), options_(options), diagnostics_(diagnostics) {}

  Definition expand(std::string_view main) {
    definition_.id = main;
    definition_.values = std::move(trees_.values);
    shared_.assign(trees_.ports.size(), Port::kNone);
    definition_.nodes.reserve(trees_.nodes.size());  // without subtrees, all that will be needed
    Scope scope(definition_.entries);
    for (const auto& [key, text] : options_.values) scope.set_text(key, text);
    add(trees_.trees.at(main).root, 0, scope);
    check_set_keys(scope);
    return std::move(definition_);
  }

 private:
  struct Use {  // where an entry got its type
    std::uint32_t document, element;
    std::string_view port;
  };

  void add(std::uint32_t from, std::uint32_t parent, Scope& scope) {
    const CheckedNode& checked = trees_.nodes[from];
    const Reporter report(*project_.documents[checked.document], diagnostics_);
    if (checked.type == nullptr) return;  // reported already
    const auto place = static_cast<std::uint32_t>(definition_.nodes.size());
    definition_.nodes.push_back({.type = checked.type,
                                 .end = 0,
                                 .parent = parent,
                                 .children = checked.children,
                                 .first = checked.first,
                                 .name = checked.name,
                                 .document = checked.document,
                                 .element = checked.element});
    if (checked.type->category == NodeCategory::SubTree) {
      definition_.nodes[place].children = 1;
      enter_subtree(report, checked, place, scope);
    } else if (!checked.type->parameters.empty()) {
      definition_.nodes[place].first = bind_ports(report, checked, scope);
    }
    for (std::uint32_t child = from + 1; child < checked.end; child = trees_.nodes[child].end) {
      add(child, place, scope);
    }
    definition_.nodes[place].end = static_cast<std::uint32_t>(definition_.nodes.size());
  }

  void enter_subtree(const Reporter& report, const CheckedNode& checked, std::uint32_t place,
                     Scope& outer) {
    const auto tree = trees_.trees.find(checked.subtree);
    if (tree == trees_.trees.end()) return;  // reported already
    const Document& document = *project_.documents[checked.document];
    const Attribute* autoremap = document.find_attribute(checked.element, "_autoremap");
    Scope scope(
        outer, std::string(checked.name) + "/",
        autoremap != nullptr && parse_value(ValueType::Bool, autoremap->value) == Value(true));
    for_each_remapping(document, checked.element, [&](const Attribute& attribute) {
      const auto key = key_of(attribute.value);
      key.empty() ? scope.set_text(attribute.name, attribute.value)
                  : scope.remap(attribute.name, key);
    });
    add(tree->second.root, place, scope);
    for_each_remapping(document, checked.element, [&](const Attribute& attribute) {
      if (scope.used(attribute.name) || report.counted_only(Severity::Warning)) return;
      report.at_attribute(checked.element, attribute.name,
                          fmt::format("the tree '{}' does not use '{{{}}}'", brief(checked.subtree),
                                      brief(attribute.name)),
                          suggest(attribute.name, scope.open_keys(), "it also uses"),
                          Severity::Warning);
    });
  }

  template <class Visit>
  static void for_each_remapping(const Document& document, std::uint32_t element, Visit visit) {
    for (const Attribute& attribute : document.attributes(element)) {
      const bool is_own = is_common_attribute(attribute.name) || attribute.name == "ID" ||
                          attribute.name.starts_with('_');
      if (!is_own && is_identifier(attribute.name)) visit(attribute);  // else reported already
    }
  }

  // Where nothing comes from an entry, all expansions of a tree share their ports.
  std::uint32_t bind_ports(const Reporter& report, const CheckedNode& checked, Scope& scope) {
    if (shared_[checked.first] != Port::kNone) return shared_[checked.first];
    const auto first = static_cast<std::uint32_t>(definition_.ports.size());
    bool constant = true;
    for (std::uint32_t i = 0; i < checked.type->parameters.size(); ++i) {
      const CheckedPort& port = trees_.ports[checked.first + i];
      Port bound{.value = port.value};
      if (!port.key.empty()) {
        constant = false;
        bound.entry = use(report, checked, checked.type->parameters[i], port.key, scope);
      }
      definition_.ports.push_back(bound);
    }
    if (constant) shared_[checked.first] = first;
    return first;
  }

  std::uint32_t use(const Reporter& report, const CheckedNode& checked, const Parameter& port,
                    std::string_view key, Scope& scope) {
    const Scope::Found found = scope.find(key);
    BlackboardEntry& entry = definition_.entries[found.entry];
    if (found.is_new) {
      entry.type = port.type;
      uses_.push_back({checked.document, checked.element, port.name});
      if (found.has_text) set_initial(report, checked, port, found.text, entry);
    } else if (entry.type != port.type) {
      const Use& first = uses_[found.entry];
      const auto where =
          project_.documents[first.document]->locate_attribute(first.element, first.port);
      report.at_value(
          checked.element, port.name,
          fmt::format("'{{{}}}' is {} for '{}', but {} elsewhere", brief(key),
                      with_article(port.type), port.name, with_article(entry.type)),
          fmt::format("the other use is at {}:{}:{}", where.file, where.line, where.column));
    }
    return found.entry;
  }

  void set_initial(const Reporter& report, const CheckedNode& checked, const Parameter& port,
                   std::string_view text, BlackboardEntry& entry) {
    const auto value = parse_value(port.type, text);
    if (value) {
      entry.initial = *value;
      return;
    }
    report.at_value(
        checked.element, port.name,
        fmt::format("the start value '{}' of '{}' is not {}, which '{}' must be", brief(text),
                    brief(entry.name), expected_text(port.type), port.name),
        "it comes from --set or from an attribute of a SubTree");
  }

  void check_set_keys(const Scope& scope) {
    std::vector<std::string_view> keys;
    for (const BlackboardEntry& entry : definition_.entries) {
      if (entry.name.find('/') == std::string::npos) keys.push_back(entry.name);
    }
    for (const auto& [key, text] : options_.values) {
      if (scope.used(key)) continue;
      diagnostics_.error({}, fmt::format("--set {0}: the main tree does not use '{{{0}}}'", key),
                         suggest(key, keys, "entries of the main tree"));
    }
  }

  const Project& project_;
  CheckedTrees& trees_;
  const ResolveOptions& options_;
  Diagnostics& diagnostics_;
  Definition definition_;
  std::vector<Use> uses_;              // of each entry
  std::vector<std::uint32_t> shared_;  // of each first checked port: its ports, made already
};

}  // namespace

Definition expand(const Project& project, CheckedTrees& trees, std::string_view main,
                  const ResolveOptions& options, Diagnostics& diagnostics) {
  return Expander(project, trees, options, diagnostics).expand(main);
}

}  // namespace lockstep
