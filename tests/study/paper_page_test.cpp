// docs/paper.md: its commands are run as they stand, and the numbers in its tables are what comes
// out of them.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <regex>
#include <sstream>

#include "study/study_case.h"

namespace lockstep::test {
namespace {

const std::string kPage = LOCKSTEP_SOURCE_DIR "/docs/paper.md";

// "−570" and "0.94", with the number of digits that it is rounded to.
struct Shown {
  double value;
  double tolerance;
};

Shown shown(std::string text) {
  if (text.starts_with("−")) text.replace(0, std::string("−").size(), "-");
  const auto point = text.find('.');
  const std::size_t digits = point == std::string::npos ? 0 : text.size() - point - 1;
  return {std::stod(text), 0.5 * std::pow(10.0, -static_cast<double>(digits)) + 1e-9};
}

// "**median** [lower quartile, upper quartile] minimum … maximum"
struct Cell {
  std::string text;
  std::vector<Shown> numbers;  // in the order of summary.csv: min, q1, median, q3, max
};

// Those of a section's tables; of columns that come from its study alone.
std::vector<Cell> cells_of(const std::string& section) {
  const std::string number = "((?:−)?[0-9.]+)";
  const std::regex cell("\\*\\*" + number + "\\*\\* \\[" + number + ", " + number + "\\] " +
                        number + " … " + number);
  std::vector<Cell> cells;
  std::vector<bool> is_other;
  for (const std::string& line : lines(section)) {
    if (!line.starts_with("| ")) continue;
    std::istringstream columns(line.substr(2));
    std::string text;
    const bool is_head = !contains(line, "**") && line.find("---") == std::string::npos;
    if (is_head) is_other.clear();
    for (std::size_t i = 0; std::getline(columns, text, '|'); ++i) {
      if (is_head) is_other.push_back(text.starts_with(" missed") || contains(text, " tick "));
      std::smatch found;
      if (is_other.size() > i && is_other[i]) continue;
      if (!std::regex_search(text, found, cell)) continue;
      cells.push_back(
          {text,
           {shown(found[4]), shown(found[2]), shown(found[1]), shown(found[3]), shown(found[5])}});
    }
  }
  return cells;
}

// The words behind "lockstep study" in the section's first command, without where it writes.
std::vector<std::string> study_of(const std::string& section) {
  std::smatch found;
  const std::regex command("\nlockstep study ((?:[^\n]*\\\\\n)*[^\n]*)");
  if (!std::regex_search(section, found, command)) return {};
  std::istringstream in(std::regex_replace(found[1].str(), std::regex("\\\\\n"), " "));
  std::vector<std::string> words;
  for (std::string word; in >> word;) {
    if (word == "--out") {
      in >> word;
    } else {
      words.push_back(word.starts_with("trees/") ? LOCKSTEP_SOURCE_DIR "/" + word : word);
    }
  }
  return words;
}

bool is_row(const Cell& cell, const std::vector<std::string>& row, std::size_t first) {
  for (std::size_t i = 0; i < cell.numbers.size(); ++i) {
    if (row.at(first + i).empty()) return false;
    const double value = std::stod(row[first + i]);
    if (!(std::abs(value - cell.numbers[i].value) <= cell.numbers[i].tolerance)) return false;
  }
  return true;
}

void check_section(const StudyCase& it, const std::string& section, int number) {
  const auto cells = cells_of(section);
  const std::string out = fmt::format("section{}", number);
  it.make(study_of(section), out);
  auto rows = lines(it.read(out, "summary.csv"));
  const auto names = fields(rows.at(0));
  const auto first = std::ranges::find(names, "min") - names.begin();
  rows.erase(rows.begin());
  CHECK(cells.size() >= 4);
  for (const Cell& cell : cells) {
    INFO(section.substr(0, section.find('\n')) << ": " << cell.text);
    CHECK(std::ranges::any_of(rows, [&](const std::string& row) {
      return is_row(cell, fields(row), static_cast<std::size_t>(first));
    }));
  }
}

}  // namespace

TEST_CASE("the numbers of docs/paper.md are those of its studies") {
  const StudyCase it;
  const std::string page = read_file(kPage);
  int studies = 0;
  for (auto at = page.find("\n### "); at != std::string::npos;) {
    const auto next = page.find("\n### ", at + 1);
    const std::string section = page.substr(at + 1, next - at);
    if (!study_of(section).empty()) check_section(it, section, studies++);
    at = next;
  }
  CHECK(studies == 7);
}

}  // namespace lockstep::test
