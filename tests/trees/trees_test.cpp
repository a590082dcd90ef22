// Trees with what is expected of them inside, as comments:
//
//   <!-- expect error 4:7: unknown node 'Sequnce' -->   also warning, note; file:4:7 in an include
//   <!-- expect success in 10 ticks -->                 or failure; on the virtual clock
//   <!-- with set speed=0.5 -->                         or arg: more options of the run
//
// Those in btcpp/ are in the language of BehaviorTree.CPP.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;
using nlohmann::json;

namespace {

namespace fs = std::filesystem;

const std::string kTrees = LOCKSTEP_SOURCE_DIR "/tests/trees/";

std::vector<std::string> files_in(const std::string& directory) {
  std::vector<std::string> files;
  if (!fs::exists(directory)) return files;
  for (const auto& entry : fs::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".test.xml") || name.ends_with(".leaves.xml")) continue;
    if (entry.path().extension() == ".xml") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void append(std::vector<std::string>& files, const std::vector<std::string>& more) {
  REQUIRE(more.size() >= 4);
  files.insert(files.end(), more.begin(), more.end());
}

// What stands in the comments that begin with `word`.
std::vector<std::string> comments(const std::string& file, const std::string& word) {
  std::vector<std::string> found;
  for (const std::string& line : lines(read_file(file))) {
    const std::string open = "<!-- " + word + " ", close = " -->";
    if (line.rfind(open, 0) != 0) continue;
    found.push_back(line.substr(open.size(), line.size() - open.size() - close.size()));
  }
  return found;
}

// Messages name files as they were given; the comments name them from where they stand.
std::string without_directory(std::string message, const std::string& directory) {
  for (auto at = message.find(directory); at != std::string::npos; at = message.find(directory)) {
    message.erase(at, directory.size());
  }
  return message;
}

// All that check says, as the comments say it.
std::vector<std::string> told(const std::string& file, int& code) {
  const Outcome outcome = run_lockstep({"check", "--format", "json", file});
  code = outcome.code;
  CHECK(outcome.err.empty());
  std::vector<std::string> messages;
  for (const json& it : parse_json(outcome.out)) {
    const std::string in = it["file"];
    messages.push_back(without_directory(
        it["severity"].get<std::string>() + " " + (in == file ? "" : in + ":") +
            std::to_string(it["line"].get<int>()) + ":" + std::to_string(it["column"].get<int>()) +
            ": " + it["message"].get<std::string>(),
        file.substr(0, file.rfind('/') + 1)));
  }
  return messages;
}

// "success in 10 ticks"
std::string result_of(const std::string& file) {
  std::vector<std::string> arguments{"run", file, "--clock", "virtual", "--view", "none", "--json"};
  arguments.insert(arguments.end(), {"--max-ticks", "100000"});
  for (const std::string& option : comments(file, "with")) {
    arguments.push_back("--" + option.substr(0, option.find(' ')));
    arguments.push_back(option.substr(option.find(' ') + 1));
  }
  const Outcome outcome = run_lockstep(arguments);
  INFO(outcome.err);
  REQUIRE(!outcome.out.empty());
  const json summary = parse_json(outcome.out);
  const std::string result = summary["result"];
  CHECK(outcome.code == (result == "success" ? 0 : 1));
  const int ticks = summary["ticks"];
  return result + " in " + std::to_string(ticks) + (ticks == 1 ? " tick" : " ticks");
}

}  // namespace

TEST_CASE("bad trees: each mistake and doubt is reported, at its place, and nothing else") {
  auto files = files_in(kTrees + "bad");
  REQUIRE(files.size() >= 30);
  append(files, files_in(kTrees + "btcpp/bad"));
  for (const std::string& file : files) {
    INFO(file);
    const auto expected = comments(file, "expect");
    int code = -1;
    const auto messages = told(file, code);
    REQUIRE(!expected.empty());
    CHECK(messages == expected);
    const bool has_errors = std::any_of(expected.begin(), expected.end(), [](const auto& message) {
      return message.rfind("error", 0) == 0;
    });
    CHECK(code == (has_errors ? 3 : 0));
  }
}

TEST_CASE("a tree with errors does not run") {
  auto files = files_in(kTrees + "bad");
  append(files, files_in(kTrees + "btcpp/bad"));
  for (const std::string& file : files) {
    if (comments(file, "expect").front().rfind("error", 0) != 0) continue;
    INFO(file);
    const Outcome outcome = run_lockstep({"run", file, "--clock", "virtual"});
    CHECK(outcome.code == 3);
    CHECK(outcome.out.empty());
    CHECK(contains(outcome.err, "error: "));
  }
}

TEST_CASE("good trees run to the result and in the ticks that they expect") {
  auto files = files_in(kTrees + "good");
  REQUIRE(files.size() >= 10);
  append(files, files_in(kTrees + "btcpp/good"));
  for (const std::string& file : files) {
    INFO(file);
    CHECK(std::vector<std::string>{result_of(file)} == comments(file, "expect"));
  }
}

TEST_CASE("the trees that ship are checked without a warning and run to the result they expect") {
  auto files = files_in(LOCKSTEP_SOURCE_DIR "/trees");
  REQUIRE(files.size() >= 6);
  for (const char* folder : {"paper", "sequel", "road"}) {
    const auto more = files_in(LOCKSTEP_SOURCE_DIR "/trees/" + std::string(folder));
    CHECK(!more.empty());
    files.insert(files.end(), more.begin(), more.end());
  }
  for (const std::string& file : files) {
    INFO(file);
    int code = -1;
    for (const std::string& message : told(file, code)) {
      CHECK(message.rfind("note ", 0) == 0);
    }
    CHECK(code == 0);
    const auto expected = comments(file, "expect");
    REQUIRE(expected.size() == 1);
    CHECK(result_of(file).rfind(expected[0], 0) == 0);
  }
}

TEST_CASE("the door of the demo jams without barriers, and only then") {
  const auto open_door = [](const std::string& barriers) {
    return run_lockstep({"run", LOCKSTEP_SOURCE_DIR "/trees/door_pulling.xml", "--clock", "virtual",
                         "--arg", "barriers=" + barriers});
  };
  for (const char* barriers : {"0.25;0.5;0.75", "0.5"}) CHECK(open_door(barriers).code == 0);
  const Outcome jammed = open_door("");
  CHECK(jammed.code == 1);
  CHECK(contains(jammed.err, "OpenDoor/open/pull/arm: warning: the door jams: the hand has moved"));
}

TEST_CASE("./dev demo builds the plugins of its tree") {
  const std::string dev = read_file(LOCKSTEP_SOURCE_DIR "/dev");
  const auto demo = dev.substr(dev.find("\n  demo)"));
  const std::string build = demo.substr(0, demo.find(";;"));
  REQUIRE(contains(build, "run trees/door_pulling.xml"));
  const std::string tree = read_file(LOCKSTEP_SOURCE_DIR "/trees/door_pulling.xml");
  const std::string open = "<plugin name=\"";
  for (auto at = tree.find(open); at != std::string::npos; at = tree.find(open, at)) {
    at += open.size();
    CHECK(contains(build.substr(0, build.find("exec")),
                   " " + tree.substr(at, tree.find('"', at) - at)));
  }
}
