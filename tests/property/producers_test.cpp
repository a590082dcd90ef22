// The two producers of Moments agree: on random trees of both languages, the Moments of a run are
// those that are read from its recording. So what is computed from Moments, such as measures and
// the verdicts of properties, is the same of both.
#include <catch2/catch.hpp>
#include <numeric>
#include <sstream>

#include "base/core/resource_set.h"
#include "dialect/btcpp/rules.h"
#include "property/btcpp_tree.h"
#include "property/random_tree.h"
#include "record/read/recorded_moments.h"
#include "record/read/recording_reader.h"
#include "record/write/recorder.h"
#include "run/shape_of.h"
#include "support/tree_text.h"
#include "support/trials.h"
#include "unit/recording/watched_run.h"

namespace lockstep::host::test {
namespace {

const std::uint64_t kProducerTrees = trials(300);

// What a Moment says of a node; of its children only if the node has asked them.
struct SeenNodeOfMoment {
  NodeState state = {};
  double progress = 0, limit = 0;
  bool has_succeeded = false;
  std::vector<double> used = {};

  std::string text() const {
    std::ostringstream text;
    text << to_string(state.status()) << (state.ticked() ? " ticked" : "")
         << (state.held() ? " held" : "") << " at " << progress << " limit " << limit
         << (has_succeeded ? " has succeeded" : "") << " used";
    for (const double it : used) text << ' ' << it;
    return text.str();
  }
};

struct SeenMoment {
  std::uint64_t tick = 0;
  Nanoseconds time{0};
  std::vector<SeenNodeOfMoment> nodes = {};
  std::vector<std::vector<NodeState>> within = {};
  std::vector<std::optional<std::string>> entries = {};
};

bool is_measured(const ShapeNode& node) {
  return node.latches || node.synchronization != Synchronization::None;
}

std::optional<std::string> text_of(const Entry& entry) {
  return entry.has_value() ? std::optional(to_text(entry.value())) : std::nullopt;
}

SeenMoment seen_in(const Moment& moment, const Shape& shape) {
  SeenMoment seen{.tick = moment.tick, .time = moment.time};
  const std::vector<bool> users = resource_users(shape);
  std::vector<bool> is_compared(shape.nodes.size());
  for (NodeIndex node = 0; node < shape.nodes.size(); ++node) {
    const ShapeNode& it = shape.nodes[node];
    SeenNodeOfMoment& now = seen.nodes.emplace_back(
        SeenNodeOfMoment{.state = moment.state(node), .progress = moment.progress[node]});
    if (users[node]) now.limit = moment.limit(node);
    if (!is_measured(it)) continue;
    if (it.synchronization == Synchronization::Resources) continue;  // it compares nothing
    is_compared[node] = it.synchronization != Synchronization::None;
    for (const NodeIndex child : it.held()) is_compared[child] = true;
    if (!asked_children(moment, node, it.held(), it.is_group())) continue;
    if (compares_progress(it.synchronization)) now.limit = moment.limit(node);
    now.used.assign(moment.used(node).begin(), moment.used(node).end());
  }
  for (NodeIndex node = 0; node < shape.nodes.size(); ++node) {
    seen.nodes[node].has_succeeded = is_compared[node] && moment.has_succeeded(node);
  }
  std::vector<NodeState> column;
  moment.within.each(column, [&](std::span<const NodeState> states, const TickMoment&, bool) {
    seen.within.emplace_back(states.begin(), states.end());
  });
  for (const Entry& it : moment.entries) seen.entries.push_back(text_of(it));
  for (const EntryText& it : moment.texts) seen.entries.push_back(it.text);
  return seen;
}

// Copies each Moment of a run, as somebody sees it who asks for everything.
class MomentWitness final : public Observer {
 public:
  explicit MomentWitness(const Shape& shape) : shape_(shape) {}

  AskedOfRun asked() const override {
    AskedOfRun asked{.within = true};
    asked.progress.resize(shape_.nodes.size());
    std::iota(asked.progress.begin(), asked.progress.end(), NodeIndex{0});
    asked.parallels = asked.progress;
    return asked;
  }
  void after_tick(const Moment& moment, const TickReport&) override {
    seen.push_back(seen_in(moment, shape_));
  }
  std::vector<SeenMoment> seen;

 private:
  const Shape& shape_;
};

struct SeenCounts {
  std::size_t ticks = 0, within = 0, used = 0, left_out = 0, succeeded = 0, waiting = 0;
};

void compare(const SeenNodeOfMoment& run, const SeenNodeOfMoment& recording, SeenCounts& counts) {
  CHECK(run.text() == recording.text());
  counts.used += run.used.size();
  for (const double it : run.used) counts.left_out += is_left_out(it) ? 1 : 0;
  counts.succeeded += run.has_succeeded && run.state.status() == Status::Idle ? 1 : 0;
  counts.waiting += waits(run.limit) ? 1 : 0;
}

void compare(WatchedRun& run, std::uint64_t ticks, SeenCounts& counts) {
  const Shape shape = shape_of(run.run.tree());
  const TemporaryPath file;
  Recorder recorder(shape_of(run.run.tree()),
                    {.path = file.path(), .run = {.tree_file = "a.xml", .rate_hz = 10}});
  MomentWitness witness(shape);
  run.watch({&recorder, &witness}, ticks);

  std::istringstream text(file.text());
  RecordingReader reader(text, "run.jsonl");
  RecordedMoments moments(reader.header());
  std::size_t at = 0;
  while (const auto tick = reader.next()) {
    REQUIRE(at < witness.seen.size());
    const SeenMoment& live = witness.seen[at++];
    const SeenMoment read = seen_in(moments.read(*tick), reader.header());
    INFO("tick " << live.tick);
    CHECK(read.tick == live.tick);
    CHECK(read.time == live.time);
    CHECK(read.within == live.within);
    for (std::size_t i = 0; i < live.entries.size(); ++i) {
      // A recording keeps what an entry had that has lost its value.
      if (live.entries[i]) CHECK(read.entries[i] == live.entries[i]);
    }
    for (NodeIndex node = 0; node < shape.nodes.size(); ++node) {
      INFO(shape.nodes[node].path);
      compare(live.nodes[node], read.nodes[node], counts);
    }
    ++counts.ticks;
    counts.within += live.within.empty() ? 0 : 1;
  }
  CHECK(reader.error() == "");
  CHECK(at == witness.seen.size());
}

}  // namespace

TEST_CASE("the Moments of a run of a random tree are those of its recording", "[trials]") {
  SeenCounts counts;
  for (std::uint64_t seed = 0; seed < kProducerTrees; ++seed) {
    const Trial trial = random_trial(seed);
    INFO("seed " << seed << ": " << tree_text(trial.plan) << ", " << leaves_text(trial.plan));
    WatchedRun run(tree_text(trial.plan), leaves_text(trial.plan));
    compare(run, static_cast<std::uint64_t>(trial.ticks), counts);
  }
  CHECK(counts.ticks > 6 * kProducerTrees);
  CHECK(counts.within > kProducerTrees / 15);
  CHECK(counts.used > 6 * kProducerTrees);
  CHECK(counts.left_out > kProducerTrees / 15);
  CHECK(counts.succeeded > kProducerTrees / 50);
  CHECK(counts.waiting > kProducerTrees / 15);
}

// Their ticks have several moments where a child completes at once.
TEST_CASE("the Moments of a run of a random tree for BehaviorTree.CPP are those of its recording",
          "[trials]") {
  SeenCounts counts;
  for (std::uint64_t seed = 1; seed <= kProducerTrees; ++seed) {
    const law::Document document = law::random_document(seed);
    INFO("seed " << seed << "\n" << law::to_xml(document) << "\n" << law::leaves_text(document));
    WatchedRun run(law::tree_of(document), law::leaves_text(document));
    compare(run, 12, counts);
  }
  CHECK(counts.ticks > 3 * kProducerTrees / 2);
  CHECK(counts.within > kProducerTrees / 15);
}

// What a node left out when it asked its children for the last time in a tick.
TEST_CASE("a recording has what a node used that asked its children several times in a tick") {
  struct Row {
    std::string_view tree, leaves;
  };
  // A leaf is skipped in one round of a period and runs in the next one, with some progress or
  // none.
  constexpr std::string_view kSkipped =
      "Sequence(Script[code=go:=false] ParallelAbsolute[barriers=.5](a[_skipIf=!go] "
      "AsyncSequence(Script[code=go:=true] AlwaysSuccess b)))";
  // The same where nothing shows that the whole tree was ticked again but that nothing was reset.
  constexpr std::string_view kInside =
      "Sequence(Script[code=go:=false] ParallelAbsolute[barriers=.5]("
      "AsyncSequence[_skipIf=!go](AlwaysSuccess AlwaysSuccess a) "
      "AsyncSequence(Script[code=go:=true] AlwaysSuccess AlwaysSuccess b)))";
  // One asks once, whatever is repeated below it.
  constexpr std::string_view kRepeated =
      "Sequence(Script[code=go:=false] ParallelAbsolute[barriers=.5](a[_skipIf=!go] "
      "Repeat[num_cycles=50](AlwaysSuccess) b))";
  // A barrier beside the tree asks once in a tick.
  constexpr std::string_view kGroup =
      "Sequence(Script[code=go:=false] Parallel(Repeat[num_cycles=2](Sequence("
      "SyncProgress[barrier=g _skipIf=!go](a) Script[code=go:=true])) "
      "SyncProgress[barrier=g](b))) barrier[name=g barriers=.5]";
  const Row rows[] = {{kSkipped, "a=R.5S b=R.5S"}, {kSkipped, "a=R0RS b=R0RS"},
                      {kInside, "a=R.5S b=R.5S"},  {kInside, "a=R0RS b=R0RS"},
                      {kRepeated, "a=RS b=RRS"},   {kGroup, "a=R.2RS b=RRS"},
                      {kGroup, "a=R0RS b=RRS"}};
  SeenCounts counts;
  for (const auto& [tree, leaves] : rows) {
    INFO(tree << ", " << leaves);
    WatchedRun run(tree_from_text(tree, btcpp::kRules), leaves);
    compare(run, 12, counts);
  }
  CHECK(counts.left_out > 0);
}

}  // namespace lockstep::host::test
