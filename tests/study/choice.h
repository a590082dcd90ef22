// What a number in a table of a page stands for: a row of the summary of a study, and a column.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lockstep::host::test {

using Words = std::vector<std::string>;

// The parts between separators, without spaces around them.
Words split(const std::string& text, char separator);
Words words_of(const std::string& text);

// summary.csv, with two more columns, failures and successes.
struct Summary {
  Words names;
  std::vector<Words> rows;

  explicit Summary(const std::string& csv = "");
  std::size_t at(const std::string& name) const;
  bool is_axis(const std::string& name) const { return at(name) < at("node"); }
  bool is_statistic(const std::string& name) const {
    return at(name) > at("measure") && at(name) < names.size();
  }
};

struct Choice {
  std::vector<std::pair<std::string, std::string>> values;  // of axes
  std::string measure, node, statistic;

  // The only row, or none.
  const Words* row(const Summary& summary) const;
};

// Those that a column of a table stands for, as page.h has it.
std::vector<Choice> choices_of(const Words& words, const Summary& summary);

}  // namespace lockstep::host::test
