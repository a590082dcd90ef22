#include "definition/references.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/suggest.h"
#include "core/wording.h"
#include "definition/definition.h"
#include "document/reporter.h"

namespace lockstep {
namespace {

// Depth-first over the graph of trees, with a stack of its own: a chain of subtrees may be long.
class ReferenceChecker {
 public:
  ReferenceChecker(const Project& project, const CheckedTrees& trees, Diagnostics& diagnostics)
      : project_(project), trees_(trees), diagnostics_(diagnostics) {}

  bool check() {
    for (const std::string_view id : trees_.ids) {
      if (visits_[id].state == State::New) visit(id);
    }
    return expandable_;
  }

 private:
  enum class State { New, Open, Done };
  struct Visit {
    State state = State::New;
    std::uint32_t next = 0;  // of the tree's references, the one to look at next
    // Expanded:
    std::uint64_t size = 0;
    std::uint32_t depth = 0;
    std::uint64_t paths_size = 0;
  };

  void visit(std::string_view root) {
    open(root);
    while (!chain_.empty()) {
      const std::string_view id = chain_.back();
      const CheckedTree& tree = trees_.trees.at(id);
      if (Visit& visit = visits_[id]; visit.next < tree.references) {
        follow(visit, trees_.references[tree.first_reference + visit.next]);
      } else {
        close(id, visit);
      }
    }
  }

  void open(std::string_view id) {
    const CheckedTree& tree = trees_.trees.at(id);
    const CheckedNode& root = trees_.nodes[tree.root];
    visits_[id] = {State::Open, 0, root.end - tree.root, tree.depth, tree.paths_size};
    chain_.push_back(id);
  }

  void follow(Visit& from, const CheckedReference& reference) {
    const CheckedNode& node = trees_.nodes[reference.node];
    if (!trees_.trees.contains(node.subtree)) {
      unknown(node);
      ++from.next;
      return;
    }
    const Visit& to = visits_[node.subtree];
    if (to.state == State::New) {
      open(node.subtree);  // and come back to this reference
      return;
    }
    ++from.next;
    if (to.state == State::Open) {
      contains_itself(node);
      return;
    }
    constexpr std::uint64_t kMost = 1ull << 60u;  // far above the limits, and sums do not overflow
    from.size = std::min(from.size + to.size, kMost);
    from.depth = std::min(std::max(from.depth, reference.depth + 1 + to.depth), 1u << 30u);
    // With more nodes than that the tree is refused whatever their paths are.
    const auto paths_above = reference.path_size * std::min<std::uint64_t>(to.size, kMaxNodes);
    from.paths_size = std::min(from.paths_size + to.paths_size + paths_above, kMost);
  }

  void close(std::string_view id, Visit& visit) {
    visit.state = State::Done;
    chain_.pop_back();
    const CheckedNode& root = trees_.nodes[trees_.trees.at(id).root];
    if (visit.size > kMaxNodes) {
      too_large(root,
                fmt::format("the tree '{}' has {} nodes with its subtrees expanded", brief(id),
                            visit.size),
                fmt::format("the limit is {}", kMaxNodes));
    } else if (visit.depth > kMaxDepth) {
      too_large(root,
                fmt::format("the tree '{}' is {} nodes deep with its subtrees expanded", brief(id),
                            visit.depth),
                fmt::format("the limit is {}", kMaxDepth));
    } else if (visit.paths_size > kMaxPathBytes) {
      too_large(root,
                fmt::format("the paths of all nodes in the tree '{}' are larger than {} MiB "
                            "together with its subtrees expanded",
                            brief(id), kMaxPathBytes >> 20u),
                "a long name, or a deep place, counts for each node below it");
    }
  }

  void too_large(const CheckedNode& root, std::string message, std::string hint) {
    if (expandable_) report(root).at_element(root.element, std::move(message), std::move(hint));
    expandable_ = false;
  }

  void unknown(const CheckedNode& reference) const {
    if (report(reference).counted_only(Severity::Error)) return;
    report(reference).at_value(reference.element, "ID",
                               fmt::format("unknown tree '{}'", brief(reference.subtree)),
                               suggest(reference.subtree, trees_.ids, "trees in this project"));
  }

  void contains_itself(const CheckedNode& reference) {
    expandable_ = false;
    if (report(reference).counted_only(Severity::Error)) return;
    std::vector<std::string_view> circle(std::ranges::find(chain_, reference.subtree),
                                         chain_.end());
    circle.push_back(reference.subtree);
    report(reference).at_value(
        reference.element, "ID",
        fmt::format("the tree '{}' contains itself: {}", brief(reference.subtree), chained(circle)),
        "use a decorator such as Repeat for a loop");
  }

  Reporter report(const CheckedNode& node) const {
    return Reporter(*project_.documents[node.document], diagnostics_);
  }

  const Project& project_;
  const CheckedTrees& trees_;
  Diagnostics& diagnostics_;
  std::map<std::string_view, Visit> visits_;
  std::vector<std::string_view> chain_;
  bool expandable_ = true;
};

}  // namespace

bool check_references(const Project& project, const CheckedTrees& trees, Diagnostics& diagnostics) {
  return ReferenceChecker(project, trees, diagnostics).check();
}

}  // namespace lockstep
