// What of a run is in the file that it leaves, and who may read it.
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

namespace lockstep::host::test {

TEST_CASE("a recording has the permissions that the umask leaves") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><AlwaysSuccess/></BehaviorTree></root>");
  for (const auto& [umask, mode] : {std::pair("077", mode_t{0600}), {"027", 0640}, {"000", 0666}}) {
    const std::string file = directory.path(umask);
    const Outcome outcome =
        run({.arguments = {"-c", "umask $0 && exec \"$@\"", umask, LOCKSTEP_BINARY_DIR "/lockstep",
                           "run", tree, "--clock", "virtual", "--record", file},
             .program = "/bin/sh"});
    CHECK(outcome.code == 0);
    struct stat status {};
    REQUIRE(stat(file.c_str(), &status) == 0);
    CHECK((status.st_mode & 0777) == mode);
  }
}

TEST_CASE("a recording that a run still writes is not replaced by that of another run") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text("<AlwaysRunning/>"));
  const std::string name = directory.path(GENERATE("run.jsonl", "run.jsonl.zst", "run.mcap"));
  const auto record = [&] {
    return run_lockstep({"run", tree, "--clock", "virtual", "--max-ticks", "5", "--view", "none",
                         "--record", name});
  };
  Process first({.arguments = {"run", tree, "--view", "none", "--record", name}});
  while (!std::filesystem::exists(name)) usleep(1000);
  const Outcome second = record();
  CHECK(second.code == 2);
  CHECK(contains(second.err, "another run records to it"));
  CHECK(first.end_by(SIGTERM).code == 128 + SIGTERM);
  if (!name.ends_with(".mcap")) CHECK(run_lockstep({"log", "info", name}).code == 0);
  CHECK(record().code == 124);
}

TEST_CASE("a recording holds arguments, and values of the blackboard unless they are kept out") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      "<root lockstep=\"1\"><plugin name=\"motion\"/><arg name=\"told\" default=\"x\"/>"
      "<BehaviorTree ID=\"Main\"><Advance step=\"{step}\"/></BehaviorTree></root>");
  const std::string file = directory.path("run.jsonl");
  for (const std::string entries : {"all", "none"}) {
    const Outcome outcome = run_lockstep({"run", tree, "--arg", "told=argument", "--set",
                                          "step=0.7317", "--clock", "virtual", "--max-ticks", "1",
                                          "--record", file, "--record-entries", entries});
    INFO(outcome.err);
    CHECK(outcome.code == 124);
    CHECK(contains(read_file(file), "\"told\":\"argument\""));
    CHECK(contains(read_file(file), "7317") == (entries == "all"));
  }
}

TEST_CASE("a recording has the entries that changed and what leaves logged, of each tick") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      "<root lockstep=\"1\"><plugin name=\"motion\"/><plugin name=\"fetch\"/>"
      "<BehaviorTree ID=\"Main\"><Sequence memory=\"true\"><Say text=\"a &quot;word&quot;\"/>"
      "<Parallel><Replan first=\"0.5\" second=\"0.4;0.8\" after=\"0.2\" barriers=\"{plan}\"/>"
      "<Advance step=\"{s}\"/></Parallel></Sequence></BehaviorTree></root>");
  const std::string file = directory.path("run.jsonl");
  // The text after `key` of each line that has it, by its tick.
  const auto recorded = [&](const std::string& key, std::vector<std::string> more) {
    more.insert(more.begin(), {"run", tree, "--clock", "virtual", "--rate", "10", "--set", "s=0.1",
                               "--record", file});
    CHECK(run_lockstep(more).code == 0);
    std::vector<std::string> found;
    for (const std::string& line : lines(read_file(file))) {
      const auto json = parse_json(line);
      if (json.contains("tick") && json.contains(key)) {
        found.push_back(json["tick"].dump() + json[key].dump());
      }
    }
    return found;
  };
  const std::vector<std::string> all = recorded("entries", {});
  REQUIRE(all.size() == 3);
  CHECK(all[0] == R"(0[[1,"0.1"]])");
  CHECK(contains(all[1], R"([[0,"0.5"]])"));
  CHECK(contains(all[2], R"([[0,"0.4;0.8"]])"));
  const auto header = parse_json(lines(read_file(file))[0]);
  CHECK(header["entries"] == parse_json(R"([
      {"key":"plan","type":"list of double","strict":true,"writers":[3]},
      {"key":"s","type":"double","strict":true}])"));
  CHECK(recorded("logs", {"--log-level", "none"}) ==
        std::vector<std::string>{R"(0[["Main/Sequence/Say","info","says: a \"word\""]])"});
  const Outcome replay = run_lockstep({"replay", file, "--print", "--at", "0"});
  CHECK(contains(replay.out, "\ns = 0.1\nMain/Sequence/Say: info: says: a \"word\"\n"));
  CHECK(recorded("entries", {"--record-entries", "s"}) ==
        std::vector<std::string>{R"(0[[0,"0.1"]])"});
  CHECK(recorded("entries", {"--record-entries", "none"}).empty());
  const Outcome typo = run_lockstep({"run", tree, "--record", file, "--record-entries", "plam"});
  CHECK(typo.code == 2);
  CHECK(contains(typo.err, "the tree has no entry 'plam'\n  hint: did you mean 'plan'?"));
}

TEST_CASE("a recording says which nodes may write an entry: by a port or a script") {
  const TemporaryDirectory directory;
  const auto writers = [&](const std::string& text) {
    const std::string tree = directory.file("tree.xml", text);
    const std::string file = directory.path("run.jsonl");
    const Outcome outcome = run_lockstep({"run", tree, "--clock", "virtual", "--view", "none",
                                          "--max-ticks", "9", "--record", file});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    std::map<std::string, std::vector<int>> found;
    const auto header = parse_json(lines(read_file(file))[0]);
    for (const auto& entry : header["entries"]) {
      found[entry["key"]] = entry.value("writers", std::vector<int>());
    }
    return found;
  };
  using Writers = std::map<std::string, std::vector<int>>;
  CHECK(
      writers("<root lockstep=\"1\" main_tree_to_execute=\"Main\"><plugin name=\"motion\"/>"
              "<BehaviorTree ID=\"Main\"><Sequence memory=\"true\">"
              "<Script code=\"a := 1; b := 2\" on_success=\"b += a\"/><Check code=\"b == 3\"/>"
              "<Advance step=\"1\" on_end=\"a := 2\"/><SubTree ID=\"Sub\" x=\"{b}\" y=\"5\"/>"
              "</Sequence></BehaviorTree><BehaviorTree ID=\"Sub\"><Sequence memory=\"true\">"
              "<Script code=\"x := 7\"/><Script code=\"y == 5\" on_success=\"x := 8\"/></Sequence>"
              "</BehaviorTree></root>") == Writers{{"a", {1, 3}}, {"b", {1, 6, 7}}, {"Sub/y", {}}});
  const Writers other = writers(
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><Sequence><Script code=\"a := 1\"/>"
      "<AlwaysSuccess _onSuccess=\"a := 2\"/></Sequence></BehaviorTree></root>");
  CHECK(other == Writers{{"a", {1, 2}}});
}

}  // namespace lockstep::host::test
