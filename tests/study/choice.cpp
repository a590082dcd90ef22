#include "study/choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "study/study_case.h"

namespace lockstep::host::test {
namespace {

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

bool is_chosen(const Choice& choice, const Summary& summary, const Words& row) {
  const std::string& measure = row.at(summary.at("measure"));
  const auto has = [&](const auto& it) { return row.at(summary.at(it.first)) == it.second; };
  return std::ranges::all_of(choice.values, has) &&
         (measure == choice.measure || measure.starts_with(choice.measure + ":")) &&
         row.at(summary.at("node")).ends_with(choice.node);
}

}  // namespace

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

Summary::Summary(const std::string& csv) {
  for (const std::string& line : lines(csv)) rows.push_back(fields(line));
  if (rows.empty()) return;
  names = rows[0];
  rows.erase(rows.begin());
  for (const std::string share : {"success", "failure"}) {
    const std::size_t from = at(share), runs = at("runs");
    names.push_back(share == "success" ? "successes" : "failures");
    for (Words& row : rows) {
      row.push_back(fmt::format("{}", std::stod(row.at(from)) * std::stod(row.at(runs))));
    }
  }
}

std::size_t Summary::at(const std::string& name) const {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

const Words* Choice::row(const Summary& summary) const {
  const auto is = [&](const Words& it) { return is_chosen(*this, summary, it); };
  if (std::ranges::count_if(summary.rows, is) != 1) return nullptr;
  return &*std::ranges::find_if(summary.rows, is);
}

std::vector<Choice> choices_of(const Words& words, const Summary& summary) {
  std::vector<Choice> choices;
  for (const Words& one : alternatives(words)) choices.push_back(choice_of(one, summary));
  return choices;
}

}  // namespace lockstep::host::test
