// `verify --probability` from outside: what it prints, and that runs by chance agree with it.
#include <catch2/catch.hpp>
#include <cmath>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

struct ChanceModel {
  std::string tree, rows;
};

std::string tree_of(const ChanceModel& model) {
  return "<root lockstep=\"1\"><plugin name=\"motion\"/><plugin name=\"fetch\"/><BehaviorTree "
         "ID=\"M\">" +
         model.tree + "</BehaviorTree></root>\n";
}
std::string leaves_of(const ChanceModel& model) {
  return "<leaves lockstep=\"1\" rate=\"10\">" + model.rows + "</leaves>\n";
}

const ChanceModel kChanceModels[] = {
    {R"(<Retry attempts="2"><Advance name="a" step="0.1"/></Retry>)",
     R"(<leaf of="Advance" result="success:0.3;failure:0.7" ticks="3" progress="none"/>)"},
    {R"(<Fallback memory="true"><Timeout seconds="0.5"><Advance name="a" step="0.1"/></Timeout>)"
     R"(<Sequence memory="true"><Advance name="b" step="0.1"/><Advance name="c" step="0.1"/>)"
     R"(</Sequence></Fallback>)",
     R"(<leaf of="Advance" result="success:0.6;failure:0.4" ticks="2..9" progress="none"/>)"},
    {R"(<Retry attempts="3"><Sequence memory="true"><Advance name="a" step="0.1"/>)"
     R"(<BatteryAbove level="0.5"/></Sequence></Retry>)",
     R"(<fact name="full" chance="0.25"/><leaf of="BatteryAbove" fact="full"/>)"
     R"(<leaf of="Advance" result="success:0.5;failure:0.5" ticks="1..2" progress="none"/>)"},
    {R"(<Parallel success_count="2" failure_count="2"><Advance name="a" step="0.1"/>)"
     R"(<Advance name="b" step="0.1"/><Advance name="c" step="0.1"/></Parallel>)",
     R"(<leaf of="Advance" result="success:0.7;failure:0.3" ticks="1..4" progress="none"/>)"},
};

}  // namespace

TEST_CASE("verify prints each result with its probability") {
  const TemporaryDirectory directory;
  const ChanceModel& model = kChanceModels[0];
  const std::string tree = directory.file("t.xml", tree_of(model)),
                    leaves = directory.file("t.leaves.xml", leaves_of(model));
  const auto verify = [&](std::vector<std::string> more) {
    std::vector<std::string> call{"verify", tree, "--leaves", leaves, "--probability"};
    call.insert(call.end(), more.begin(), more.end());
    return run_lockstep(call);
  };
  const Outcome text = verify({"--property", "quiet: never a.failure"});
  INFO(text.err << text.out);
  CHECK(text.code == 0);
  CHECK(contains(text.out, "\n  success           0.51\n"));
  CHECK(contains(text.out, "\n  failure           0.49\n"));
  CHECK(contains(text.out, "\n  ends              1\n"));
  CHECK(contains(text.out, "\n  property 'quiet'  0.3\n"));
  CHECK(contains(text.out, "\n  error: less than "));
  CHECK_FALSE(contains(text.out, "from the least"));
  const Outcome few = verify({"--states", "2"});
  CHECK(few.code == 124);
  CHECK(contains(few.out, "unknown: in "));
  for (const char* const other : {"--fmea", "--cuts", "--compact"})
    CHECK(verify({other}).code == 2);
}

#if !defined(__SANITIZE_THREAD__)  // there, the search alone takes all the time
// A walk by chance from the middle: the numbers need minutes to come near.
TEST_CASE("probabilities that come near slowly end within --time, with the interval until then") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("walk.xml", R"(<root BTCPP_format="4">
<BehaviorTree ID="T"><Sequence><Script code="n := 2000"/>
<ForceSuccess><KeepRunningUntilFailure><Sequence>
<Fallback><Sequence><Step/><Script code="n += 1"/></Sequence><Script code="n -= 1"/></Fallback>
<Sleep msec="100"/><ScriptCondition code="n &gt; 0 &amp;&amp; n &lt; 4000"/>
</Sequence></KeepRunningUntilFailure></ForceSuccess>
<ScriptCondition code="n &gt; 0"/></Sequence></BehaviorTree></root>)");
  const std::string leaves = directory.file(
      "walk.leaves.xml",
      R"(<leaves lockstep="1"><leaf of="Step" result="success:0.5;failure:0.5" ticks="1"/></leaves>)");
  const Outcome it = run_lockstep({"verify", tree, "--mock", "--leaves", leaves, "--probability",
                                   "--time", "2", "--property", "calm: never Step.skipped"});
  INFO(it.out);
  CHECK(it.code == 124);
  CHECK(it.cpu_seconds < 2.5);
  CHECK(contains(it.out, "\n  success          unknown: in 0 to 1\n"));
  CHECK(contains(it.out, "\n  ends             1\n"));
  CHECK(contains(it.out, "\n  property 'calm'  1\n"));
  CHECK(
      contains(it.out, "not all is known: the time was over before the numbers were near enough"));
}
#endif

TEST_CASE("runs by chance agree with the probabilities") {
  constexpr double kRuns = 3000;
  for (const ChanceModel& model : kChanceModels) {
    const TemporaryDirectory directory;
    const std::string tree = directory.file("t.xml", tree_of(model)),
                      leaves = directory.file("t.leaves.xml", leaves_of(model));
    INFO(tree_of(model));
    const auto found = parse_json(
        run_lockstep({"verify", tree, "--leaves", leaves, "--probability", "--json"}).out);
    const auto& success = found["probabilities"][0];
    REQUIRE(success["name"] == "success");
    const double least = success["least"][0], most = success["most"][1];
    const Outcome study =
        run_lockstep({"study", tree, "--leaves", leaves, "--runs", "3000", "--measure", "success",
                      "--seed", "7", "--json", "--no-plots", "--out", directory.path("study")});
    INFO(study.err << study.out);
    REQUIRE(study.code == 0);
    const double mean = parse_json(study.out)[0]["mean"];
    const auto sigma = [](double chance) { return std::sqrt(chance * (1 - chance) / kRuns); };
    INFO(least << " to " << most);
    CHECK(mean >= least - 4 * sigma(least) - 1e-9);
    CHECK(mean <= most + 4 * sigma(most) + 1e-9);
  }
}
