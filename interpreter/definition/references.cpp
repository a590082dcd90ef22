#include "definition/references.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/suggest.h"
#include "core/utf8.h"
#include "definition/definition.h"
#include "document/reporter.h"

namespace lockstep {
namespace {

// Paths are in recordings, in messages, and in what a leaf knows of itself.
constexpr std::uint64_t kMaxPathBytes = std::uint64_t{512} << 20u;
constexpr std::size_t kShownBytes = 100;

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
    std::uint32_t next = 0;  // the node to look at next
    std::uint64_t size = 0;  // expanded
    std::uint32_t depth = 0;
    std::uint64_t paths = 0;  // bytes of the paths of all its nodes, from its own root on
  };

  void visit(std::string_view root) {
    open(root);
    while (!chain_.empty()) {
      const std::string_view id = chain_.back();
      if (const CheckedNode* reference = next_reference(id)) {
        follow(id, *reference);
      } else {
        close(id);
      }
    }
  }

  void open(std::string_view id) {
    const std::uint32_t root = trees_.roots.at(id);
    visits_[id] = {State::Open, root, trees_.nodes[root].end - root, 0, 0};
    chain_.push_back(id);
  }

  // The next SubTree in the tree `id` that is not yet looked at.
  const CheckedNode* next_reference(std::string_view id) {
    Visit& visit = visits_[id];
    const std::uint32_t end = trees_.nodes[trees_.roots.at(id)].end;
    for (; visit.next < end; ++visit.next) {
      const CheckedNode& node = trees_.nodes[visit.next];
      visit.depth = std::max(visit.depth, node.depth + 1);
      if (!node.subtree.empty()) return &node;
    }
    return nullptr;
  }

  void follow(std::string_view id, const CheckedNode& reference) {
    Visit& from = visits_[id];
    const auto target = trees_.roots.find(reference.subtree);
    if (target == trees_.roots.end()) {
      unknown(reference);
      ++from.next;
      return;
    }
    const Visit& to = visits_[reference.subtree];
    if (to.state == State::New) {
      open(reference.subtree);  // and come back to this reference
      return;
    }
    ++from.next;
    if (to.state == State::Open) {
      contains_itself(reference);
      return;
    }
    from.size = std::min<std::uint64_t>(from.size + to.size, 1ull << 60);
    from.depth = std::min(std::max(from.depth, reference.depth + 1 + to.depth), 1u << 30);
  }

  void close(std::string_view id) {
    Visit& visit = visits_[id];
    visit.state = State::Done;
    visit.paths = path_bytes(id);
    chain_.pop_back();
    const CheckedNode& root = trees_.nodes[trees_.roots.at(id)];
    if (visit.size > kMaxNodes) {
      too_large(
          root,
          fmt::format("the tree '{}' has {} nodes with its subtrees expanded", id, visit.size),
          fmt::format("the limit is {}", kMaxNodes));
    } else if (visit.depth > kMaxDepth) {
      too_large(
          root,
          fmt::format("the tree '{}' is {} nodes deep with its subtrees expanded", id, visit.depth),
          fmt::format("the limit is {}", kMaxDepth));
    } else if (visit.paths > kMaxPathBytes) {
      too_large(root,
                fmt::format("the paths of all nodes in the tree '{}' are larger than {} MiB "
                            "together with its subtrees expanded",
                            utf8_front(id, kShownBytes), kMaxPathBytes >> 20u),
                "a long name, or a deep place, counts for each node below it");
    }
  }

  // Once all trees in it are done.
  std::uint64_t path_bytes(std::string_view id) const {
    const std::uint32_t root = trees_.roots.at(id);
    std::vector<std::uint64_t> lengths;  // of the last node at each depth
    std::uint64_t sum = 0;
    for (std::uint32_t i = root; i < trees_.nodes[root].end; ++i) {
      const CheckedNode& node = trees_.nodes[i];
      lengths.resize(node.depth + 1u);
      lengths.back() = node.name.size() + 1 + (node.depth == 0 ? 0 : lengths[node.depth - 1u]);
      sum += lengths.back();
      if (node.subtree.empty()) continue;
      const auto subtree = visits_.find(node.subtree);
      if (subtree == visits_.end()) continue;  // unknown
      const Visit& below = subtree->second;
      sum += below.paths + lengths.back() * std::min<std::uint64_t>(below.size, kMaxNodes);
      sum = std::min<std::uint64_t>(sum, 1ull << 60u);
    }
    return sum;
  }

  void too_large(const CheckedNode& root, std::string message, std::string hint) {
    if (expandable_) report(root).at_element(root.element, std::move(message), std::move(hint));
    expandable_ = false;
  }

  void unknown(const CheckedNode& reference) const {
    std::string hint = did_you_mean(reference.subtree, trees_.ids);
    if (hint.empty()) hint = fmt::format("trees in this project: {}", fmt::join(trees_.ids, ", "));
    report(reference).at_value(reference.element, "ID",
                               fmt::format("unknown tree '{}'", reference.subtree), hint);
  }

  void contains_itself(const CheckedNode& reference) {
    expandable_ = false;
    const auto first = std::ranges::find(chain_, reference.subtree);
    report(reference).at_value(
        reference.element, "ID",
        fmt::format("the tree '{}' contains itself: {} -> {}", reference.subtree,
                    fmt::join(first, chain_.end(), " -> "), reference.subtree),
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
