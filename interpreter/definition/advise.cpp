#include <fmt/format.h>

#include "core/wording.h"
#include "definition/expand.h"
#include "document/reporter.h"

namespace lockstep {
namespace {

class Adviser {
 public:
  Adviser(const Project& project, const Definition& definition, Diagnostics& diagnostics)
      : project_(project),
        definition_(definition),
        diagnostics_(diagnostics),
        acting_(find_acting()) {}

  void advise() const {
    for (std::uint32_t node = 0; node < definition_.nodes.size(); ++node) {
      const std::string_view id = at(node).type->id;
      if (id == "Sequence" && !has_memory(node)) sequence_restarts(node);
      if (id == "ParallelAbsolute" || id == "ParallelRelative") child_without_progress(node);
    }
    unwritten_entries();
  }

 private:
  const DefinitionNode& at(std::uint32_t node) const { return definition_.nodes[node]; }

  template <class Visit>
  void for_each_child(std::uint32_t node, Visit visit) const {
    for (std::uint32_t child = node + 1; child < at(node).end; child = at(child).end) visit(child);
  }

  void add(std::uint32_t node, Severity severity, std::string message, std::string hint) const {
    const Reporter report(*project_.documents[at(node).document], diagnostics_);
    report.at_element(at(node).element, std::move(message), std::move(hint), severity);
  }

  bool has_memory(std::uint32_t node) const {
    return std::get<bool>(definition_.values[at(node).first]);
  }

  // Of each node: whether ticking it anew after Success does work again. Descendants come first.
  std::vector<bool> find_acting() const {
    std::vector<bool> acts(definition_.nodes.size(), false);  // at first: whether a child does
    for (auto node = static_cast<std::uint32_t>(acts.size()); node-- > 0;) {
      acts[node] = acts_again(node, acts[node]);
      if (acts[node]) acts[at(node).parent] = true;
    }
    return acts;
  }

  // A Fallback that begins with a condition asks first, so it does not.
  bool acts_again(std::uint32_t node, bool child_acts) const {
    const NodeType& type = *at(node).type;
    if (type.category == NodeCategory::Action) return !type.id.starts_with("Always");
    if (!child_acts || type.id == "RunOnce" || type.category == NodeCategory::Condition)
      return false;
    return type.id != "Fallback" || at(node + 1).type->category != NodeCategory::Condition;
  }

  void sequence_restarts(std::uint32_t sequence) const {
    constexpr int kMostTold = 10;  // the first few show what is meant
    int told = 0;
    std::uint32_t earlier = 0;
    for_each_child(sequence, [&](std::uint32_t child) {
      if (!acting_[child]) return;
      if (earlier != 0 && told++ < kMostTold) {
        add(earlier, Severity::Warning,
            fmt::format("'{}' is started again in every tick in which '{}' runs",
                        brief(at(earlier).name), brief(at(child).name)),
            "the Sequence ticks all its children in every tick: give it memory=\"true\", or let "
            "the "
            "action return Success at once where its goal already holds");
      }
      earlier = child;
    });
  }

  // A decorator or SubTree has its child's progress.
  void child_without_progress(std::uint32_t parallel) const {
    for_each_child(parallel, [&](std::uint32_t child) {
      std::uint32_t source = child;
      while (at(source).children == 1 && at(source).type->category != NodeCategory::Control)
        ++source;
      const NodeType& type = *at(source).type;
      if (type.category != NodeCategory::Action || type.has_progress) return;
      add(source, Severity::Note,
          fmt::format("'{}' reports no progress: for '{}' it is at 0 until it succeeds",
                      brief(at(source).name), brief(at(parallel).name)),
          "the others wait for it at the first barrier, or within delta of 0");
    });
  }

  void unwritten_entries() const {
    std::vector<bool> written(definition_.entries.size(), false);
    for_each_port([&](std::uint32_t, const Parameter& parameter, std::uint32_t entry) {
      if (parameter.direction != Direction::Input) written[entry] = true;
    });
    for_each_port([&](std::uint32_t node, const Parameter& parameter, std::uint32_t entry) {
      const BlackboardEntry& it = definition_.entries[entry];
      if (written[entry] || !std::holds_alternative<std::monostate>(it.initial)) return;
      written[entry] = true;  // one warning an entry
      const Reporter report(*project_.documents[at(node).document], diagnostics_);
      report.at_value(at(node).element, parameter.name,
                      fmt::format("nothing writes '{{{}}}'", brief(it.name)),
                      it.name.find('/') == std::string::npos
                          ? fmt::format("give it a value with --set {}=…", brief(it.name))
                          : "give it a value by an attribute of the SubTree",
                      Severity::Warning);
    });
  }

  template <class Visit>
  void for_each_port(Visit visit) const {
    for (std::uint32_t node = 0; node < definition_.nodes.size(); ++node) {
      const NodeType& type = *at(node).type;
      if (type.binding == nullptr) continue;
      for (std::uint32_t i = 0; i < type.parameters.size(); ++i) {
        const Port& port = definition_.ports[at(node).first + i];
        if (port.entry != Port::kNone) visit(node, type.parameters[i], port.entry);
      }
    }
  }

  const Project& project_;
  const Definition& definition_;
  Diagnostics& diagnostics_;
  const std::vector<bool> acting_;
};

}  // namespace

void advise(const Project& project, const Definition& definition, Diagnostics& diagnostics) {
  Adviser(project, definition, diagnostics).advise();
}

}  // namespace lockstep
