// `lockstep replay --monitor`: a recording in a browser.
#include <catch2/catch.hpp>

#include "web/client.h"

using namespace lockstep::host::test;

TEST_CASE("a recording is shown in a browser, until somebody ends it") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("tree.xml", tree_text("<Advance name=\"arm\" step=\"0.5\"/>"));
  const std::string recording = directory.path("run.jsonl");
  REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--record", recording}).code == 0);
  const std::string page = directory.path("run.html");
  REQUIRE(run_lockstep({"log", "page", recording, "--out", page}).code == 0);
  Process process({.arguments = {"replay", recording, "--monitor"}});
  const std::string& said = process.so_far().err;
  while (said.find('\n') == std::string::npos) REQUIRE(process.read_on());
  const auto port = static_cast<unsigned>(std::stoi(said.substr(said.rfind(':') + 1)));
  CHECK(get(port, "/").body == read_file(page));
  CHECK(get(port, "/run.jsonl").status == 404);
  CHECK(get(port, "/", "Origin: http://evil.example\r\n").status == 403);
  process.signal(SIGINT);
  CHECK(process.finish().code == 130);
  const Outcome open = run_lockstep({"replay", recording, "--monitor", "0.0.0.0:0"});
  CHECK(open.code == 2);
  CHECK(contains(open.err, "can be reached from other machines"));
  CHECK(run_lockstep({"replay", tree, "--monitor"}).code == 3);
}
