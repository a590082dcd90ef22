// What docs say is not there: as they say it, and told to whoever uses it. A claim that is not here
// is tested elsewhere: it is one of those that "kTestedElsewhere" names, with its test.
#include <catch2/catch.hpp>
#include <filesystem>
#include <regex>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

std::string page(const std::string& name) {
  return read_file(LOCKSTEP_SOURCE_DIR "/docs/" + name);
}

std::string native(const std::string& node) {
  return "<root lockstep=\"1\"><arg name=\"n\" default=\"1\"/><BehaviorTree ID=\"Main\">" + node +
         "</BehaviorTree></root>";
}

std::string foreign(const std::string& node) {
  return "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\">" + node + "</BehaviorTree></root>";
}

// Of a page: a claim, and what shows it.
struct Claim {
  std::string page, words;
  std::vector<std::string> command;  // with the tree, where one is given
  std::string tree, told;
};

const Claim kClaims[] = {
    {"btcpp.md",
     "The language has no `ManualSelector`",
     {"check", "--strict"},
     foreign("<ManualSelector><AlwaysSuccess/></ManualSelector>"),
     "unknown node 'ManualSelector'"},
    {"expressions.md",
     "there are no comments. The only functions",
     {"check"},
     native("<Script code=\"a := 1 // one\"/>"),
     "a value is missing before '/'"},
    {"expressions.md",
     "there are no comments. The only functions",
     {"check"},
     native("<Script code=\"a := sin(1)\"/>"),
     "nothing declares the entry 'sin'"},
    {"nodes-and-attributes.md",
     "There are no expressions",
     {"check"},
     native("<Wait seconds=\"${n+1}\"/>"),
     "unknown argument 'n+1'"},
    {"nodes-and-attributes.md",
     "there are no queues: let a leaf take the next item",
     {"convert"},
     foreign("<LoopInt queue=\"1;2\" value=\"{v}\"><AlwaysSuccess/></LoopInt>"),
     "this 'LoopInt' cannot be expressed in lockstep's language"},
    {"studies.md",
     "There is no `--shard`",
     {"study", "--runs", "9", "--until-ci", "5%", "--shard", "1/2"},
     native("<AlwaysSuccess/>"),
     "such a study has no parts"},
};

// Other sentences of this kind, and a name of the test that each has.
const std::pair<const char*, const char*> kTestedElsewhere[] = {
    {"btcpp.md: These are not there", "what docs/btcpp.md says is not there"},
    {"security.md: definitions in a DOCTYPE are not supported",
     "bytes that are no text, and entities, are refused where they stand"},
    {"btcpp.md: Not there |", "what docs/btcpp.md says is not there"},
};

}  // namespace

TEST_CASE("what docs say is not there is refused, in words") {
  const TemporaryDirectory directory;
  for (const Claim& claim : kClaims) {
    INFO(claim.page << ": " << claim.words);
    CHECK(contains(page(claim.page), claim.words));
    auto arguments = claim.command;
    arguments.push_back(directory.file("tree.xml", claim.tree));
    const Outcome outcome = run_lockstep(arguments);
    INFO(outcome.err);
    CHECK(outcome.code != 0);
    CHECK(contains(outcome.err, claim.told));
  }
}

TEST_CASE("what docs/btcpp.md says is not there is refused by the compiler, each with a test") {
  const std::string text = page("btcpp.md");
  const auto begin = text.find("| Not there | Instead |");
  REQUIRE(begin != std::string::npos);
  const std::string table = text.substr(begin, text.find("\n\n", begin) - begin);
  const std::string mistakes =
      read_file(LOCKSTEP_SOURCE_DIR "/tests/sdk_template/btcpp_mistakes.cpp");
  const std::regex name("`([A-Za-z0-9_]+)`");
  int count = 0;
  for (const std::string& row : lines(table)) {
    const std::string cell = row.substr(1, row.find('|', 1) - 1);
    for (std::sregex_iterator it(cell.begin(), cell.end(), name), end; it != end; ++it, ++count) {
      const std::string word = (*it)[1];
      INFO(word);
      CHECK((contains(mistakes, word + "(") || contains(mistakes, word + " ") ||
             contains(mistakes, word + ">")));
    }
  }
  CHECK(count > 0);
}

TEST_CASE("a sentence of docs that says something is not there has a test") {
  const std::regex absence(
      "(is|are) not (there|supported|available|implemented)\\b|Not there \\||unsupported|"
      "The language has no |[Tt]here (is|are) no (`--|expressions|comments|queues)");
  const std::regex skipped("as not there|as if .* not there");  // what a skipped node counts as
  std::vector<std::string> unknown;
  for (const auto& file : std::filesystem::directory_iterator(LOCKSTEP_SOURCE_DIR "/docs")) {
    const std::string name = file.path().filename().string();
    if (!name.ends_with(".md") || name == "paper.md") continue;  // that is of the paper
    for (const std::string& line : lines(read_file(file.path()))) {
      std::smatch found;
      if (!std::regex_search(line, found, absence)) continue;
      if (std::regex_search(line, skipped)) continue;
      const bool is_known =
          std::ranges::any_of(
              kClaims,
              [&](const Claim& it) { return it.page == name && contains(line, it.words); }) ||
          std::ranges::any_of(kTestedElsewhere, [&](const auto& it) {
            const std::string key = it.first;
            return key.starts_with(name + ": ") && contains(line, key.substr(name.size() + 2));
          });
      if (!is_known) unknown.push_back(name + ": " + line);
    }
  }
  for (const std::string& line : unknown) UNSCOPED_INFO(line);
  CHECK(unknown.empty());
}
