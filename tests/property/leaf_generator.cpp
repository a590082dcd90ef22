// Of the generator of random trees: leaves, and the scripts that they play.
#include <fmt/format.h>

#include <array>

#include "property/tree_generator.h"
#include "support/leaf_script.h"

namespace lockstep::host::test {

namespace {

// So many 50 ms; some ask, and nobody answers.
Plan waiting(int steps) {
  const double seconds = .05 * steps;
  if (steps % 3 != 1) return Plan{.kind = "Wait", .seconds = seconds};
  const char* const fallback = steps % 4 == 0 ? "" : steps % 2 == 0 ? "no" : "yes";
  return Plan{.kind = "Ask", .seconds = seconds, .fallback = fallback};
}

}  // namespace

Plan TreeGenerator::leaf() {
  if (scripts_ && one_in(5)) {
    if (one_in(3)) {
      return Plan{.kind = "WaitUntil", .seconds = .1 * between(0, 8), .code = condition()};
    }
    return one_in(2) ? Plan{.kind = "Script", .code = assignment()}
                     : Plan{.kind = "Check", .code = condition()};
  }
  switch (between(0, 19)) {
    case 0:
      return Plan{.kind = "AlwaysSuccess"};
    case 1:
      return one_in(2) ? Plan{.kind = "AlwaysFailure"} : Plan{.kind = "AlwaysRunning"};
    case 2:
    case 3:
      return waiting(between(0, 20));
    case 4:
    case 5:
      return scripted("condition");
    case 6:
      return scripted("bare");
    default:
      return scripted("action");
  }
}

std::string TreeGenerator::results() const {
  return skips_ ? "SSFFK" : "SF";
}

Plan TreeGenerator::scripted(std::string kind) {
  const std::string name = fmt::format("a{}", leaves_++);
  std::string script;
  if (kind == "condition")
    script = steps(results(), 4);
  else if (!one_in(3))
    script = one_in(2) ? growth() : steps("RRRRS" + results(), 10);
  else
    script = one_in(2) ? "R" + live() : steps("RRRRRRRR" + results(), 12) + live();
  if (faults_ && one_in(4)) script = fault(script);
  return Plan{.kind = std::move(kind), .name = name, .script = std::move(script)};
}

std::string TreeGenerator::progress() {
  // Two decimals, so that the number cannot run into the dots of a repeated script.
  return fmt::format("{:.2f}", one_in(10)  ? pick(std::array{-.5, 1.5, 1.0})
                               : one_in(5) ? 0.0
                                           : fraction());
}

std::string TreeGenerator::growth() {
  if (one_in(2)) return fmt::format("+{}", pick(std::array{.05, .1, .2, .25, .3, .5}));
  return fmt::format("+{},-{},{}", fraction(), pick(std::array{.1, .2, .3}), fraction() / 2);
}

std::string TreeGenerator::steps(std::string_view letters, int longest) {
  std::string text;
  for (int count = between(1, longest); count > 0; --count) {
    text += pick(letters);
    if (!one_in(4)) text += progress();
  }
  return text + "...";
}

std::string TreeGenerator::live() {
  std::string text;
  for (int count = between(2, 40); count > 0; --count) {
    text += (text.empty() ? "~" : ",") + (one_in(2) ? std::to_string(between(0, 1)) : progress());
  }
  return text;
}

std::string TreeGenerator::fault(const std::string& script) {
  constexpr std::array kWrong{"X", "T", "B", "I", "x", "t", "R<nan>", "R<nan>", "R<nan>", "R<nan>"};
  constexpr std::array kCalls{"!halt", "^halt", "!pause", "^pause", "!resume", "^resume"};
  if (one_in(2)) return script + pick(kCalls);
  if (script[0] == '+') return steps("R", 10) + pick(kCalls);
  return (script[0] == 'R' ? "R" : "S") + std::string(pick(kWrong)) + script;
}

}  // namespace lockstep::host::test
