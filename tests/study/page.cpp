#include "study/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <regex>

#include "study/choice.h"
#include "study/comparisons.h"
#include "study/study_case.h"

namespace lockstep::host::test {
namespace {

// "−570" and "0.94", with the number of digits that it is rounded to.
struct Shown {
  double value;
  double tolerance;
};

std::vector<Shown> numbers_in(const std::string& cell) {
  static const std::regex number("((?:−)?)([0-9]+(?:\\.([0-9]+))?)");
  std::vector<Shown> found;
  for (std::sregex_iterator it(cell.begin(), cell.end(), number), end; it != end; ++it) {
    const double value = std::stod((*it)[2]) * ((*it)[1].length() > 0 ? -1 : 1);
    const double digits = static_cast<double>((*it)[3].length());
    found.push_back({value, 0.5 * std::pow(10.0, -digits) + 1e-9});
  }
  return found;
}

// How many numbers the cell has; each of them is checked.
int check_cell(const std::string& cell, const Summary& summary, std::vector<Choice> choices) {
  const auto numbers = numbers_in(cell);
  if (choices.size() == 1 && choices[0].statistic.empty()) {
    choices.resize(5, choices[0]);
    const Words box{"median", "q1", "q3", "min", "max"};
    for (std::size_t i = 0; i < box.size(); ++i) choices[i].statistic = box[i];
  }
  const bool is_one_for_all = numbers.size() == 1;
  CHECK((is_one_for_all || numbers.size() == choices.size()));
  for (std::size_t i = 0; i < choices.size() && (is_one_for_all || i < numbers.size()); ++i) {
    const Words* row = choices[i].row(summary);
    INFO(choices[i].measure << " " << choices[i].statistic);
    REQUIRE(row != nullptr);
    const Shown& shown = numbers.at(is_one_for_all ? 0 : i);
    CHECK(std::stod(row->at(summary.at(choices[i].statistic))) ==
          Approx(shown.value).margin(shown.tolerance).epsilon(0));
  }
  return static_cast<int>(numbers.size());
}

// Below this, p is below 0.05 even if all comparisons of a page are looked at.
constexpr double kClear = 0.0002;

// "−2.34 [−2.42, −2.25]": the shift between two cells and its interval; or one number for all
// three. With "*?*" where p is below 0.05, but not clearly.
int check_shift(const std::string& cell, const Summary& summary, const Choice& from,
                const Choice& to, Comparisons& comparisons) {
  const auto numbers = numbers_in(cell);
  const Words *first = from.row(summary), *second = to.row(summary);
  REQUIRE(first != nullptr);
  REQUIRE(second != nullptr);
  const auto found = comparisons.between(*first, *second);
  INFO(found);
  CHECK((numbers.size() == 1 || numbers.size() == 3));
  const Words names{"difference", "difference_low", "difference_high"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Shown& shown = numbers.at(numbers.size() == 1 ? 0 : i);
    CHECK(found[names[i]].get<double>() == Approx(shown.value).margin(shown.tolerance).epsilon(0));
  }
  CHECK(contains(cell, "*?*") == (found["p"] < 0.05 && found["p"] >= kClear));
  return static_cast<int>(numbers.size());
}

// "1, not synchronized" is the value 1, "none" is "".
std::string axis_value(const std::string& cell) {
  const std::string value = cell.substr(0, cell.find_first_of(", "));
  return value == "none" ? "" : value;
}

// A table, as its comment describes it.
struct Table {
  bool is_compare = false;
  Words columns, common;
};

// Nothing without a comment.
std::optional<Table> table_of(const std::string& line) {
  static const std::regex comment("<!-- (table|compare): ([^;]*)(?:;(.*))? -->");
  std::smatch found;
  if (!std::regex_match(line, found, comment)) return std::nullopt;
  return Table{found[1] == "compare", split(found[2], '|'), words_of(found[3])};
}

// The choice of a column's words, on one side of "→". `labels` are those of the row, by axis.
std::vector<Choice> chosen(const Words& words, const std::map<std::string, std::string>& labels,
                           const Summary& summary, Side side) {
  Words on_this;
  for (const std::string& word : words) on_this.push_back(on_side(word, side));
  auto choices = choices_of(on_this, summary);
  for (Choice& it : choices) {
    for (const auto& [axis, label] : labels)
      it.values.emplace_back(axis, axis_value(on_side(label, side)));
  }
  return choices;
}

int check_row(const std::string& line, const Table& table, const Summary& summary,
              Comparisons& comparisons) {
  INFO(line);
  const Words cells = split(line.substr(1), '|');
  REQUIRE(cells.size() == table.columns.size());
  std::map<std::string, std::string> labels;
  int count = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    INFO(cells[i]);
    Words words = words_of(table.columns[i]);
    if (table.columns[i] == "-") continue;
    if (words.size() == 1 && summary.is_axis(words[0])) {
      labels[words[0]] = cells[i];
      continue;
    }
    words.insert(words.end(), table.common.begin(), table.common.end());
    const auto from = chosen(words, labels, summary, Side::From);
    if (table.is_compare) {
      const auto to = chosen(words, labels, summary, Side::To);
      count += check_shift(cells[i], summary, from.at(0), to.at(0), comparisons);
    } else {
      count += check_cell(cells[i], summary, from);
    }
  }
  return count;
}

// The words behind "lockstep study", without where it writes.
Words study_of(const std::string& command) {
  Words words = words_of(command);
  words.erase(words.begin(), words.begin() + 2);
  const auto out = std::ranges::find(words, "--out");
  if (out != words.end()) words.erase(out, out + 2);
  for (std::string& word : words) {
    if (word.starts_with("trees/")) word = LOCKSTEP_SOURCE_DIR "/" + word;
    std::erase(word, '\'');
  }
  return words;
}

}  // namespace

void check_page(const std::string& file, int studies, int numbers) {
  const StudyCase it;
  Summary summary;
  std::optional<Comparisons> comparisons;
  std::optional<Table> table;
  std::string previous;
  std::string page = std::regex_replace(read_file(file), std::regex(" \\\\\n +"), " ");
  for (const std::string& line : lines(page)) {
    INFO(file << ": " << line);
    if (line.starts_with("lockstep study trees/")) {
      const std::string out = fmt::format("study{}", --studies);
      it.make(study_of(line), out);
      summary = Summary(it.read(out, "summary.csv"));
      comparisons.emplace(it.path(out), summary);
    }
    const bool is_table = line.starts_with("| ");
    if (is_table && !previous.starts_with("|")) {
      table = table_of(previous);
      CHECK((summary.rows.empty() || table));
    } else if (is_table && table) {
      numbers -= check_row(line, *table, summary, *comparisons);
    }
    previous = line;
  }
  CHECK(studies == 0);
  CHECK(numbers == 0);
}

}  // namespace lockstep::host::test
