#include "study/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <regex>
#include <sstream>

#include "study/study_case.h"

namespace lockstep::test {
namespace {

using Words = std::vector<std::string>;

Words split(const std::string& text, char separator) {
  Words parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) {
    const auto begin = part.find_first_not_of(' ');
    const auto end = part.find_last_not_of(' ');
    parts.push_back(begin == std::string::npos ? "" : part.substr(begin, end + 1 - begin));
  }
  return parts;
}

Words words_of(const std::string& text) {
  Words words = split(text, ' ');
  std::erase(words, "");
  return words;
}

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

// summary.csv of a study, with two more columns, failures and successes.
struct Summary {
  Words names;
  std::vector<Words> rows;

  std::size_t at(const std::string& name) const {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  }
  bool is_axis(const std::string& name) const { return at(name) < at("node"); }
  bool is_statistic(const std::string& name) const {
    return at(name) > at("measure") && at(name) < names.size();
  }
};

Summary summary_of(const std::string& csv) {
  Summary summary;
  for (const std::string& line : lines(csv)) summary.rows.push_back(fields(line));
  summary.names = summary.rows.at(0);
  summary.rows.erase(summary.rows.begin());
  for (const std::string share : {"success", "failure"}) {
    const std::size_t from = summary.at(share), runs = summary.at("runs");
    summary.names.push_back(share == "success" ? "successes" : "failures");
    for (Words& row : summary.rows) {
      row.push_back(fmt::format("{}", std::stod(row.at(from)) * std::stod(row.at(runs))));
    }
  }
  return summary;
}

// What a number of a cell is: which rows of the summary, and which of their columns.
struct Choice {
  std::vector<std::pair<std::string, std::string>> values;  // of axes
  std::string measure, node, statistic;

  bool is(const Summary& summary, const Words& row) const {
    const std::string& its_measure = row.at(summary.at("measure"));
    return std::ranges::all_of(
               values, [&](const auto& it) { return row.at(summary.at(it.first)) == it.second; }) &&
           (its_measure == measure || its_measure.starts_with(measure + ":")) &&
           row.at(summary.at("node")).ends_with(node);
  }
};

Choice choice_of(const Words& words, const Summary& summary) {
  Choice choice;
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (name == "node") {
      choice.node = word.substr(name.size() + 1);
    } else if (name != word && summary.is_axis(name)) {
      choice.values.emplace_back(name, word.substr(name.size() + 1));
    } else {
      (summary.is_statistic(word) ? choice.statistic : choice.measure) = word;
    }
  }
  return choice;
}

// "a=1/2 min" is "a=1 min" and "a=2 min".
std::vector<Words> alternatives(const Words& words) {
  std::vector<Words> all{{}};
  for (const std::string& word : words) {
    const bool has_path = word.starts_with("node=") || contains(word, ":");
    const std::string name = has_path ? word : word.substr(0, word.find('=') + 1);
    std::vector<Words> longer;
    for (const std::string& value : has_path ? Words{""} : split(word.substr(name.size()), '/')) {
      for (Words one : all) {
        one.push_back(name + value);
        longer.push_back(one);
      }
    }
    all = longer;
  }
  return all;
}

// The only row, or none.
const Words* row_of(const Summary& summary, const Choice& choice) {
  const auto is = [&](const Words& row) { return choice.is(summary, row); };
  if (std::ranges::count_if(summary.rows, is) != 1) return nullptr;
  return &*std::ranges::find_if(summary.rows, is);
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
    const Words* row = row_of(summary, choices[i]);
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
    std::vector<Choice> choices;
    for (const Words& one : alternatives(words)) choices.push_back(choice_of(one, summary));
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
      summary = summary_of(it.read(out, "summary.csv"));
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
