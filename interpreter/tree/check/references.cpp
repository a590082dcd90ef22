#include "tree/check/references.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "base/core/suggest.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

// Depth-first over the graph of trees, with an explicit stack: a chain of subtrees may be long.
class ReferenceChecker {
 public:
  ReferenceChecker(const CheckedTrees& trees, const Reporter& report,
                   std::vector<std::string_view> elsewhere)
      : trees_(trees), report_(report), all_ids_(std::move(elsewhere)) {
    all_ids_.insert(all_ids_.begin(), trees.ids.begin(), trees.ids.end());
  }

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
    std::uint32_t next = 0;  // of the tree's subtrees, the one to look at next
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
      if (Visit& visit = visits_[id]; visit.next < tree.subtrees) {
        follow(visit, trees_.subtrees[tree.first_subtree + visit.next]);
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

  void follow(Visit& from, const CheckedSubTree& subtree) {
    if (!trees_.trees.contains(subtree.id)) {
      if (!subtree.id.empty()) unknown(subtree);
      ++from.next;
      return;
    }
    const Visit& to = visits_[subtree.id];
    if (to.state == State::New) {
      open(subtree.id);  // and come back to this one
      return;
    }
    ++from.next;
    if (to.state == State::Open) {
      contains_itself(subtree);
      return;
    }
    constexpr std::uint64_t kMost = 1ull << 60u;  // far above the limits, and sums do not overflow
    from.size = std::min(from.size + to.size, kMost);
    from.depth = std::min(std::max(from.depth, subtree.depth + 1 + to.depth), 1u << 30u);
    // With more nodes than that the tree is refused whatever their paths are.
    const auto paths_above = subtree.path_size * std::min<std::uint64_t>(to.size, kMaxNodes);
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
    if (expandable_) report_.at("too-large"_code, root.place, std::move(message), std::move(hint));
    expandable_ = false;
  }

  void unknown(const CheckedSubTree& subtree) const {
    if (report_.counted_only(Severity::Error)) return;
    // As the file has it, also where it is included under a name.
    const std::string_view space = trees_.trees.at(chain_.back()).space;
    const std::string_view id = id_in(space, subtree.id);
    std::string hint = space.empty() ? did_you_mean(id, all_ids_) : "";
    if (hint.empty()) hint = suggest(id, ids_of(space), "trees in this project");
    report_.at_value("unknown-tree"_code, subtree.place,
                     fmt::format("unknown tree '{}'", brief(id)), std::move(hint));
  }

  void contains_itself(const CheckedSubTree& subtree) {
    expandable_ = false;
    if (report_.counted_only(Severity::Error)) return;
    std::vector<std::string_view> circle(std::ranges::find(chain_, subtree.id), chain_.end());
    circle.push_back(subtree.id);
    report_.at_value(
        "recursive-tree"_code, subtree.place,
        fmt::format("the tree '{}' contains itself: {}", brief(subtree.id), chained(circle)),
        "use a decorator such as Repeat for a loop");
  }

  // There may be thousands, and as many mistakes.
  std::span<const std::string_view> ids_of(std::string_view space) const {
    if (space.empty()) return trees_.ids;
    if (space != space_) own_ids_ = ids_in(space, trees_.ids);
    space_ = space;
    return own_ids_;
  }

  const CheckedTrees& trees_;
  const Reporter& report_;
  mutable std::string_view space_;
  mutable std::vector<std::string_view> own_ids_;  // those of that space
  std::vector<std::string_view> all_ids_;          // also those of other files
  std::map<std::string_view, Visit> visits_;
  std::vector<std::string_view> chain_;
  bool expandable_ = true;
};

}  // namespace

bool check_references(const CheckedTrees& trees, const Reporter& report,
                      std::vector<std::string_view> elsewhere) {
  return ReferenceChecker(trees, report, std::move(elsewhere)).check();
}

}  // namespace lockstep::host
