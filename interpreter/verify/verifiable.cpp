#include "verify/verifiable.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "language/expression/reading_uses.h"

namespace lockstep::host {
namespace {

class Unknowns {
 public:
  explicit Unknowns(const Tree& tree)
      : tree_(tree),
        reads_entries_(std::ranges::any_of(entries_of_engine(tree), std::identity())) {}

  std::vector<NodeProblem> find() {
    for (NodeIndex node = 0; node < tree_.nodes.size(); ++node) look_at(node);
    for (const BoundNode& it : tree_.bound) {
      look_at_ports(it.node, it.first_port, it.kind->type.parameters.size());
    }
    for (const HookedNode& it : tree_.hooked) {
      for (const std::uint32_t script : it.scripts) look_at_script(it.node, script);
    }
    return std::move(problems_);
  }

 private:
  void look_at(NodeIndex node) {
    const NodeType& type = *tree_.labels[node].type;
    if (type.opens_entries && reads_entries_) {
      add(node, fmt::format("'{}' may write any entry, and the tree reads some", type.id));
    }
    if (type.leaf != nullptr || type.mock != nullptr) return;  // a stand-in looks at no port
    if (type.reads_ports) {
      look_at_ports(node, tree_.nodes[node].params, type.parameters.size());
    }
    const bool by_name = std::ranges::any_of(type.parameters, &Parameter::is_key);
    if (by_name && !tree_.boards.empty()) {
      add(node,
          fmt::format("'{}' looks up entries by names that are known only while it runs", type.id));
    }
    if (type.id.starts_with("Loop")) {
      add(node, fmt::format("'{}' goes through a list that it keeps for itself", type.id));
    }
    for (std::size_t i = 0; i < type.parameters.size(); ++i) {
      if (!type.parameters[i].is_script || type.reads_ports) continue;
      const Cell& cell = tree_.cells[tree_.nodes[node].params + i];
      look_at_script(node, static_cast<std::uint32_t>(cell.integer));
    }
  }

  void look_at_script(NodeIndex node, std::uint32_t script) {
    if (script >= tree_.scripts.size()) return;
    const Script& it = tree_.scripts[script];
    if (it.code == nullptr) return add(node, "its script is the text of an entry");
    if (it.readings.empty()) return;
    for (const ProgressUse& use : progress_uses(*it.code)) {
      const std::string what = shown(it.code->readings()[use.reading]);
      if (!use.constant) {
        add(node,
            fmt::format("its script computes with {}; verify knows progress as far as it is "
                        "compared with a number",
                        what),
            "compare it with numbers; ParallelRelative keeps two nodes close to each other");
      } else if (tree_.is_group(tree_.readings[it.readings[use.reading]].node)) {
        add(node, fmt::format("its script reads {}, which is a barrier; read its members", what));
      }
    }
  }

  void look_at_ports(NodeIndex node, std::uint32_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t slot = tree_.ports[first + i].slot;
      if (slot == PortBinding::kUnbound || tree_.slots[slot].type != ValueType::Object) continue;
      add(node, fmt::format("it reads the entry '{}', which is an object", tree_.slots[slot].name));
    }
  }

  void add(NodeIndex node, std::string message, std::string hint = {}) {
    problems_.push_back({node, "this cannot be verified: " + std::move(message), std::move(hint)});
  }

  const Tree& tree_;
  const bool reads_entries_;
  std::vector<NodeProblem> problems_;
};

}  // namespace

std::vector<NodeProblem> not_verifiable(const Tree& tree) {
  return Unknowns(tree).find();
}

// A barrier keeps the progress of the tick before, which is no part of a state: no node reads it.
Observed observed_by(const Tree& tree, std::span<const Property> properties,
                     std::vector<NodeProblem>& problems) {
  Observed observed;
  for (const Property& property : properties) {
    for (const ProgressComparison& it : property.progress_comparisons()) {
      observed.progress.push_back({it.node, it.constant});
      if (tree.is_group(it.node)) {
        problems.push_back({it.node, "a property compares the progress of a barrier",
                            "compare the progress of its members instead"});
      }
    }
    for (const EntryComparison& it : property.comparisons()) {
      if (it.entry < tree.slots.size()) observed.entries.push_back(it.entry);  // else a fact
    }
  }
  return observed;
}

}  // namespace lockstep::host
