#include "verify/counter_example.h"

#include <fmt/format.h>

#include "base/system/output_file.h"
#include "judge/measure/property_steps.h"
#include "record/write/recorder.h"
#include "run/cut_text.h"
#include "run/loop.h"
#include "run/shape_of.h"
#include "verify/same_tick.h"

namespace lockstep::host {
namespace {

// Says to a person who opens one of the files what it is for.
std::string heading(const Finding& finding) {
  std::string text = fmt::format("{}: {}", finding.name, finding.message);
  if (finding.repeats) text += fmt::format("; repeats from tick {}", *finding.repeats);
  return text;
}

// The property that the finding is about, or none. No run knows facts.
std::vector<Property> property_of(const Tree& tree, const Finding& finding,
                                  std::span<const Property> properties) {
  std::vector<Property> found;
  for (const Property& it : properties) {
    const bool is_meant = finding.name == name_of_finding(it);
    if (is_meant && !names_fact(it, tree)) found.push_back(it);
  }
  return found;
}

// Sees whether a run shows what was found.
class Confirmation final : public Observer {
 public:
  Confirmation(const Tree& tree, const Finding& finding, Tracer& tracer,
               std::span<const Property> properties)
      : finding_(finding),
        tracer_(tracer),
        checks_(property_of(tree, finding, properties)),
        steps_(checks_) {}

  // Before the first tick of the run.
  void watch(const Ticker& run) { run_ = &run; }

  AskedOfRun asked() const override { return steps_.asked(); }
  void after_tick(const Moment& moment, const TickReport& report) override {
    steps_.after_tick(moment);
    if (!wrong_.empty() || ticks_ == finding_.run.size()) return;
    const Status status = tracer_.tick(finding_.run[ticks_++]);
    std::string wrong = difference(*run_, tracer_.ticker());
    if (wrong.empty() && status != report.status) {
      wrong = fmt::format("the tree is {}; in the search, it is {}", to_string(report.status),
                          to_string(status));
    }
    if (!wrong.empty()) wrong_ = fmt::format("in tick {}, {}", report.tick, wrong);
  }
  void run_ended(const Moment&, const RunEnd& end) override {
    const bool by_itself = end.reason == StopReason::Completed || end.reason == StopReason::Fault;
    if (by_itself) checks_.end(RunIsOver::ByItself);
  }

  // "" if it has shown it.
  std::string wrong() const {
    if (!wrong_.empty()) return wrong_;
    if (ticks_ != finding_.run.size()) return fmt::format("it ends after {} ticks", ticks_);
    const bool is_shown = finding_.repeats || checks_.all().empty() ||
                          checks_.verdict(0) == PropertyVerdict::Violated;
    return is_shown ? "" : "it does not violate the property";
  }

 private:
  const Finding& finding_;
  Tracer& tracer_;
  const Ticker* run_ = nullptr;
  PropertyChecks checks_;
  PropertySteps steps_;
  std::size_t ticks_ = 0;
  std::string wrong_;
};

// Returns "" or why it cannot be written.
std::string record(const Tree& tree, const LeafScripts& scripts, const std::string& path,
                   const Finding& finding, Confirmation& confirmation,
                   const CounterExampleOptions& options) {
  Recorder recorder(shape_of(tree), {.path = path,
                                     .run = {.tree_file = options.tree_file,
                                             .rate_hz = options.rate,
                                             .arguments = options.arguments,
                                             .values = options.values,
                                             .verify = heading(finding)}});
  if (!recorder.error().empty()) return recorder.error();
  VirtualClock clock;
  Run run(tree, {.rate = options.rate, .virtual_time = true});
  confirmation.watch(run.ticker());
  Observer* const observers[] = {&recorder, &confirmation};
  LoopOptions loop;
  loop.rate = options.rate;
  loop.max_ticks = scripts.ticks;
  loop.cuts = scripts.cuts;
  loop.cut = [&](std::span<const CutLeaf> cut) {
    recorder.log("lockstep", "info", cut_text(cut, tree));
  };
  run_loop(run, clock, loop, observers);
  return recorder.error();
}

}  // namespace

bool ends(const Tree& tree, const LeafScripts& scripts, PlayedLeaves& played, double rate) {
  constexpr std::uint64_t kMostTicks = 10'000;
  played.set_scripts(scripts);
  VirtualClock clock;
  Run run(tree, {.rate = rate, .virtual_time = true});
  LoopOptions loop;
  loop.rate = rate;
  loop.max_ticks = kMostTicks;
  loop.cuts = scripts.cuts;
  return run_loop(run, clock, loop, {}).reason != StopReason::MaxTicks;
}

Result<CounterExample> write_counter_example(const Tree& tree, const Finding& finding,
                                             Tracer& tracer, PlayedLeaves& played,
                                             std::span<const Property> properties,
                                             const CounterExampleOptions& options) {
  CounterExample files{options.stem + ".jsonl", options.stem + ".leaves"};
  LeafScripts scripts = tracer.scripts(finding.run);
  scripts.rate = options.rate;
  const auto written =
      write_output(files.leaves, "# " + heading(finding) + '\n' + to_text(scripts));
  if (!written) return tl::unexpected(written.error());
  played.set_scripts(scripts);
  Confirmation confirmation(tree, finding, tracer, properties);
  std::string error = record(tree, scripts, files.recording, finding, confirmation, options);
  if (!error.empty()) return problem(std::move(error));
  files.contradiction = confirmation.wrong();
  files.scripts = std::move(scripts);
  return files;
}

}  // namespace lockstep::host
