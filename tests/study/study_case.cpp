#include "study/study_case.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

namespace lockstep::host::test {

Outcome StudyCase::study(std::vector<std::string> arguments, const std::string& out) const {
  arguments.insert(arguments.begin(), "study");
  arguments.insert(arguments.end(), {"--no-plots", "--out", path(out)});
  return run_lockstep(std::move(arguments));
}

void StudyCase::make(std::vector<std::string> arguments, const std::string& out) const {
  const Outcome outcome = study(std::move(arguments), out);
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
}

Outcome StudyCase::merge(std::vector<std::string> parts, const std::string& out) const {
  std::vector<std::string> arguments{"study", "merge", "--no-plots", "--out", path(out)};
  for (const std::string& part : parts) arguments.push_back(path(part));
  return run_lockstep(std::move(arguments));
}

std::string StudyCase::bytes(const std::string& out) const {
  return read(out, "runs.csv") + read(out, "summary.csv") + read(out, "study.json");
}

Strings with(Strings arguments, const Strings& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

void write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line + ',');
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

std::vector<double> column(const std::string& csv, const std::string& name) {
  const auto all = lines(csv);
  const auto names = fields(all.at(0));
  const auto index = std::find(names.begin(), names.end(), name) - names.begin();
  INFO(all.at(0));
  REQUIRE(index < static_cast<long>(names.size()));
  std::vector<double> values;
  for (std::size_t i = 1; i < all.size(); ++i) {
    values.push_back(std::stod(fields(all[i]).at(static_cast<std::size_t>(index))));
  }
  return values;
}

}  // namespace lockstep::host::test
