#include "study/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <regex>

#include "study/choice.h"
#include "study/study_case.h"

namespace lockstep::test {
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

// "1, not synchronized" is the value 1, "none" is "".
std::string axis_value(const std::string& cell) {
  const std::string value = cell.substr(0, cell.find_first_of(", "));
  return value == "none" ? "" : value;
}

int check_row(const std::string& line, const std::string& comment, const Summary& summary) {
  INFO(line);
  const auto end = comment.find(';');
  const Words cells = split(line.substr(1), '|'), columns = split(comment.substr(0, end), '|');
  const Words common = end == std::string::npos ? Words{} : words_of(comment.substr(end + 1));
  REQUIRE(cells.size() == columns.size());
  std::vector<std::pair<std::string, std::string>> axes;
  int count = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    INFO(cells[i]);
    Words words = words_of(columns[i]);
    if (columns[i] == "-") continue;
    if (words.size() == 1 && summary.is_axis(words[0])) {
      axes.emplace_back(words[0], axis_value(cells[i]));
      continue;
    }
    words.insert(words.end(), common.begin(), common.end());
    auto choices = choices_of(words, summary);
    for (Choice& it : choices) it.values.insert(it.values.end(), axes.begin(), axes.end());
    count += check_cell(cells[i], summary, choices);
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
  std::string comment, previous;
  const std::string open = "<!-- table: ", close = " -->";
  std::string page = std::regex_replace(read_file(file), std::regex(" \\\\\n +"), " ");
  for (const std::string& line : lines(page)) {
    INFO(file << ": " << line);
    if (line.starts_with("lockstep study trees/")) {
      const std::string out = fmt::format("study{}", --studies);
      it.make(study_of(line), out);
      summary = Summary(it.read(out, "summary.csv"));
    }
    const bool is_table = line.starts_with("| ");
    if (is_table && !previous.starts_with("|")) {
      comment = previous.starts_with(open)
                    ? previous.substr(open.size(), previous.find(close) - open.size())
                    : "";
      CHECK((summary.rows.empty() || !comment.empty()));
    } else if (is_table && !comment.empty()) {
      numbers -= check_row(line, comment, summary);
    }
    previous = line;
  }
  CHECK(studies == 0);
  CHECK(numbers == 0);
}

}  // namespace lockstep::test
