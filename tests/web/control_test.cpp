// A run that is controlled from a browser, from outside.
#include <catch2/catch.hpp>

#include <memory>

#include "support/json.h"
#include "web/client.h"

using namespace lockstep::host::test;
using nlohmann::json;

namespace {

const std::string kPull = tree_text(
    "<Sequence name=\"all\" memory=\"true\"><Wait name=\"rest\" seconds=\"{pause}\"/>"
    "<ParallelAbsolute name=\"pull\" barriers=\"0.5\"><Advance name=\"arm\" step=\"0.1\"/>"
    "<Advance name=\"base\" step=\"0.25\"/></ParallelAbsolute></Sequence>");

// A run of this tree that begins paused, and who controls it.
class Controlled {
 public:
  explicit Controlled(const std::string& tree, std::vector<std::string> more = {})
      : Controlled(std::make_unique<TemporaryDirectory>(), tree, std::move(more)) {}
  // Of a file that stays.
  Controlled(const TemporaryDirectory& directory, const std::string& tree,
             std::vector<std::string> more)
      : run_(with(directory.file("tree.xml", tree), std::move(more))), events_(run_.port()) {
    events_.send(get_text(run_.port(), "/events", token()));
  }

  Response order(const json& body) { return post(run_.port(), "/control", body.dump(), token()); }
  // Until the tick has its line: the run stands, or it would have none.
  void wait_for_tick(int tick) {
    REQUIRE(events_.wait_for("{\"tick\":" + std::to_string(tick) + ","));
  }
  std::string token() const { return "X-Lockstep-Token: " + run_.token() + "\r\n"; }
  MonitoredRun& run() { return run_; }
  Client& events() { return events_; }

 private:
  static std::vector<std::string> with(const std::string& tree, std::vector<std::string> more) {
    more.insert(more.begin(), {tree, "--monitor", "--monitor-control", "--monitor-paused"});
    return more;
  }
  Controlled(std::unique_ptr<TemporaryDirectory> directory, const std::string& tree,
             std::vector<std::string> more)
      : Controlled(*directory, tree, std::move(more)) {
    directory_ = std::move(directory);
  }

  std::unique_ptr<TemporaryDirectory> directory_;  // null: another one's
  MonitoredRun run_;
  Client events_;
};

}  // namespace

TEST_CASE("a run that is paused and ticked step by step comes to the same end") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", kPull);
  const std::vector<std::string> options{"--clock", "virtual", "--set", "pause=0.2"};
  const Outcome alone = run_lockstep({"run", tree, "--clock", "virtual", "--set", "pause=0.2"});
  Controlled it(kPull, options);
  REQUIRE(it.events().wait_for("\"state\":\"paused\""));
  CHECK(it.order({{"do", "step"}, {"ticks", 3}}).status == 204);
  it.wait_for_tick(2);
  for (int step = 0; step < 6; ++step) CHECK(it.order({{"do", "step"}}).status == 204);
  it.wait_for_tick(8);
  CHECK(it.order({{"do", "speed"}, {"factor", 100}}).status == 204);
  CHECK(it.order({{"do", "resume"}}).status == 204);
  CHECK(contains(it.events().finish(), "\"result\":\"success\""));
  const Outcome outcome = it.run().process().finish();
  CHECK(outcome.code == 0);
  CHECK(outcome.out == alone.out);
}

TEST_CASE("a run on the wall clock stands while it is paused, and misses no deadline") {
  Controlled it(kPull, {"--rate", "50", "--set", "pause=0.1"});
  it.order({{"do", "step"}, {"ticks", 2}});
  it.wait_for_tick(1);
  CHECK(it.order({{"do", "speed"}, {"factor", 2}}).status == 400);
  it.order({{"do", "resume"}});
  it.events().finish();
  const Outcome outcome = it.run().process().finish();
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "success after "));
}

TEST_CASE("a flag of a tree is set by a text or by a value of JSON, and does what it says") {
  const std::string tree = R"(<root BTCPP_format="4"><BehaviorTree ID="T"><Sequence>
<Script code="go := true"/><KeepRunningUntilFailure><Sleep msec="10" _failureIf="!go"/></KeepRunningUntilFailure>
</Sequence></BehaviorTree></root>)";
  for (const json& no : {json("false"), json("0"), json("False"), json(false), json(0)}) {
    INFO(no.dump());
    Controlled it(tree, {"--clock", "virtual", "--max-ticks", "100000"});
    it.order({{"do", "step"}, {"ticks", 3}});
    it.wait_for_tick(2);
    CHECK(it.order({{"do", "set"}, {"entry", "go"}, {"value", "true"}}).status == 204);
    it.order({{"do", "step"}, {"ticks", 3}});
    it.wait_for_tick(5);
    CHECK(it.order({{"do", "set"}, {"entry", "go"}, {"value", no}}).status == 204);
    it.order({{"do", "resume"}});
    CHECK(contains(it.events().finish(), "\"end\""));
    CHECK(contains(it.run().process().finish().out, "failure after"));
  }
}

TEST_CASE(
    "a value that a run takes and puts back is in its recording, and in the scenario of that") {
  const TemporaryDirectory directory;
  const std::string run = directory.path("run.jsonl"), file = directory.path("t.test.xml");
  {
    Controlled it(directory,
                  tree_text("<Sequence memory='true'><Check code='w == 0.2'/><Script code='go := "
                            "false'/><WaitUntil code='go'/><Script code='go = false'/></Sequence>"),
                  {"--clock", "virtual", "--set", "w=1.5", "--record", run});
    CHECK(it.order({{"do", "set"}, {"entry", "w"}, {"value", "0.2"}}).status == 204);
    it.order({{"do", "step"}, {"ticks", 3}});
    it.wait_for_tick(2);
    CHECK(it.order({{"do", "set"}, {"entry", "go"}, {"value", "true"}}).status == 204);
    it.order({{"do", "resume"}});
    it.events().finish();
    CHECK(it.run().process().finish().code == 0);
  }
  CHECK(contains(read_file(run), R"("set":[1],"given":[[1,"true"]]})"));
  const std::string events = run_lockstep({"log", "events", run}).out;
  INFO(events);
  const auto given = events.find("entry    go: true");
  REQUIRE(given != events.npos);
  CHECK(events.find("Script#2", given) < events.find("entry    go: false", given));
  CHECK(run_lockstep({"log", "scenario", run, "--save", file}).code == 0);
  const std::string text = read_file(file);
  INFO(text);
  CHECK(contains(text, R"(<set key="w" value="0.2" tick="0"/>)"));
  CHECK(!contains(text, R"(key="w" value="1.5")"));
  CHECK(contains(text, R"(<set key="go" value="true" tick="3"/>)"));
  CHECK(run_lockstep({"test", file}).code == 0);
}

TEST_CASE(
    "a value before the first tick is said where it may give a type, and no tick is no scenario") {
  const TemporaryDirectory directory;
  const std::string run = directory.path("run.jsonl");
  const auto recorded = [&](const char* order) {
    Controlled it(directory,
                  R"(<root BTCPP_format="4"><BehaviorTree ID="T"><Script code="k := 0.2"/>
</BehaviorTree></root>)",
                  {"--clock", "virtual", "--set", "k=0.1", "--record", run});
    CHECK(it.order({{"do", "set"}, {"entry", "k"}, {"value", "7"}}).status == 204);
    it.order({{"do", order}});
    it.events().finish();
    it.run().process().finish();
    return run_lockstep({"log", "scenario", run});
  };
  CHECK(contains(recorded("resume").err,
                 "'k' was set before the first tick: the scenario begins with that value"));
  const Outcome none = recorded("halt");
  CHECK(none.code == 3);
  CHECK(contains(none.err, "has no tick: a scenario needs one"));
}

TEST_CASE("a breakpoint that is neither on nor off is refused") {
  Controlled it(kPull, {"--clock", "virtual", "--set", "pause=0.05"});
  const Response wrong =
      it.order({{"do", "break"}, {"node", 0}, {"when", "begins"}, {"on", "false"}});
  CHECK(wrong.status == 400);
  CHECK(contains(wrong.body, "'on' is not true or false"));
  it.order({{"do", "halt"}});
  it.events().finish();
}

TEST_CASE("a run pauses at its breakpoints") {
  Controlled it(kPull, {"--clock", "virtual", "--set", "pause=0.05"});
  const auto stop = [](int node, const char* when, bool on = true) {
    return json{{"do", "break"}, {"node", node}, {"when", when}, {"on", on}};
  };
  CHECK(it.order(stop(2, "begins")).status == 204);
  CHECK(it.order(stop(2, "barrier")).status == 204);
  CHECK(it.order(stop(4, "completes")).status == 204);
  it.order({{"do", "resume"}});
  REQUIRE(it.events().wait_for(R"("reached":{"node":2,"when":"begins"})"));
  it.order({{"do", "resume"}});
  REQUIRE(it.events().wait_for(R"("reached":{"node":2,"when":"barrier"})"));
  CHECK(contains(it.events().so_far(), R"([4,"running",0.5,0,1])"));  // base is held
  CHECK(it.order(stop(2, "barrier", false)).status == 204);
  it.order({{"do", "resume"}});
  REQUIRE(it.events().wait_for(R"("reached":{"node":4,"when":"completes"})"));
  CHECK(it.order({{"do", "halt"}}).status == 204);
  it.events().finish();
  const Outcome outcome = it.run().process().finish();
  CHECK(outcome.code == 130);
}

TEST_CASE("an entry is set between ticks, if its type takes the value") {
  Controlled it(kPull, {"--clock", "virtual", "--set", "pause=1000", "--max-ticks", "500"});
  CHECK(it.order({{"do", "set"}, {"entry", "pause"}, {"value", "0.03"}}).status == 204);
  const Response wrong = it.order({{"do", "set"}, {"entry", "pause"}, {"value", "soon"}});
  CHECK(wrong.status == 400);
  CHECK(parse_json(wrong.body)["error"] == "'soon' is not a number, which 'pause' holds");
  const Response unknown = it.order({{"do", "set"}, {"entry", "pauze"}, {"value", "1"}});
  CHECK(parse_json(unknown.body)["error"] == "the tree has no entry 'pauze'");
  it.order({{"do", "resume"}});
  it.events().finish();
  CHECK(it.run().process().finish().code == 0);
}

TEST_CASE("an answer and a value that a paused run was given outlast a cut") {
  for (const char* clock : {"virtual", "wall"}) {
    CAPTURE(clock);
    const TemporaryDirectory directory;
    const std::string tree = tree_text(
        "<Sequence memory='true'><Script code='n := 1'/><Ask name='sure' text='Sure?' "
        "answer='{a}'/><Check code=\"n == 2 &amp;&amp; a == 'no'\"/></Sequence>");
    const std::vector<std::string> options{"--clock",
                                           clock,
                                           "--checkpoint",
                                           directory.path("kept"),
                                           "--resume",
                                           "--record",
                                           directory.path("run.jsonl")};
    {
      Controlled it(directory, tree, options);
      it.order({{"do", "step"}, {"ticks", 5}});
      it.wait_for_tick(4);
      CHECK(it.order({{"do", "answer"}, {"answer", "no"}, {"by", "maria"}}).status == 204);
      CHECK(it.order({{"do", "set"}, {"entry", "n"}, {"value", 2}}).status == 204);
      it.run().process().end_by(SIGKILL);
    }
    Controlled it(directory, tree, options);
    it.order({{"do", "step"}, {"ticks", 3}});
    it.events().finish();
    const Outcome outcome = it.run().process().finish();
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err, "resumed after"));
    const Outcome events = run_lockstep({"log", "events", directory.path("run.resumed-1.jsonl"),
                                         "--event", "ask", "--event", "answer"});
    REQUIRE(lines(events.out).size() == 1);  // it is not asked again
    CHECK(contains(events.out, "no (by page: maria)"));
    CHECK(contains(events.out, "tick 5 "));
    // It came from outside, as without the cut.
    const std::string resumed = read_file(directory.path("run.resumed-1.jsonl"));
    const std::string first = lines(resumed)[1];
    INFO(first);
    CHECK(contains(first, R"("entries":[[0,"2"],)"));
    CHECK(contains(first, R"("set":[0])"));
    CHECK(!contains(lines(resumed)[2], "\"set\""));
    const Outcome scenario = run_lockstep({"log", "scenario", directory.path("run.jsonl")});
    INFO(scenario.out << scenario.err);
    CHECK(contains(scenario.out, R"(<set key="n" value="2" tick="5"/>)"));
  }
}

TEST_CASE("an order that can have no effect is refused, and an answer that comes too late") {
  Controlled it(tree_text("<Sequence memory='true'><Wait seconds='0.02'/><Ask name='sure' "
                          "text='Sure?'/><Wait seconds='1000'/></Sequence>"),
                {"--clock", "virtual"});
  const auto refused = [&](const json& order) {
    const Response response = it.order(order);
    CHECK(response.status == 409);
    return parse_json(response.body)["error"].get<std::string>();
  };
  const json yes{{"do", "answer"}, {"answer", "yes"}};
  const std::string none = "'Main/Sequence/sure' waits for no such answer";
  it.order({{"do", "step"}});
  it.wait_for_tick(0);
  CHECK(refused(yes) == none);  // it does not ask yet
  it.order({{"do", "step"}, {"ticks", 4}});
  it.wait_for_tick(4);
  json unseen = yes;
  unseen["seen"] = 0;
  CHECK(refused(unseen) == none);
  CHECK(it.order(yes).status == 204);
  CHECK(refused(yes) == none);  // it has one
  it.order({{"do", "step"}});
  it.wait_for_tick(5);
  CHECK(refused(yes) == none);
  CHECK(refused({{"do", "attend"}}) == "the run was not started with --attended");
  it.order({{"do", "halt"}});
  it.events().finish();
  CHECK(contains(it.run().process().finish().err,
                 "the answer 'yes' (by page) has no effect: Main/Sequence/sure waits for none"));
}

TEST_CASE("an answer that a paused run has not taken when it ends is reported") {
  for (const char* how : {"halt", "resume"}) {
    Controlled it(tree_text("<Sequence memory='true'><Ask name='sure' text='Sure?'/>"
                            "</Sequence>"),
                  {"--clock", "virtual"});
    it.order({{"do", "step"}});
    it.wait_for_tick(0);
    CHECK(it.order({{"do", "answer"}, {"answer", "yes"}}).status == 204);
    it.order({{"do", how}});
    it.events().finish();
    CHECK(contains(it.run().process().finish().err,
                   "the answer 'yes' (by page) has no effect: Main/Sequence/sure had not taken it "
                   "when the run ended") == (how == std::string("halt")));
  }
}

TEST_CASE("a paused run ends at a signal within a second") {
  for (const int number : {SIGTERM, SIGINT}) {
    for (const char* clock : {"wall", "virtual"}) {
      Controlled it(kPull, {"--clock", clock, "--set", "pause=1000"});
      it.order({{"do", "step"}});
      it.wait_for_tick(0);
      timespec begin{}, end{};
      clock_gettime(CLOCK_MONOTONIC, &begin);
      it.run().process().signal(number);
      CHECK(it.run().process().finish().code == 128 + number);
      clock_gettime(CLOCK_MONOTONIC, &end);
      CHECK(end.tv_sec - begin.tv_sec <= 1);
      CHECK(contains(it.events().finish(), "\"reason\":\"signal\""));
    }
  }
}

TEST_CASE("a paused run ends at its timeout on the wall clock") {
  Controlled it(kPull, {"--timeout", "0.3", "--set", "pause=1000"});
  it.events().finish();
  CHECK(it.run().process().finish().code == 124);
}

TEST_CASE("what is no order is refused with a sentence") {
  Controlled it(kPull, {"--set", "pause=1"});
  const auto error = [&](const std::string& body) {
    const Response response = post(it.run().port(), "/control", body, it.token());
    CHECK(response.status == 400);
    CHECK(contains(response.head, "Content-Type: application/json\r\n"));
    return parse_json(response.body)["error"].get<std::string>();
  };
  CHECK(error("") == "not JSON");
  CHECK(error("{") == "not JSON");
  CHECK(error("[]") == "expected a JSON object");
  CHECK(error("{}") == "'do' is missing");
  CHECK(error(R"({"do":"fly"})") == "'fly' is not an order");
  CHECK(error(R"({"do":"step","tick":5})") == "unknown key 'tick'");
  CHECK(error(R"({"do":"step","ticks":0})") == "'ticks' is 0, expected 1 to 1000000000");
  CHECK(error(R"({"do":"speed"})") == "the wall clock has one speed; --clock virtual has others");
  CHECK(error(R"({"do":"set","value":1})") == "'entry' is missing");
  CHECK(error(R"({"do":"set","entry":"pause"})") == "'value' is missing");
  CHECK(error(R"({"do":"break","when":"begins"})") == "'node' is missing");
  CHECK(error(R"({"do":"break","node":0})") == "'when' is missing");
  CHECK(error(R"({"do":"answer","node":0})") == "'answer' is missing");
  CHECK(error(R"({"do":"answer","answer":"yes"})") == "'node' is missing");
  CHECK(error(R"({"do":"break","node":99,"when":"begins"})") == "no node 99, expected 0 to 4");
  CHECK(error(R"({"do":"break","node":0,"when":"barrier"})") ==
        "'Main/all' has no barriers and no delta");
  CHECK(error(R"({"do":"break","node":0,"when":"ever"})") ==
        "'when' is none of 'begins', 'completes', 'barrier', 'succeeds' and 'fails'");
  CHECK(get(it.run().port(), "/control", it.token()).status == 405);
}

TEST_CASE("options for control need what they control") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", kPull);
  const Outcome alone = run_lockstep({"run", tree, "--monitor-control"});
  CHECK(alone.code == 2);
  CHECK(contains(alone.err, "--monitor-control needs --monitor"));
  const Outcome paused = run_lockstep({"run", tree, "--monitor", "--monitor-paused"});
  CHECK(paused.code == 2);
  CHECK(contains(paused.err, "--monitor-paused needs --monitor-control"));
}

TEST_CASE("the history has the run so far, from its recording if there is one") {
  const TemporaryDirectory directory;
  for (const bool records : {false, true}) {
    CAPTURE(records);
    std::vector<std::string> options{"--clock", "virtual", "--set", "pause=3"};
    if (records) options.insert(options.end(), {"--record", directory.path("run.jsonl")});
    Controlled it(kPull, options);
    it.order({{"do", "step"}, {"ticks", 200}});
    it.wait_for_tick(199);
    it.order({{"do", "step"}});
    it.wait_for_tick(200);
    const Response response = get(it.run().port(), "/history", it.token());
    CHECK(response.status == 200);
    // It comes in pieces of which each tells its length.
    CHECK(contains(response.body, "{\"lockstep_recording\":1,"));
    CHECK(contains(response.body, "{\"tick\":0,"));
    CHECK(contains(response.body, "{\"tick\":200,"));
    // Without a recording, what happened between two lines is not there.
    for (int tick = 1; tick < 200 && records; ++tick) {
      CHECK(contains(response.body, "{\"tick\":" + std::to_string(tick) + ","));
    }
    Client after(it.run().port());
    after.send(get_text(it.run().port(), "/events?after=200", it.token()));
    it.order({{"do", "step"}});
    REQUIRE(after.wait_for("{\"tick\":201,"));
    CHECK_FALSE(contains(after.so_far(), "{\"tick\":200,"));
    CHECK_FALSE(contains(after.so_far(), "lockstep_recording"));
  }
}

TEST_CASE("the history is lines, also where the recording is none") {
  const TemporaryDirectory directory;
  for (const char* const name : {"run.jsonl.zst", "run.mcap"}) {
    CAPTURE(name);
    Controlled it(kPull,
                  {"--clock", "virtual", "--set", "pause=3", "--record", directory.path(name)});
    it.order({{"do", "step"}, {"ticks", 200}});
    it.wait_for_tick(199);
    const Response response = get(it.run().port(), "/history", it.token());
    CHECK(contains(response.body, "{\"lockstep_recording\":1,"));
    CHECK(contains(response.body, "{\"tick\":199,"));
    CHECK(response.body.find('\0') == std::string::npos);
  }
}

TEST_CASE("a long history comes at once") {
  const TemporaryDirectory directory;
  const std::string recording = directory.path("run.jsonl");
  Controlled it(kPull, {"--clock", "virtual", "--set", "pause=1000", "--record", recording});
  it.order({{"do", "step"}, {"ticks", 50'000}});
  it.wait_for_tick(49'999);
  it.order({{"do", "step"}});
  it.wait_for_tick(50'000);
  timespec begin{}, end{};
  clock_gettime(CLOCK_MONOTONIC, &begin);
  const Response response = get(it.run().port(), "/history", it.token());
  clock_gettime(CLOCK_MONOTONIC, &end);
  CHECK(response.body.size() > 2'000'000);
  CHECK(contains(response.body, "{\"tick\":50000,"));
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr int kAtOnce = 30;  // seconds
#else
  constexpr int kAtOnce = 2;
#endif
  CHECK(end.tv_sec - begin.tv_sec <= kAtOnce);
}
