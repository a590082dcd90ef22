// The monitor of a run from outside, with plain sockets.
#include <catch2/catch.hpp>

#include "support/json.h"
#include "web/client.h"

using namespace lockstep::host::test;
using nlohmann::json;

namespace {

const std::string kEndless = tree_text(
    "<ParallelAbsolute name=\"pull\" barriers=\"0.5\"><Advance name=\"arm\" step=\"0\"/>"
    "<Advance name=\"base\" step=\"0.25\"/></ParallelAbsolute>");

struct EndlessRun : MonitoredRun {
  explicit EndlessRun(std::vector<std::string> more = {})
      : EndlessRun(TemporaryDirectory(), std::move(more)) {}

 private:
  EndlessRun(const TemporaryDirectory& directory, std::vector<std::string> more)
      : MonitoredRun(with(directory.file("tree.xml", kEndless), std::move(more))) {}
  static std::vector<std::string> with(const std::string& tree, std::vector<std::string> more) {
    more.insert(more.begin(), tree);
    return more;
  }
};

// The data of events that are lines of a recording.
std::vector<json> lines_of(const std::string& events) {
  std::vector<json> all;
  for (const std::string& line : lines(events)) {
    if (line.starts_with("data: {")) all.push_back(parse_json(line.substr(6)));
  }
  return all;
}

}  // namespace

TEST_CASE("the monitor has a page, and the lines of a recording while the run goes on") {
  EndlessRun run;
  const Response page = get(run.port(), "/");
  CHECK(page.status == 200);
  CHECK(contains(page.head, "Content-Type: text/html; charset=utf-8\r\n"));
  CHECK(contains(page.body, "<title>"));
  Client client(run.port());
  client.send(get_text(run.port(), "/events"));
  REQUIRE(client.wait_for("\nid: 1"));
  run.process().signal(SIGTERM);
  const auto seen = lines_of(client.finish());
  CHECK(contains(client.so_far(), "Content-Type: text/event-stream\r\n"));
  REQUIRE(seen.size() > 3);
  CHECK(seen[0]["lockstep_recording"] == 1);
  CHECK(seen[0]["nodes"][1]["path"] == "Main/pull/arm");
  CHECK(seen[1]["full"] == true);
  CHECK(seen[seen.size() - 2]["end"]["reason"] == "signal");
  CHECK(contains(client.so_far(), "event: end\ndata: {}\n\n"));
  CHECK(run.process().finish().code == 143);
}

TEST_CASE("what the monitor does not have is said") {
  EndlessRun run;
  CHECK(get(run.port(), "/nothing").status == 404);
  CHECK(get(run.port(), "/../etc/passwd").status == 404);
  CHECK(post(run.port(), "/", "{}").status == 405);
}

TEST_CASE("the address of the monitor is checked before the run begins") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", kEndless);
  const Outcome wrong = run_lockstep({"run", tree, "--monitor=somewhere"});
  CHECK(wrong.code == 2);
  CHECK(contains(wrong.err, "--monitor: 'somewhere' is not an address"));
  const Outcome large =
      run_lockstep({"run", tree, "--max-ticks", "1", "--monitor", "127.0.0.1:99999"});
  CHECK(large.code == 2);
  CHECK(contains(large.err, "hint: the largest port is 65535"));
  const Outcome foreign = run_lockstep({"run", tree, "--monitor", "192.0.2.1:0"});
  CHECK(foreign.code == 2);
  CHECK(contains(foreign.err, "cannot listen on '192.0.2.1:0'"));
  EndlessRun run;
  const Outcome taken = run_lockstep({"run", tree, "--monitor", std::to_string(run.port())});
  CHECK(taken.code == 2);
  CHECK(contains(taken.err, "Address already in use"));
}

TEST_CASE("the value of --monitor may be left out, whatever follows") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("tree.xml", tree_text("<Advance name=\"arm\" step=\"0.5\"/>"));
  for (const std::vector<std::string>& words : {std::vector<std::string>{"run", "--monitor", tree},
                                                {"run", "--monitor", "127.0.0.1:0", tree},
                                                {"run", "--monitor=:0", tree},
                                                {"run", tree, "--monitor", "0"},
                                                {"run", tree, "--monitor"}}) {
    const Outcome outcome = run_lockstep(words);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err, "monitor: http://127.0.0.1:"));
  }
}
