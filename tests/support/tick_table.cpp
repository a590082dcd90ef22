#include "support/tick_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "support/scripted_run.h"

namespace lockstep::host::test {
namespace {

// One tick as a row expects it: "R[a b] halt[b] =.5".
struct Step {
  std::string calls;   // without what follows
  std::string suffix;  // what stands after '=': a progress, or the leaf at fault
  std::string faults;  // what stands after '!': the leaves at fault, "a,b"
  std::vector<std::pair<std::string, std::string>> entries;  // what is set before it: name, value
  bool every_call = false;
};

// Cuts at blanks that are outside of brackets.
std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> words(1);
  int depth = 0;
  for (const char character : text) {
    if (character == '[' || character == '{') ++depth;
    if (character == ']' || character == '}') --depth;
    if (character == ' ' && depth == 0) {
      words.emplace_back();
    } else {
      words.back() += character;
    }
  }
  std::erase(words, "");
  return words;
}

// What stands behind the first `mark` in `word`, which is shortened by it.
std::string cut_off(std::string& word, char mark) {
  const auto at = word.find(mark);
  if (at == std::string::npos) return {};
  std::string rest = word.substr(at + 1);
  word.resize(at);
  return rest;
}

// A line of the message that compares what was expected with what came.
std::string line(const std::string& calls, const std::string& suffix, const std::string& faults) {
  return "\n    " + calls + (suffix.empty() ? "" : " =" + suffix) +
         (faults.empty() ? "" : " !" + faults);
}

std::vector<Step> parse_expected(std::string_view text) {
  std::vector<Step> steps;
  decltype(Step::entries) entries;
  for (std::string& word : words(text)) {
    if (const auto at = word.find(":="); at != std::string::npos) {
      entries.emplace_back(word.substr(0, at), word.substr(at + 2));
      continue;
    }
    if (std::islower(static_cast<unsigned char>(word[0])) != 0 && !word.starts_with("stop")) {
      steps.back().calls += " " + word;
      continue;
    }
    Step& step = steps.emplace_back();
    step.entries = std::exchange(entries, {});
    step.every_call = word.find('{') != std::string::npos;
    step.faults = cut_off(word, '!');
    step.suffix = cut_off(word, '=');
    step.calls = word;
  }
  return steps;
}

std::string every_call(const ScriptedRun& run, char status) {
  std::vector<std::string> calls;
  for (const Event& event : run.events) {
    calls.push_back(fmt::format("{} {}", to_string(event.call), run.leaf_name(event.leaf)));
  }
  return fmt::format("{}{{{}}}", status, fmt::join(calls, ", "));
}

// The ticks first, then the runs of halts, pauses and resumes in their order.
std::string summary(const ScriptedRun& run, char status) {
  std::string ticks, rest;
  Call open = Call::Tick;
  for (const Event& event : run.events) {
    const std::string name = run.leaf_name(event.leaf);
    if (event.call == Call::Tick) {
      ticks += (ticks.empty() ? "" : " ") + name;
    } else if (event.call != Call::Start) {
      if (event.call == open)
        rest.back() = ' ';
      else
        rest += fmt::format(" {}[", to_string(event.call));
      rest += name + "]";
      open = event.call;
    }
  }
  return fmt::format("{}[{}]{}", status, ticks, rest);
}

class Row {
 public:
  Row(const TickRow& row, FaultPolicy policy, const LanguageRules& rules)
      : row_(row), run_(row.tree, row.leaves, policy, rules) {}

  void check() {
    const auto steps = parse_expected(row_.expected);
    std::string expected, got;
    for (const Step& step : steps) {
      expected += line(step.calls, step.suffix, step.faults);
      got += play(step);
    }
    UNSCOPED_INFO("law:    " << row_.law);
    UNSCOPED_INFO("tree:   " << row_.tree);
    UNSCOPED_INFO("leaves: " << row_.leaves);
    CHECK("tick by tick:" + got == "tick by tick:" + expected);
  }

 private:
  std::string play(const Step& step) {
    run_.events.clear();
    if (step.calls.starts_with("stop")) {
      run_.ticker().halt_all();
      return line("stop" + summary(run_, ' ').substr(3), "", faults());
    }
    for (const auto& [name, text] : step.entries) {
      const bool is_double = text.find('.') != std::string::npos;
      run_.set(name, *parse_value(is_double ? ValueType::Double : ValueType::Int, text));
    }
    const Status status = run_.tick(tick_++ * from_seconds(row_.period));
    const Fault* fault = run_.ticker().fault();
    const char letter = fault != nullptr ? 'X' : status_letters()[index_of(status)];
    const std::string got = step.every_call ? every_call(run_, letter) : summary(run_, letter);
    const std::string suffix = step.suffix.empty() ? "" : suffix_of(step.suffix, fault);
    return line(got, suffix, faults());
  }

  std::string faults() {
    std::string names;
    for (const Fault& fault : run_.ticker().take_tolerated()) {
      names.append(names.empty() ? "" : ",").append(run_.tree().labels[fault.node].name);
    }
    return names;
  }

  std::string suffix_of(std::string_view expected, const Fault* fault) {
    if (fault != nullptr) return std::string(run_.tree().labels[fault->node].name);
    const double progress = run_.ticker().progress(0);
    std::string_view number = expected;
    const bool same = std::abs(take_number(number) - progress) < 1e-9;
    return same ? std::string(expected) : fmt::format("{}", progress);
  }

  const TickRow& row_;
  ScriptedRun run_;
  int tick_ = 0;
};

}  // namespace

void check_rows(std::span<const TickRow> rows, FaultPolicy policy, const LanguageRules& rules) {
  for (const TickRow& row : rows) Row(row, policy, rules).check();
}

}  // namespace lockstep::host::test
