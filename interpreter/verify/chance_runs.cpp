#include "verify/chance_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "base/core/random.h"
#include "judge/measure/property_steps.h"
#include "run/live_moments.h"
#include "run/run.h"
#include "verify/same_tick.h"

namespace lockstep::host {
namespace {

constexpr std::uint64_t kFewestTicks = 20, kMostTicks = 1000;

// As `run --leaves` has them: the first leaf's random numbers choose for all.
class ChanceAnswers final : public Answers {
 public:
  explicit ChanceAnswers(std::uint64_t seed) : random_(seed, 1) {}

  std::uint32_t choose(std::uint32_t count, std::uint32_t asker) override {
    const auto answer = static_cast<std::uint32_t>(random_.next_double() * count);
    if (count > 1) asked.push_back({asker, answer});
    return answer;
  }
  std::uint32_t draw(std::span<const double> chances, std::uint32_t asker) override {
    const std::uint32_t answer = drawn(chances, random_.next_double());
    if (chances.size() > 1) asked.push_back({asker, answer});
    return answer;
  }
  // A run of many ticks is cut at any of them.
  bool is_cut(std::uint32_t asker) {
    constexpr double kOften = 0.15;
    const bool is_cut = random_.next_double() < kOften;
    asked.push_back({asker, is_cut ? 1u : 0u});
    return is_cut;
  }
  std::vector<LeafAnswer> asked;  // in this tick

 private:
  RandomStream random_;
};

class PlainRun {
 public:
  PlainRun(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
           const Deadlines& deadlines, std::uint64_t seed)
      : deadlines_(deadlines),
        models_(models),
        cuts_(models.cuts),
        cut_asker_(cut_asker(tree, models)),
        board_(tree),
        answers_(seed),
        leaves_(tree, models, board_, answers_),
        ticker_(tree, leaves_.slots(), board_),
        places_(places_of(properties, tree)),
        checks_(at(places_, properties)),
        steps_(checks_),
        moments_(tree, steps_.asked()) {
    ticker_.set_deadlines(deadlines);
  }

  Status tick(std::uint64_t number) {
    const Nanoseconds now = deadlines_.at(number);
    answers_.asked.clear();
    const bool is_cut = cut_ < cuts_.most &&
                        std::ranges::any_of(leaves_.states(), &LeafState::notices_cut) &&
                        answers_.is_cut(cut_asker_);
    leaves_.begin_tick();
    if (is_cut) {
      ++cut_;
      after_cut(ticker_, models_, answers_, leaves_);
    }
    leaves_.drift();
    ticker_.set_now(now);
    moments_.before_tick(ticker_);
    Status status = ticker_.tick_root();
    for (int more = 1; status == Status::Running && !ticker_.faulted(); ++more) {
      const auto asks = ticker_.take_request();
      if (!asks) break;
      if (more == Run::kMostTicksAtOnce) {
        ticker_.set_fault(*asks, "requested another tick 10,000 times in one period");
      } else {
        status = ticker_.tick_root_again();
      }
    }
    note(steps_.after_tick(moments_.after_tick(ticker_, number, now)));
    if (status != Status::Running || ticker_.faulted()) note(checks_.end(RunIsOver::ByItself));
    leaves_.fold();
    return status;
  }
  const Ticker& ticker() const { return ticker_; }
  const ModelLeaves& leaves() const { return leaves_; }
  std::span<const LeafAnswer> asked() const { return answers_.asked; }
  std::span<const std::size_t> violated() const { return violated_; }

 private:
  // No run knows facts.
  static std::vector<std::size_t> places_of(std::span<const Property> properties,
                                            const Tree& tree) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < properties.size(); ++i) {
      if (!names_fact(properties[i], tree)) places.push_back(i);
    }
    return places;
  }
  static std::vector<Property> at(std::span<const std::size_t> places,
                                  std::span<const Property> properties) {
    std::vector<Property> found;
    for (const std::size_t it : places) found.push_back(properties[it]);
    return found;
  }
  void note(std::span<const std::size_t> violated) {
    for (const std::size_t it : violated) violated_.push_back(places_[it]);
  }

  const Deadlines& deadlines_;
  const LeafModels& models_;
  const ProcessCuts cuts_;
  const std::uint32_t cut_asker_;
  std::uint32_t cut_ = 0;  // so often
  Blackboard board_;
  ChanceAnswers answers_;
  ModelLeaves leaves_;
  Ticker ticker_;
  const std::vector<std::size_t> places_;  // of the properties that are checked
  PropertyChecks checks_;
  PropertySteps steps_;
  LiveMoments moments_;
  std::vector<std::size_t> violated_;
};

class Judge {
 public:
  Judge(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
        double rate, const SearchResult& found)
      : tree_(tree),
        models_(models),
        properties_(properties),
        deadlines_(rate),
        found_(found),
        stepper_(tree, models, properties, rate, found.symmetry, false, found.few_root_ticks),
        ticks_(std::min<std::uint64_t>(found.complete_depth(), most_ticks(found))) {}

  // Gives what contradicts the search; "" if nothing does. `goes_on` is asked before each tick.
  template <class GoesOn>
  std::string look_at(std::uint64_t seed, const GoesOn& goes_on) {
    PlainRun run(tree_, models_, properties_, deadlines_, seed);
    state_ = stepper_.first_state();
    for (std::uint64_t tick = 0; tick < ticks_ && goes_on(); ++tick) {
      const Status status = run.tick(tick);
      const bool is_over = status != Status::Running || run.ticker().faulted();
      std::string wrong = wrong_in(run, status, tick, is_over);
      if (!wrong.empty()) return fmt::format("in tick {}, {}", tick, wrong);
      if (is_over) break;
    }
    return "";
  }

 private:
  // In a complete search no state is farther, and cycles are seen after a while.
  static std::uint64_t most_ticks(const SearchResult& found) {
    if (!found.is_complete()) return kMostTicks;
    return std::min(kMostTicks, kFewestTicks + 2 * std::uint64_t{found.depths.size()});
  }

  std::string wrong_in(const PlainRun& run, Status status, std::uint64_t tick, bool is_over) {
    std::string wrong = result(run, status, tick);
    if (wrong.empty()) wrong = coverage(run.ticker());
    if (wrong.empty()) wrong = step(run, tick == 0, is_over);
    return wrong;
  }

  // What the verdict says of results, faults and properties.
  std::string result(const PlainRun& run, Status status, std::uint64_t tick) const {
    const Ticker& ticker = run.ticker();
    const auto has_come = [&](const std::optional<Occurrence>& it) {
      return it && it->ticks <= tick + 1;
    };
    if (!run.leaves().broken().empty() && !found_.broken) return run.leaves().broken();
    for (const std::size_t it : run.violated()) {
      if (!found_.violated.contains(it)) {
        return fmt::format("property '{}' is violated", properties_[it].name());
      }
    }
    if (const Fault* fault = ticker.fault()) {
      if (found_.faults.contains(fault->node)) return "";
      return fmt::format("'{}' {}", tree_.path(fault->node), fault->message);
    }
    if (status == Status::Running || has_come(found_.results[index_of(status)])) return "";
    return fmt::format("the tree ends with {}", to_string(status));
  }

  std::string coverage(const Ticker& ticker) const {
    if (ticker.faulted()) return "";
    for (NodeIndex node = 0; node < tree_.nodes[0].end; ++node) {
      if (!ticker.ticked(node)) continue;
      if (!found_.coverage.was_ticked(node)) {
        return fmt::format("'{}' is ticked", tree_.path(node));
      }
      const Status status = ticker.status(node);
      if (status == Status::Idle) continue;  // halted in the same tick: no verdict depends on it
      if (!found_.coverage.has_been(node, status)) {
        return fmt::format("'{}' is {}", tree_.path(node), to_string(status));
      }
    }
    return "";
  }

  // The same tick from the state of the search, and whether that knows the next one.
  std::string step(const PlainRun& run, bool is_first, bool is_over) {
    stepper_.load(state_, is_first);
    stepper_.give(run.asked());
    try {
      stepper_.tick();
    } catch (const std::logic_error& error) {
      return error.what();
    }
    std::string wrong = difference(run.ticker(), stepper_.ticker());
    if (!wrong.empty() || is_over) return wrong;
    const StateBytes& sorted = stepper_.fold();
    if (!found_.store.keeps_hashes() && found_.store.find(sorted, hash_of(sorted)) == kNoState) {
      return "the tree comes to a state that the search has not";
    }
    state_ = stepper_.in_place();
    return "";
  }

  const Tree& tree_;
  const LeafModels& models_;
  const std::span<const Property> properties_;
  const Deadlines deadlines_;
  const SearchResult& found_;
  Stepper stepper_;
  const std::uint64_t ticks_;  // of a run
  StateBytes state_;
};

}  // namespace

ChanceLimits usual_chance(const SearchResult& found) {
  constexpr Nanoseconds kLeast = std::chrono::milliseconds(100), kMost = std::chrono::seconds(2);
  return {.time = std::clamp(found.took / 20, kLeast, kMost)};
}

std::string to_text(const Contradiction& contradiction) {
  return fmt::format("internal error: a run contradicts this proof; the seed is {}: {}",
                     contradiction.seed, contradiction.what);
}

std::optional<Contradiction> find_contradiction(const Tree& tree, const LeafModels& models,
                                                std::span<const Property> properties, double rate,
                                                const SearchResult& found,
                                                const ChanceLimits& limits) {
  const Nanoseconds began = monotonic_now();
  const auto goes_on = [&] {
    return monotonic_now() - began < limits.time && !(limits.stop_signal && limits.stop_signal());
  };
  if (found.complete_depth() == 0 || !goes_on()) return std::nullopt;
  Judge judge(tree, models, properties, rate, found);
  for (std::uint64_t seed = 0; seed < limits.runs && goes_on(); ++seed) {
    std::string what = judge.look_at(seed, goes_on);
    if (!what.empty()) return Contradiction{seed, std::move(what)};
  }
  return std::nullopt;
}

}  // namespace lockstep::host
