// docs/expressions.md: its examples are what the scripts do.
#include <catch2/catch.hpp>
#include <fstream>
#include <string>
#include <vector>

#include "support/paths.h"
#include "support/script_board.h"

using namespace lockstep::host;
using namespace lockstep::host::test;

namespace {

// The cells of the rows of all tables with this head. A bar in a cell has a backslash.
std::vector<std::vector<std::string>> rows_under(const std::string& head) {
  std::ifstream page(LOCKSTEP_SOURCE_DIR "/docs/expressions.md");
  std::vector<std::vector<std::string>> rows;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("|")) inside = false;
    if (inside && !line.starts_with("|---")) {
      std::vector<std::string> cells{""};
      for (std::size_t i = 2; i < line.size(); ++i) {
        if (line.compare(i, 2, "\\|") == 0) {
          cells.back() += line[++i];
        } else if (line[i] == '|') {
          cells.emplace_back();
        } else {
          cells.back() += line[i];
        }
      }
      for (std::string& cell : cells) {
        cell.erase(0, cell.find_first_not_of(' '));
        cell.erase(cell.find_last_not_of(' ') + 1);
      }
      rows.push_back(cells);
    }
    inside = inside || line == head;
  }
  return rows;
}

// Of a cell `code`.
std::string code(const std::string& cell) {
  REQUIRE(cell.size() > 2);
  REQUIRE((cell.front() == '`' && cell.back() == '`'));
  return cell.substr(1, cell.size() - 2);
}

ScriptBoard board_of_page() {
  ScriptBoard board(std::make_shared<ScriptEnums>(ScriptEnums{{"DOCKED", 2}}));
  for (const auto& row : rows_under("| Entry | Value |")) {
    Entry& entry = board.any(code(row[0]));
    if (row[1].empty()) continue;
    const auto script = Expression::parse(code(row[1]));
    REQUIRE(script.has_value());
    Evaluator evaluator;
    REQUIRE(evaluator.evaluate(*script, {}, entry.to_write()));
  }
  return board;
}

}  // namespace

TEST_CASE("the examples of the page about expressions are what they say") {
  const auto rows = rows_under("| Expression | Value |");
  REQUIRE(rows.size() > 40);
  for (const auto& row : rows) {
    INFO(row[0]);
    ScriptBoard board = board_of_page();
    const ScriptRun run = board.run(code(row[0]));
    if (row[1].starts_with("error: ")) {
      CHECK("error: " + run.error == row[1]);
    } else {
      CHECK(run.error == "");
      CHECK(shown(run.value) == code(row[1]));
    }
  }
}

TEST_CASE("the errors of the page about expressions are where it says") {
  const auto rows = rows_under("| Script | Column | Error |");
  REQUIRE(rows.size() > 5);
  for (const auto& row : rows) {
    INFO(row[0]);
    const auto script = Expression::parse(code(row[0]));
    REQUIRE_FALSE(script.has_value());
    CHECK(std::to_string(script.error().offset + 1) == row[1]);
    CHECK(script.error().message == row[2]);
  }
}
