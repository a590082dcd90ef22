// Properties on random trees: the verdict on a recording is the one that the run had.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <map>
#include <sstream>

#include "judge/summary/property_observer.h"
#include "property/btcpp_tree.h"
#include "property/random_source.h"
#include "property/random_tree.h"
#include "record/use/recorded_properties.h"
#include "record/write/recorder.h"
#include "unit/recording/watched_run.h"

namespace lockstep::host::test {
namespace {

constexpr int kPropertyTrees = 1500, kProperties = 20;

class PropertyGenerator : private RandomSource {
 public:
  PropertyGenerator(std::uint64_t seed, const PropertyNames& names)
      : RandomSource(seed), names_(names) {}

  std::string text() {
    const std::string ticks = fmt::format(" {} ticks", between(0, 6));
    switch (between(0, 6)) {
      case 0:
        return "never " + formula(2);
      case 1:
        return "sometimes " + formula(2);
      case 2:
        return formula(1) + " leads to " + formula(1);
      case 3:
        return formula(1) + " leads to " + formula(1) + " within" + ticks;
      case 4:
        return formula(1) + " only after " + formula(1);
      case 5:
        return formula(1) + " at most" + ticks;
      default:
        return formula(1) + " until " + formula(1);
    }
  }

 private:
  std::string formula(int depth) {
    if (depth > 0 && one_in(3)) return "not " + formula(depth - 1);
    if (depth > 0 && one_in(2)) {
      return fmt::format("({} {} {})", formula(depth - 1), one_in(2) ? "and" : "or",
                         formula(depth - 1));
    }
    if (!names_.entries.empty() && one_in(4)) return entry();
    const std::string node = fmt::format("'{}'", pick(names_.paths));
    if (one_in(3)) return fmt::format("{}.progress {} 0.{}", node, relation(), between(0, 9));
    constexpr std::array kFields = {"running", "success", "failure", "idle",
                                    "skipped", "done",    "held",    "ticked"};
    return node + "." + pick(kFields);
  }

  std::string entry() {
    const auto& it = names_.entries[static_cast<std::size_t>(
        between(0, static_cast<int>(names_.entries.size()) - 1))];
    std::string constant = fmt::format("{}", between(-1, 3));
    const char* how = relation();
    if (it.type == "bool" || it.type == "string") {
      constant = it.type == "bool" ? "true" : "'" + constant + "'";
      how = one_in(2) ? "==" : "!=";
    }
    return fmt::format("{{{}}} {} {}", it.key, how, constant);
  }

  const char* relation() {
    constexpr std::array kRelations = {"<", "<=", "==", "!=", ">=", ">"};
    return pick(kRelations);
  }

  const PropertyNames& names_;
};

struct Verdict {
  std::string text;
  std::optional<std::uint64_t> tick;
  bool operator==(const Verdict&) const = default;
};

using Verdicts = std::map<std::string, int>;  // how often each verdict

void check_verdicts(WatchedRun& run, std::uint64_t ticks, std::uint64_t seed, Verdicts& seen) {
  const PropertyNames names = property_names(shape_of(run.run.tree()));
  PropertyGenerator generator(seed, names);
  std::vector<std::string> texts;
  std::vector<Property> properties;
  while (properties.size() < kProperties) {
    texts.push_back(generator.text());
    auto property = Property::parse(texts.back(), names);
    INFO(texts.back());
    REQUIRE(property);
    properties.push_back(std::move(*property));
  }
  const TemporaryPath file;
  Recorder recorder(run.run.tree(),
                    {.path = file.path(), .run = {.tree_file = "a.xml", .rate_hz = 10}});
  std::size_t told = 0;
  PropertyObserver watch(properties, [&told](const Property&, const std::string&) { ++told; });
  run.watch({&watch, &recorder}, ticks);
  Summary live;
  watch.add_to(live);

  std::istringstream text(file.text());
  RecordingReader reader(text, "run.jsonl");
  std::vector<Property> again;
  const PropertyNames recorded = property_names(reader.header());
  for (const std::string& it : texts) again.push_back(Property::parse(it, recorded).value());
  PropertyChecks checks(std::move(again));
  check_recording(reader, checks);
  REQUIRE(reader.error().empty());
  std::size_t violated = 0;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const Verdict of_run{std::string(to_string(live.properties[i].verdict)),
                         live.properties[i].tick};
    const Verdict of_recording{std::string(to_string(checks.verdict(i))), checks.decided(i)};
    INFO(texts[i] << ": " << of_run.text << ", of the recording " << of_recording.text);
    CHECK(of_recording == of_run);
    ++seen[of_run.text];
    violated += of_run.text == "violated" ? 1 : 0;
  }
  CHECK(told == violated);
}

void check_seen(Verdicts& seen) {
  for (const char* verdict : {"holds", "violated", "open"}) {
    INFO(verdict);
    CHECK(seen[verdict] > 300);
  }
}

}  // namespace

TEST_CASE("a recording of a random tree has the verdicts of its run") {
  Verdicts seen;
  for (std::uint64_t seed = 0; seed < kPropertyTrees; ++seed) {
    const Trial trial = random_trial(seed);
    INFO("seed " << seed << ": " << tree_text(trial.plan) << ", " << leaves_text(trial.plan));
    WatchedRun run(tree_text(trial.plan), leaves_text(trial.plan));
    check_verdicts(run, static_cast<std::uint64_t>(trial.ticks), seed, seen);
  }
  check_seen(seen);
}

// Their ticks have several moments where a child completes at once.
TEST_CASE("a recording of a random tree for BehaviorTree.CPP has the verdicts of its run") {
  Verdicts seen;
  for (std::uint64_t seed = 1; seed <= kPropertyTrees; ++seed) {
    const law::Document document = law::random_document(seed);
    INFO("seed " << seed << "\n" << law::to_xml(document) << "\n" << law::leaves_text(document));
    WatchedRun run(law::tree_of(document), law::leaves_text(document));
    check_verdicts(run, 12, seed, seen);
  }
  check_seen(seen);
}

}  // namespace lockstep::host::test
