#include "scenario/expectation_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "leaves/word_check.h"
#include "scenario/scenario_words.h"

namespace lockstep::host {

void ExpectationReader::read(std::uint32_t element, Scenario& into) const {
  const Place place = document_.elements()[element].place;
  std::optional<Expectation> expect;
  double tolerance = 0;
  std::set<Expectation::Kind> kinds;
  for (const Attribute& it : document_.attributes(element)) {
    if (it.name == "tolerance") {
      tolerance = reader_.number(it, 0, 1);
      continue;
    }
    if (!expect) expect = Expectation{.place = it.place};
    expect->kind = read(it, *expect);
    kinds.insert(expect->kind);
  }
  if (kinds == std::set{Expectation::Kind::Text, Expectation::Kind::Inputs} &&
      expect->inputs.empty() && expect->of.empty()) {
    expect->kind = Expectation::Kind::Text;  // the path is that of a measure
    kinds.erase(Expectation::Kind::Inputs);
  }
  if (kinds.size() != 1) {
    report_.at("bad-scenario"_code, place,
               expect ? "an expectation has one condition" : "the expectation has no condition",
               "write result (with ticks, time), order, same-as, a property or a measure as text, "
               "or path with in.PORT");
    return;
  }
  if (expect->kind == Expectation::Kind::Inputs &&
      (expect->inputs.empty() || expect->of.empty() == expect->path.empty())) {
    report_.at("bad-scenario"_code, place,
               "an expectation about inputs needs 'of' or 'path', and in.PORT",
               "write path=\"arm\" in.speed=\"0.2\"");
    return;
  }
  if (const Attribute* it = document_.find_attribute(element, "tolerance");
      it != nullptr && expect->kind != Expectation::Kind::SameAs) {
    report_.at("bad-scenario"_code, it->place, "'tolerance' is of an expectation with 'same-as'");
  }
  expect->tolerance = tolerance;
  into.expectations.push_back(std::move(*expect));
}

Expectation::Kind ExpectationReader::read(const Attribute& it, Expectation& expect) const {
  using enum Expectation::Kind;
  if (it.name.empty()) {
    expect.texts.emplace_back(it.value);
    return Text;
  }
  if (it.name == "order") {
    for (const std::string_view part : split(it.value, ";")) expect.texts.emplace_back(part);
    return Order;
  }
  if (it.name == "same-as") {
    expect.texts.push_back(beside(file_, it.value));
    return SameAs;
  }
  if (it.name == "of" || it.name == "path") {
    (it.name == "of" ? expect.of : expect.path) = it.value;
    return Inputs;
  }
  if (it.name.starts_with(scenario_words::kInput)) {
    expect.inputs.push_back({std::string(it.name.substr(scenario_words::kInput.size())),
                             std::string(it.value), it.place});
    return Inputs;
  }
  read_ending(it, expect);
  return Ending;
}

void ExpectationReader::read_ending(const Attribute& it, Expectation& expect) const {
  if (it.name == "result") {
    constexpr std::string_view kKnown[] = {"success", "failure", "skipped", "fault", "running"};
    for (const std::string_view result : split(it.value, ";")) {
      if (std::ranges::find(kKnown, result) == std::end(kKnown)) {
        report_.at_value("bad-value"_code, it.place,
                         fmt::format("'result' cannot be '{}'", brief(result)),
                         suggest(result, kKnown, "it can be"));
      }
      expect.results.emplace_back(result);
    }
    expect.result_place = it.place;
  } else if (it.name == "ticks") {
    expect.ticks = reader_.range(it, "3, 2..10 or 5..inf");
    expect.ticks_place = it.place;
  } else if (it.name == "time") {
    expect.time = reader_.range(it, "0.5, 0.5..2 or 2..inf, in seconds");
    expect.time_place = it.place;
  } else if (it.name == "node") {
    expect.node = it.value;
  }
}

}  // namespace lockstep::host
