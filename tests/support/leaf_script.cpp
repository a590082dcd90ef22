#include "support/leaf_script.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <stdexcept>

#include "base/core/status.h"

namespace lockstep::host::test {
namespace {

// The first letter of each name that no name before it has taken.
constexpr auto kStatusLetters = [] {
  std::array<char, kStatuses.size()> letters{};
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const char* const begin = letters.data();
    for (const char letter : kStatuses[i].name) {
      letters[i] = static_cast<char>(letter - 'a' + 'A');
      if (std::find(begin, begin + i, letters[i]) == begin + i) break;
    }
  }
  return letters;
}();

bool take(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

bool at_number(std::string_view text) {
  return !text.empty() && std::string_view("0123456789.-").find(text[0]) != std::string_view::npos;
}

std::vector<double> take_numbers(std::string_view& text) {
  std::vector<double> numbers{take_number(text)};
  while (take(text, ",")) numbers.push_back(take_number(text));
  return numbers;
}

LeafScript::Step take_step(std::string_view& text) {
  const std::string letters = "XTBxt" + std::string(status_letters());
  if (text.empty() || letters.find(text[0]) == std::string::npos) {
    throw std::invalid_argument("leaf script: expected a letter at '" + std::string(text) + "'");
  }
  LeafScript::Step step{text[0], std::nullopt};
  text.remove_prefix(1);
  if (take(text, "<nan>")) {
    step.progress = std::numeric_limits<double>::quiet_NaN();
  } else if (!text.starts_with("...") && at_number(text)) {
    step.progress = take_number(text);
  }
  return step;
}

Call call_named(std::string_view name) {
  for (const Call call : {Call::Halt, Call::Pause, Call::Resume}) {
    if (to_string(call) == name) return call;
  }
  throw std::invalid_argument("leaf script: no call '" + std::string(name) + "'");
}

}  // namespace

std::string_view status_letters() {
  return {kStatusLetters.data(), kStatusLetters.size()};
}

double take_number(std::string_view& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) {
    throw std::invalid_argument("expected a number at '" + std::string(text) + "'");
  }
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

LeafScript parse_leaf_script(std::string_view text) {
  LeafScript script;
  if (take(text, "+")) {
    script.growth = take_numbers(text);
    if (take(text, "*")) script.least_pace = take_number(text);
    if (take(text, "/")) script.loss = take_number(text);
  } else {
    do {
      script.steps.push_back(take_step(text));
      script.repeats = take(text, "...");
    } while (!script.repeats && !text.empty() &&
             std::string_view("~!^").find(text[0]) == std::string_view::npos);
  }
  if (take(text, "~")) script.live = take_numbers(text);
  script.throws = text.starts_with('^');
  if (take(text, "!") || take(text, "^")) {
    script.fails_in = call_named(text);
    text = {};
  }
  if (!text.empty()) {
    throw std::invalid_argument("leaf script: what is '" + std::string(text) + "'?");
  }
  return script;
}

}  // namespace lockstep::host::test
