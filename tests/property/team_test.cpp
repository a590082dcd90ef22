// Random teams over a network that is late, loses words and is cut: whatever it does, no child goes
// on beyond a barrier, or farther than delta, before all others were there. What they really did is
// written down beside the network, and shares nothing with what they hear.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/core/random.h"
#include "property/simulated_robot.h"

namespace lockstep::host::test::team_trial {
namespace {

constexpr double kNear = 1e-6;

// What a robot does, of which its leaf decides nothing by itself.
struct Motion {
  RandomStream random{0, 0};
  double step = 0.05, falls = 0, fails = 0;
  double progress = 0;
  bool was_ticked = false;  // in this tick of its tree
};
thread_local Motion* motion_here = nullptr;

void* create(const lockstep_host*, const lockstep_caller*, void*) {
  return motion_here;
}
void start(void* self) {
  static_cast<Motion*>(self)->progress = 0;
}
lockstep_status tick(void* self) {
  Motion& it = *static_cast<Motion*>(self);
  it.was_ticked = true;
  const double luck = it.random.next_double();
  if (luck < it.fails) return LOCKSTEP_FAILURE;
  if (luck < it.fails + it.falls) {
    it.progress = std::max(0.0, it.progress - 0.2);
  } else {
    it.progress += it.step * 2 * it.random.next_double();
  }
  if (it.progress >= 1) return LOCKSTEP_SUCCESS;
  return LOCKSTEP_RUNNING;
}
double progress(void* self) {
  return static_cast<const Motion*>(self)->progress;
}

const lockstep_leaf_type kMove = [] {
  lockstep_leaf_type type = tables::leaf_type(
      "Move", create, [](void*) {}, tick);
  type.start = start;
  type.progress = progress;
  return type;
}();
struct TeamTrial {
  std::size_t robots = 2;
  bool is_delta = false;
  std::vector<double> barriers = {0.5};
  double delta = 0.1;
  bool repeats = false, restarts = false;  // processes are started again
  double step = 0.05, falls = 0, fails = 0;
  NetworkOptions network;
};

// What a robot really was at one time.
struct Truth {
  Nanoseconds time{0};
  int completed = 0;
  bool is_in = false;
  double progress = 0;
};

// How a robot goes on.
struct Going {
  int completed = 0;  // rounds before this one
  double progress = 0;
  bool begins = false;
};

std::string tree_of(const TeamTrial& trial, std::size_t number) {
  std::string members, limits;
  for (std::size_t i = 0; i < trial.robots; ++i) members += fmt::format("{}r{}", i ? ";" : "", i);
  for (const double it : trial.barriers)
    limits += fmt::format("{}{}", limits.empty() ? "" : ";", it);
  const std::string limit = trial.is_delta ? fmt::format("delta=\"{}\"", trial.delta)
                                           : fmt::format("barriers=\"{}\"", limits);
  const std::string in =
      fmt::format(R"(<InStep team="t" as="r{}" {}><Move/></InStep>)", number, limit);
  const std::string root =
      trial.repeats ? "<Repeat times=\"3\"><Retry attempts=\"100\">" + in + "</Retry></Repeat>"
                    : in;
  return fmt::format(
      R"(<root lockstep="1"><team name="t" members="{}"/><BehaviorTree ID="M">{}</BehaviorTree></root>)",
      members, root);
}

class Robot : public SimulatedRobot {
 public:
  Robot(const TeamTrial& trial, std::size_t number, std::uint64_t seed)
      : SimulatedRobot(tree_of(trial, number), kMove,
                       std::chrono::milliseconds(7 + 3 * static_cast<int>(number)), number) {
    motion_ = {.random = RandomStream(seed, number + 1),
               .step = trial.step * (1 + 0.7 * static_cast<double>(number)),
               .falls = trial.falls,
               .fails = trial.fails};
  }

  void begin(SimulatedNetwork& network, Nanoseconds now) {
    motion_here = &motion_;
    SimulatedRobot::begin(network, now);
    completed_ = 0;
  }

  Truth truth() const { return {now(), completed_, is_in_, motion_.progress}; }
  // The progress with which the child went on in the last tick; nothing: it did not.
  const std::optional<Going>& went_on() const { return went_on_; }

  void tick() {
    motion_.was_ticked = false;
    const NodeIndex leaf = tree().leaves[0].node;
    const bool ran = ticker().status(leaf) == Status::Running;
    const Going before{completed_, ran ? motion_.progress : 0, !ran};
    SimulatedRobot::tick([&](const Ticker& ticker) {
      is_in_ = ticker.status(tree().labels[leaf].parent) == Status::Running;
      if (ticker.status(leaf) != Status::Running && motion_.progress < 1) motion_.progress = 0;
      went_on_ = motion_.was_ticked ? std::optional(before) : std::nullopt;
      if (motion_.was_ticked && motion_.progress >= 1) {
        ++completed_;
        motion_.progress = 0;
      }
    });
  }

 private:
  Motion motion_;
  int completed_ = 0;
  bool is_in_ = false;
  std::optional<Going> went_on_;
};

struct Outcome {
  std::string broken;  // "": nothing was
  bool all_ended = false;
  std::uint64_t ticks = 0;
};

// Whether a robot that really was so at that time lets it.
bool lets_go_on(const Truth& it, const Going& other, const TeamTrial& trial) {
  if (it.completed > other.completed) return true;
  const bool is_in = it.is_in && it.completed == other.completed;
  const double progress = is_in ? it.progress : 0;
  if (trial.is_delta) return other.progress <= progress + trial.delta + kNear;
  return std::ranges::none_of(trial.barriers, [&](double barrier) {
    if (barrier == 0) return other.begins && !is_in;
    return other.progress >= barrier && progress < barrier - kNear;
  });
}

Outcome try_team(const TeamTrial& trial, std::uint64_t seed) {
  SimulatedNetwork network(trial.network);
  RandomStream random(seed, 99);
  std::vector<std::unique_ptr<Robot>> robots;
  std::vector<std::vector<Truth>> history(trial.robots);
  Nanoseconds slowest{0};
  for (std::size_t i = 0; i < trial.robots; ++i) {
    robots.push_back(std::make_unique<Robot>(trial, i, seed));
    slowest = std::max(slowest, robots[i]->period());
    robots[i]->begin(network, from_seconds(0.2 * random.next_double()));
  }
  // So old may be what a robot goes by: silent after five periods, on its way, and said in a tick.
  const Nanoseconds horizon =
      (kPeriodsOfSilence + 2) * slowest + trial.network.latency + trial.network.jitter;
  Outcome outcome;
  const Nanoseconds last = std::chrono::seconds(6);
  while (true) {
    const std::size_t number = next_robot(robots, last, [](std::size_t) { return false; });
    if (number == robots.size()) break;
    Robot* const next = robots[number].get();
    const bool is_new = trial.restarts && random.next_double() < 0.004;
    if (is_new) next->begin(network, next->next() + from_seconds(0.1 * random.next_double()));
    if (is_new) continue;
    next->tick();
    ++outcome.ticks;
    const Truth now = next->truth();
    history[number].push_back(now);
    if (!next->went_on() || !outcome.broken.empty()) continue;
    Going from = *next->went_on();
    // A new process has completed no round, whichever it joins.
    if (trial.restarts) from.completed = 0;
    for (std::size_t i = 0; i < robots.size(); ++i) {
      if (i == number) continue;
      const bool is_allowed = std::ranges::any_of(history[i], [&](const Truth& it) {
        // Who has completed the round has done so for ever.
        const bool counts = it.completed > from.completed || it.time + horizon >= now.time;
        return counts && lets_go_on(it, from, trial);
      });
      if (!is_allowed) {
        outcome.broken =
            fmt::format("seed {}: r{} goes on from {:.4f} at {} ns, but r{} was not there", seed,
                        number, from.progress, now.time.count(), i);
      }
    }
  }
  outcome.all_ended = std::ranges::all_of(robots, [](const auto& it) { return it->is_over(); });
  for (const auto& it : robots) it->end(network);
  return outcome;
}

TeamTrial random_team(std::uint64_t seed) {
  RandomStream random(seed, 7);
  const auto below = [&](double most) { return most * random.next_double(); };
  TeamTrial trial;
  trial.robots = 2 + static_cast<std::size_t>(below(4));
  trial.is_delta = below(1) < 0.4;
  trial.barriers.clear();
  for (double at = below(1) < 0.3 ? 0 : 0.1 + below(0.3); at < 1; at += 0.1 + below(0.4))
    trial.barriers.push_back(std::round(at * 100) / 100);
  trial.delta = 0.05 + below(0.3);
  trial.repeats = below(1) < 0.6;
  trial.restarts = below(1) < 0.3;
  trial.step = 0.02 + below(0.06);
  trial.falls = below(1) < 0.3 ? 0.05 : 0;
  trial.fails = trial.repeats && below(1) < 0.4 ? 0.01 : 0;
  trial.network.latency = from_seconds(below(0.05));
  trial.network.jitter = from_seconds(below(1) < 0.5 ? 0 : below(0.05));
  trial.network.loss = below(1) < 0.5 ? 0 : below(0.3);
  if (below(1) < 0.4) {
    const double from = below(2);
    trial.network.cuts.push_back({from_seconds(from), from_seconds(from + below(1))});
  }
  trial.network.seed = seed;
  return trial;
}

}  // namespace

TEST_CASE("no robot goes on before the others of its team are there, whatever the network does") {
  constexpr std::uint64_t kTrials = 1500;
  std::uint64_t ended = 0, ticks = 0;
  for (std::uint64_t seed = 0; seed < kTrials; ++seed) {
    const Outcome outcome = try_team(random_team(seed), seed);
    REQUIRE(outcome.broken == "");
    ended += outcome.all_ended ? 1 : 0;
    ticks += outcome.ticks;
  }
  // Else it is in step because nobody moves.
  CHECK(ended > kTrials / 4);
  CHECK(ticks > 100 * kTrials);
}

TEST_CASE("a team without trouble ends, and a cut only delays it") {
  TeamTrial trial;
  trial.robots = 3;
  trial.repeats = true;
  trial.barriers = {0, 0.25, 0.75};
  CHECK(try_team(trial, 1).all_ended);
  trial.network.cuts = {{from_seconds(0.4), from_seconds(1.4)}};
  const Outcome cut = try_team(trial, 1);
  CHECK(cut.all_ended);
  CHECK(cut.broken == "");
  trial.network.cuts = {{from_seconds(0), from_seconds(100)}};
  CHECK_FALSE(try_team(trial, 1).all_ended);
}

}  // namespace lockstep::host::test::team_trial
