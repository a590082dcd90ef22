// The states that verify counts, against the reference interpreter, which has none: two runs of it
// are in the same state if all that can come after them is the same. A fold that forgets too much
// has fewer states than that; one that keeps what nobody can see has more.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "property/comparison.h"
#include "property/reference.h"
#include "support/trials.h"
#include "verify/search.h"

namespace lockstep::host::test {
namespace {

constexpr int kPast = 2, kFuture = 3;  // ticks
constexpr std::size_t kMostLeaves = 2, kMostRuns = 20000;
const std::uint64_t kFoldedSeeds = trials(1500);

// Of these, verify has no state more than can be told apart within kFuture. Others count and wait
// longer, or are kept in a state that could be that of another.
const std::set<std::string> kExact{
    "action",   "condition", "AlwaysSuccess",    "AlwaysFailure",   "AlwaysRunning", "Sequence",
    "Fallback", "Inverter",  "ForceSuccess",     "ForceFailure",    "IfThenElse",    "Switch",
    "SubTree",  "Parallel",  "ParallelAbsolute", "ParallelRelative"};

bool is_exact(const Plan& plan) {
  if (!kExact.contains(plan.kind) || !plan.hooks.empty()) return false;
  return std::ranges::all_of(plan.children, is_exact);
}

std::vector<Plan*> scripted(Plan& plan) {
  std::vector<Plan*> found;
  if (!plan.script.empty()) found.push_back(&plan);
  for (Plan& child : plan.children) {
    for (Plan* leaf : scripted(child)) found.push_back(leaf);
  }
  return found;
}

// What can be seen of a tick: the root's status, and which leaf was started, ticked and halted.
// That a leaf is held shows in which are ticked.
std::string seen_of(Reference& reference, Status status) {
  std::string seen(1, status_letters()[index_of(status)]);
  for (const Event& event : reference.events) {
    if (event.call == Call::Pause || event.call == Call::Resume) continue;
    seen += to_string(event.call)[0] + std::to_string(event.leaf);
  }
  reference.events.clear();
  return seen;
}

// A run until some tick, and what can come next: by the answers that its leaves give then.
struct Sight;
struct Moment {
  std::map<std::string, Sight> next;
};
struct Sight {
  std::string what;
  Moment then;  // nothing follows an end
};

// All words that a leaf may answer in turn, each letter of which was asked for by some run.
class Answers {
 public:
  Answers(std::string letters, int length)
      : letters_(std::move(letters)), word_(static_cast<std::size_t>(length), letters_[0]) {}

  const std::string& begin() {
    used_ = 0;
    return word_;
  }
  char take() {
    most_ = std::max(most_, ++used_);
    return word_[used_ - 1];
  }
  // False: all words were there. It begins again.
  bool next() {
    for (std::size_t place = std::exchange(most_, 0); place > 0; --place) {
      char& letter = word_[place - 1];
      letter = letters_[(letters_.find(letter) + 1) % letters_.size()];
      if (letter != letters_[0]) return true;
    }
    return false;
  }

 private:
  std::string letters_, word_;
  std::size_t used_ = 0, most_ = 0;
};

// What can be seen in the next `ticks`, as a text.
std::string future(const Moment& moment, int ticks) {
  std::string all = "(";
  if (ticks == 0) return ")";
  for (const auto& [answers, seen] : moment.next)
    all += answers + ":" + seen.what + future(seen.then, ticks - 1) + ",";
  return all + ")";
}

// So many ticks of all runs; false: one has a fault, or there are too many.
bool explore(Trial trial, int ticks, Moment& root) {
  const auto leaves = scripted(trial.plan);
  std::vector<Answers> words;
  for (const Plan* leaf : leaves)
    words.emplace_back(leaf->kind == "condition" ? "SF" : "RSF", ticks);
  for (std::size_t run = 0; run < kMostRuns; ++run) {
    for (std::size_t i = 0; i < leaves.size(); ++i) leaves[i]->script = words[i].begin();
    Reference reference(trial.plan);
    Moment* at = &root;
    for (int tick = 0; tick < ticks; ++tick) {
      const Status status = reference.tick(tick * from_seconds(trial.period));
      if (reference.fault()) return false;
      std::string answers;
      for (const Event& event : reference.events)
        if (event.call == Call::Tick) answers += words[event.leaf].take();
      Sight& sight = at->next[answers];
      sight.what = seen_of(reference, status);
      if (status != Status::Running) break;
      at = &sight.then;
    }
    if (std::ranges::none_of(words, &Answers::next)) return true;
  }
  return false;
}

void collect(const Moment& moment, int ticks, std::set<std::string>& futures) {
  futures.insert(future(moment, kFuture));
  if (ticks == 0) return;
  for (const auto& [answers, seen] : moment.next)
    if (!seen.then.next.empty()) collect(seen.then, ticks - 1, futures);
}

std::optional<std::size_t> count_by_reference(const Trial& trial) {
  Moment start;
  if (!explore(trial, kPast + kFuture, start)) return std::nullopt;
  std::set<std::string> futures;
  for (const auto& [answers, sight] : start.next)
    if (!sight.then.next.empty()) collect(sight.then, kPast - 1, futures);
  return 1 + futures.size();  // nothing has run yet in one more
}

std::optional<std::size_t> count_by_search(const Tree& tree, double period) {
  Diagnostics diagnostics;
  std::vector<NodeProblem> problems;
  const auto file = read_leaf_file(
      "t.leaves.xml", "<leaves lockstep=\"1\"><leaf path=\"*\" progress=\"none\"/></leaves>",
      diagnostics);
  const LeafModels models = make_models(tree, file.get(), diagnostics, problems);
  if (!problems.empty()) return std::nullopt;
  const SearchResult found =
      search(tree, models, {}, 1 / period, {.depth = std::uint32_t{kPast}, .symmetry = false});
  return found.faults.empty() ? std::optional(found.store.size()) : std::nullopt;
}

}  // namespace

TEST_CASE("verify has as many states as the reference interpreter can tell apart", "[trials]") {
  std::uint64_t compared = 0, exact = 0;
  for (std::uint64_t seed = 0; seed < kFoldedSeeds; ++seed) {
    Trial trial = random_trial(seed);
    const auto leaves = scripted(trial.plan);
    if (leaves.empty() || leaves.size() > kMostLeaves || !trial.writes.empty()) continue;
    for (Plan* leaf : leaves) leaf->script = "R";
    const auto tree = tree_of(trial).tree;
    if (!tree) continue;
    const auto expected = count_by_reference(trial);
    const auto found = count_by_search(*tree, trial.period);
    if (!expected || !found) continue;
    INFO("seed " << seed << ": " << tree_text(trial.plan));
    ++compared;
    CHECK(*found >= *expected);
    if (!is_exact(trial.plan)) continue;
    ++exact;
    CHECK(*found == *expected);
  }
  CHECK(compared > kFoldedSeeds / 60);  // or the generator makes no small trees any more
  CHECK(exact > kFoldedSeeds / 60);
}

}  // namespace lockstep::host::test
