// Random robots that share resources over a network that is late, loses words and is cut; some are
// killed, and started again or not. What they really use is written down beside the network, and no
// resource ever has two owners.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <vector>

#include "base/core/random.h"
#include "property/simulated_robot.h"

namespace lockstep::host::test::pool_trial {
namespace {

// What is used, in the bits of the names a to f: the port of the leaf is its own.
struct Using {
  RandomStream random{0, 0};
  double ends = 0.1, fails = 0;
};
thread_local Using* using_here = nullptr;

void* create(const lockstep_host*, const lockstep_caller*, void*) {
  return using_here;
}
lockstep_status tick(void* self) {
  Using& it = *static_cast<Using*>(self);
  const double luck = it.random.next_double();
  if (luck < it.fails) return LOCKSTEP_FAILURE;
  return luck < it.fails + it.ends ? LOCKSTEP_SUCCESS : LOCKSTEP_RUNNING;
}

const lockstep_leaf_type kWork = tables::leaf_type(
    "Work", create, [](void*) {}, tick);

constexpr unsigned kResources = 4;

struct PoolTrial {
  std::size_t robots = 3;
  bool restarts = false, stays_away = false;  // processes are killed, and started again
  bool leaves_early = false;                  // the first ones end their runs
  double fails = 0;
  NetworkOptions network;
  std::uint64_t seed = 0;
};

// A random tree: jobs that need some of the resources, one after the other or at once.
std::string tree_of(const PoolTrial& trial, std::size_t number) {
  RandomStream random(trial.seed, 1000 + number);
  const auto below = [&](unsigned most) {
    return static_cast<unsigned>(most * random.next_double());
  };
  const auto job = [&] {
    std::string set, names;
    for (unsigned i = 0; i < kResources; ++i) {
      if (below(3) == 0) set += static_cast<char>('a' + i);
    }
    if (set.empty()) set = std::string(1, static_cast<char>('a' + below(kResources)));
    for (const char it : set) names += fmt::format("{};", it);
    return fmt::format(
        R"(<UseResources pool="p" resources="{}"><Work name="job_{}"/></UseResources>)", names,
        set);
  };
  std::string jobs;
  const unsigned count = 1 + below(4);
  for (unsigned i = 0; i < count; ++i) {
    const bool is_limited = below(4) == 0;
    jobs += is_limited ? R"(<Timeout seconds="0.3">)" + job() + "</Timeout>" : job();
  }
  const std::string inner =
      below(2) == 0
          ? fmt::format(R"(<Parallel success_count="{}">{}</Parallel>)", 1 + below(count), jobs)
          : fmt::format(R"(<Sequence memory="true">{}</Sequence>)", jobs);
  const bool leaves = trial.leaves_early && number == 0;
  std::string members;
  for (std::size_t i = 0; i < trial.robots; ++i) members += fmt::format("{}r{}", i ? ";" : "", i);
  return fmt::format(
      R"(<root lockstep="1"><team name="t" members="{}"/>
<resources name="p" team="t" as="r{}" resources="a;b;c;d"/>
<BehaviorTree ID="M"><Repeat times="{}"><ForceSuccess>{}</ForceSuccess></Repeat></BehaviorTree></root>)",
      members, number, leaves ? 2 : 8, inner);
}

class Robot : public SimulatedRobot {
 public:
  Robot(const PoolTrial& trial, std::size_t number)
      : SimulatedRobot(tree_of(trial, number), kWork,
                       std::chrono::milliseconds(7 + 3 * static_cast<int>(number)), number) {
    using_ = {.random = RandomStream(trial.seed, number + 1), .ends = 0.1, .fails = trial.fails};
    const Tree& tree = this->tree();
    for (const LeafNode& leaf : tree.leaves) {
      if (tree.labels[leaf.node].type->id != "Work") continue;
      std::uint64_t set = 0;
      for (const char it : tree.labels[leaf.node].name.substr(4)) set |= 1u << (it - 'a');
      jobs_.push_back({tree.labels[leaf.node].parent, leaf.node, set});
    }
  }

  void begin(SimulatedNetwork& network, Nanoseconds now) {
    using_here = &using_;
    SimulatedRobot::begin(network, now);
    used_ = 0;
  }
  void kill(SimulatedNetwork& network) {
    SimulatedRobot::end(network);
    used_ = 0;
  }

  // What it uses from its last tick on; and in that, what it had until then too.
  std::uint64_t used() const { return used_; }
  std::uint64_t used_in_tick() const { return used_in_tick_; }
  std::uint64_t jobs_done() const { return done_; }

  void tick() {
    const std::uint64_t before = used_;
    SimulatedRobot::tick([&](const Ticker& ticker) {
      used_ = 0;
      used_in_tick_ = before;
      for (const Job& it : jobs_) {
        const Status child = ticker.status(it.child);
        if (ticker.ticked(it.child)) used_in_tick_ |= it.set;
        if (ticker.ticked(it.child) && child == Status::Success) ++done_;
        if (ticker.status(it.user) == Status::Running && child == Status::Running) used_ |= it.set;
      }
    });
  }

 private:
  struct Job {
    NodeIndex user, child;
    std::uint64_t set;
  };
  Using using_;
  std::vector<Job> jobs_;
  std::uint64_t used_ = 0, used_in_tick_ = 0, done_ = 0;
};

struct Outcome {
  std::string broken;  // "": nothing was
  bool all_ended = false;
  std::uint64_t done = 0;
};

// Where a robot uses nothing in its tick that another one uses from its last tick to its next.
Outcome try_team(const PoolTrial& trial) {
  SimulatedNetwork network(trial.network);
  RandomStream random(trial.seed, 99);
  std::vector<std::unique_ptr<Robot>> robots;
  std::vector<bool> is_gone(trial.robots);
  for (std::size_t i = 0; i < trial.robots; ++i) {
    robots.push_back(std::make_unique<Robot>(trial, i));
    robots[i]->begin(network, from_seconds(0.2 * random.next_double()));
  }
  Outcome outcome;
  const Nanoseconds last = std::chrono::seconds(20);
  while (true) {
    const std::size_t number = next_robot(robots, last, [&](std::size_t i) { return is_gone[i]; });
    if (number == robots.size()) break;
    Robot* const next = robots[number].get();
    if (trial.restarts && random.next_double() < 0.002) {
      next->kill(network);
      is_gone[number] = trial.stays_away && random.next_double() < 0.3;
      const Nanoseconds pause = from_seconds(0.3 * random.next_double());
      if (!is_gone[number]) next->begin(network, next->next() + pause);
      continue;
    }
    next->tick();
    for (std::size_t i = 0; i < robots.size(); ++i) {
      if (i == number || is_gone[i] || !outcome.broken.empty()) continue;
      const std::uint64_t both = robots[i]->used() & next->used_in_tick();
      if (both == 0) continue;
      outcome.broken = fmt::format("seed {}: r{} and r{} use {:#x} at {} ns", trial.seed, number, i,
                                   both, next->now().count());
    }
  }
  for (std::size_t i = 0; i < robots.size(); ++i) outcome.done += robots[i]->jobs_done();
  outcome.all_ended = std::ranges::all_of(robots, [](const auto& it) { return it->is_over(); });
  for (const auto& it : robots) it->end(network);
  return outcome;
}

PoolTrial random_team(std::uint64_t seed) {
  RandomStream random(seed, 7);
  const auto below = [&](double most) { return most * random.next_double(); };
  PoolTrial trial;
  trial.seed = seed;
  trial.robots = 2 + static_cast<std::size_t>(below(4));
  trial.restarts = below(1) < 0.4;
  trial.stays_away = below(1) < 0.2;
  trial.leaves_early = below(1) < 0.5;
  trial.fails = below(1) < 0.3 ? 0.05 : 0;
  trial.network.latency = from_seconds(below(0.05));
  trial.network.jitter = from_seconds(below(1) < 0.5 ? 0 : below(0.05));
  trial.network.loss = below(1) < 0.5 ? 0 : below(0.3);
  if (below(1) < 0.4) {
    const double from = below(4);
    trial.network.cuts.push_back({from_seconds(from), from_seconds(from + below(2))});
  }
  trial.network.seed = seed;
  return trial;
}

}  // namespace

TEST_CASE("no resource that robots share has two owners, whatever the network does") {
  constexpr std::uint64_t kTrials = 600;
  std::uint64_t ended = 0, done = 0;
  for (std::uint64_t seed = 0; seed < kTrials; ++seed) {
    const Outcome outcome = try_team(random_team(seed));
    REQUIRE(outcome.broken == "");
    ended += outcome.all_ended ? 1 : 0;
    done += outcome.done;
  }
  CHECK(ended > kTrials / 4);
  CHECK(done > 20 * kTrials);
}

}  // namespace lockstep::host::test::pool_trial
