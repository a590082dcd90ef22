// Where each child of the root is ticked by itself and the ticks are joined, a search finds what it
// finds with all combinations of answers.
#include <catch2/catch.hpp>
#include <random>

#include "support/trials.h"
#include "verify/verified.h"

namespace lockstep::host::test {
namespace {

// A parallel at the root, of several children each.
class RandomParallel {
 public:
  explicit RandomParallel(std::uint64_t seed) : random_(seed) {}

  std::string text() {
    std::string text = one_of({"Parallel", "Parallel", "Parallel[success_count=2]",
                               "Parallel[failure_count=2]", "Parallel[memory=false]"}) +
                       '(';
    const std::size_t kinds = 1 + random_() % 2;
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      const std::string child = node(2);
      const std::size_t equal = kind == 0 ? 2 + random_() % 3 : 1 + random_() % 2;
      for (std::size_t i = 0; i < equal; ++i) text += ' ' + child;
    }
    return text + ')';
  }
  std::string rows() {
    return one_of({"<tree ends=\"no\"/>", "", ""}) + "<leaf path=\"*\" result=\"" +
           one_of({"success", "success;failure", "success;failure;skipped", "success;skipped"}) +
           "\" ticks=\"" + one_of({"1..2", "1..inf", "2..inf", "2", "2..3", "3"}) + "\"/>";
  }

 private:
  std::string node(int depth) {
    if (depth == 0) return one_of({"a", "a", "b", "c?", "c?"});
    const auto child = [&] { return node(depth - 1); };
    switch (random_() % 4) {
      case 0:
        return one_of({"Inverter", "ForceSuccess", "Timeout[seconds=.2]", "Repeat[times=2]",
                       "Retry[attempts=2]", "Delay[seconds=.1]", "Repeat", "Retry[attempts=-1]"}) +
               '(' + child() + ')';
      case 1:
        return one_of({"Parallel", "Parallel[success_count=1]"}) + '(' + child() + ' ' + child() +
               ')';
      default:
        return one_of({"Sequence", "Sequence[memory=true]", "Fallback", "Fallback[memory=true]"}) +
               '(' + child() + ' ' + child() + ')';
    }
  }
  std::string one_of(const std::vector<std::string>& words) {
    return words[random_() % words.size()];
  }

  std::mt19937_64 random_;
};

std::string seen_of(const SearchResult& found, const Tree& tree) {
  std::string seen;
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    seen += tree.path(node) + (found.coverage.was_ticked(node) ? " ticked" : "");
    for (const StatusRow& row : kStatuses) {
      const bool is_result =
          row.status != Status::Idle;  // halted in the same tick: no verdict says
      if (is_result && found.coverage.has_been(node, row.status))
        seen += ' ' + std::string(row.name);
    }
    seen += found.coverage.has_fired(node) ? " fired\n" : "\n";
  }
  return seen;
}

}  // namespace

TEST_CASE("joint answers: random parallels have the verdict that all combinations have",
          "[trials]") {
  const std::uint64_t trees = trials(60);
  std::size_t compared = 0, fewer = 0, cycles = 0;
  for (std::uint64_t seed = 0; seed < trees; ++seed) {
    RandomParallel random(seed);
    const std::string tree = random.text(), rows = random.rows();
    INFO("seed " << seed << ": " << tree << ' ' << rows);
    const auto verified = [&](std::uint64_t few, unsigned jobs) {
      return Verified(tree, rows,
                      {.states = 3000, .transitions = 60'000, .jobs = jobs, .few_ticks = few});
    };
    const Verified all = verified(kAllTicks, 1);
    if (!all.found.is_complete()) continue;
    const Verified joint = verified(0, 1 + seed % 2);
    ++compared;
    REQUIRE(joint.found.is_complete());
    CHECK(said_by(joint) == said_by(all));
    CHECK(seen_of(joint.found, joint.tree) == seen_of(all.found, all.tree));
    CHECK(joint.found.depths == all.found.depths);
    REQUIRE(joint.found.store.size() == all.found.store.size());
    for (StateId id = 0; id < joint.found.store.size(); ++id) {
      const auto state = joint.found.store[id];
      const StateId same = all.found.store.find(state, hash_of(state));
      if (same == kNoState || joint.found.depth_of(id) != all.found.depth_of(same)) FAIL(id);
      CHECK(joint.found.graph.ends[id] == all.found.graph.ends[same]);
    }
    fewer += joint.found.transitions < all.found.transitions;
    cycles += joint.findings().find("cycle") != std::string::npos;
  }
  INFO(compared << " compared, " << fewer << " fewer, " << cycles << " cycles");
  CHECK(compared > trees / 2);
  CHECK(fewer > trees / 8);
  CHECK(cycles > trees / 40);
}

TEST_CASE("joint answers: many Sequences of two leaves are verified") {
  std::string tree = "Parallel(";
  for (int i = 0; i < 20; ++i) tree += "Sequence[memory=true](a b) ";
  const Verified it(tree + ')', "");
  CHECK(it.found.is_complete());
  CHECK(it.found.store.size() == 231);
  CHECK(it.found.transitions < 45'000);
}

}  // namespace lockstep::host::test
