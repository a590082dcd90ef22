// The tables of docs/verify.md: what verify says of all example trees, and of what the language
// promises.
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>
#include <sstream>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

namespace fs = std::filesystem;
using Cells = std::vector<std::string>;

std::string trimmed(std::string text) {
  while (!text.empty() && text.back() == ' ') text.pop_back();
  text.erase(0, text.find_first_not_of(' '));
  const bool is_code = text.size() > 1 && text.front() == '`' && text.back() == '`';
  return is_code ? text.substr(1, text.size() - 2) : text;
}

Cells cells_of(const std::string& line) {
  Cells cells;
  std::string cell;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line.compare(i, 2, "\\|") == 0) {
      cell += line[++i];
    } else if (line[i] == '|') {
      cells.push_back(trimmed(std::exchange(cell, "")));
    } else {
      cell += line[i];
    }
  }
  return cells;
}

// Of the first table below a heading, without its head.
std::vector<Cells> table_below(const std::string& heading) {
  std::istringstream text(read_file(LOCKSTEP_SOURCE_DIR "/docs/verify.md"));
  std::vector<Cells> rows;
  bool is_below = false;
  for (std::string line; std::getline(text, line);) {
    if (line == heading) is_below = true;
    if (!is_below) continue;
    if (line.starts_with("|")) {
      rows.push_back(cells_of(line));
    } else if (!rows.empty()) {
      break;
    }
  }
  REQUIRE(rows.size() > 2);
  rows.erase(rows.begin(), rows.begin() + 2);
  return rows;
}

// What is written as code in a cell; all of it if nothing is.
std::vector<std::string> code_in(const std::string& cell) {
  std::vector<std::string> parts;
  std::string_view rest = cell;
  for (auto begin = rest.find('`'); begin != std::string::npos; begin = rest.find('`')) {
    rest.remove_prefix(begin + 1);
    parts.emplace_back(rest.substr(0, rest.find('`')));
    rest.remove_prefix(parts.back().size() + 1);
  }
  return parts.empty() ? std::vector<std::string>{cell} : parts;
}

// "<A x="1"><B>" -> "</B></A>"
std::string closing(const std::string& tags) {
  std::string text;
  for (auto at = tags.find('<'); at != std::string::npos; at = tags.find('<', at + 1)) {
    text.insert(0, "</" + tags.substr(at + 1, tags.find_first_of(" >", at) - at - 1) + '>');
  }
  return text;
}

std::string leaf_file(const TemporaryDirectory& directory, const std::string& rows) {
  return directory.file("rows.leaves.xml", "<leaves lockstep=\"1\">" + rows + "</leaves>");
}

// The line of the results, and the names of the findings.
std::string result_lines(const std::string& out) {
  std::istringstream text(out);
  std::string lines;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("  results ")) lines += line.substr(line.find_last_of("  ") + 1) + '\n';
    if (line.starts_with("finding ")) lines += line.substr(0, line.find(':')) + '\n';
  }
  return lines;
}

}  // namespace

// The lines of a verdict that say what holds, and not how it was found or which run shows it.
std::string said_in(const std::string& out) {
  std::istringstream text(out);
  std::string said;
  for (std::string line; std::getline(text, line);) {
    const bool is_about_search = contains(line, " transitions, ") || line.starts_with("  alike ");
    const bool is_about_run = line.starts_with("    ");
    if (!is_about_search && !is_about_run) said += line + '\n';
  }
  return said;
}

TEST_CASE("each example tree is verified as docs/verify.md says, with and without symmetry") {
  const TemporaryDirectory directory;
  std::set<std::string> documented;
  for (const Cells& row : table_below("## The trees of trees/, verified")) {
    REQUIRE(row.size() == 4);
    INFO(row[0] << ' ' << row[1]);
    documented.insert(row[0]);
    std::vector<std::string> arguments{"verify",   LOCKSTEP_SOURCE_DIR "/" + row[0],
                                       "--leaves", leaf_file(directory, row[1]),
                                       "--out",    directory.path("out")};
    const Outcome it = run_lockstep(arguments);
    arguments.emplace_back("--no-symmetry");
    CHECK(said_in(run_lockstep(arguments).out) == said_in(it.out));
    INFO(it.out << it.err);
    const std::string word = row[3].substr(0, row[3].find(':'));
    if (word == "refused") {
      CHECK(it.code == 3);
      continue;
    }
    CHECK(contains(it.out, "\n  " + row[2] + " states, "));
    CHECK(it.code == (word == "verified" ? 0 : 1));
    CHECK(contains(it.out, word == "verified" ? "\nverified" : "\nfinding " + word + ": "));
    arguments.back() = "--cuts";
    const Outcome cut = run_lockstep(arguments);
    INFO(cut.out << cut.err);
    CHECK(cut.code == it.code);
    CHECK(result_lines(cut.out) == result_lines(it.out));
  }
  for (const auto& file : fs::recursive_directory_iterator(LOCKSTEP_SOURCE_DIR "/trees")) {
    if (file.path().extension() != ".xml") continue;
    const std::string name = fs::relative(file.path(), LOCKSTEP_SOURCE_DIR).string();
    INFO(name);
    const bool has_tree = contains(read_file(file.path().string()), "<BehaviorTree");
    CHECK((!has_tree || documented.contains(name)));
  }
}

TEST_CASE("what the language promises is proved as docs/verify.md says") {
  const TemporaryDirectory directory;
  for (const Cells& row : table_below("## What the language promises, verified")) {
    REQUIRE(row.size() == 4);
    INFO(row[0]);
    const std::vector<std::string> code = code_in(row[1]);  // the root; what is around each child
    const std::string root = code[0].substr(1, code[0].find_first_of(" >") - 1);
    const std::string around = code.size() > 1 ? code[1] : "";
    const auto child = [&](const std::string& name) {
      return around + "<Advance name=\"" + name + "\" step=\"0.05\"/>" + closing(around);
    };
    const std::string tree = directory.file(
        "t.xml",
        "<root lockstep=\"1\"><plugin name=\"motion\"/><plugin name=\"fetch\"/>"
        "<resources name=\"hand\"/><BehaviorTree ID=\"T\">" +
            code[0] + child("a") + child("b") + "</" + root + "></BehaviorTree></root>");
    std::vector<std::string> arguments{
        "verify", tree, "--leaves", leaf_file(directory, row[2]), "--out", directory.path("out")};
    if (contains(row[1], "guard")) {
      arguments.insert(arguments.end(),
                       {"--property", "guarded: never " + root + ".running and not guard.ticked"});
    }
    const Outcome it = run_lockstep(arguments);
    INFO(it.out << it.err);
    CHECK(contains(it.out, row[3]));
  }
}
