// The documentation names options that there are.
#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <regex>
#include <sstream>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

const std::filesystem::path kSource = LOCKSTEP_SOURCE_DIR;

std::vector<std::filesystem::path> pages() {
  std::vector<std::filesystem::path> found = {kSource / "README.md", kSource / "trees/README.md"};
  for (const auto& entry : std::filesystem::directory_iterator(kSource / "docs")) {
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  }
  return found;
}

std::string help_of(const std::string& command) {
  static std::map<std::string, std::string> known;
  std::string& text = known[command];
  if (!text.empty()) return text;
  std::vector<std::string> words = {"help"};
  std::istringstream in(command);
  for (std::string word; in >> word;) words.push_back(word);
  if (command == "run") words = {"run", "--help-all"};  // `help run` has the usual options only
  return text = run_lockstep(words).out;
}

// "run" and "--record" of each `lockstep run t.xml --record x`, in code or in a line of a script.
std::vector<std::pair<std::string, std::string>> options_in(const std::string& page) {
  const std::regex call(
      "lockstep ((?:new (?:project|plugin|leaf|node|tree)|run|check|test|show|nodes|schema|plugin "
      "check|replay|study merge|study|log "
      "[a-z]+)\\b)"
      "([^`\\n#|&;>]*)");
  const std::regex option("[ [](--[a-z][a-z0-9-]*)");
  std::vector<std::pair<std::string, std::string>> found;
  for (std::sregex_iterator it(page.begin(), page.end(), call), end; it != end; ++it) {
    const std::string words = (*it)[2];
    for (std::sregex_iterator at(words.begin(), words.end(), option); at != end; ++at) {
      found.emplace_back((*it)[1], (*at)[1]);
    }
  }
  return found;
}

}  // namespace

TEST_CASE("every option that the documentation gives to a command exists") {
  std::size_t count = 0;
  for (const std::filesystem::path& page : pages()) {
    for (const auto& [command, option] : options_in(read_file(page.string()))) {
      INFO(page.string() << ": lockstep " << command << " " << option);
      CHECK(std::regex_search(help_of(command), std::regex("[ ,]" + option + "[ \n]")));
      ++count;
    }
  }
  CHECK(count > 40);
}
