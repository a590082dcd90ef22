#include "property/mini_script.h"

#include <cctype>
#include <stdexcept>

namespace lockstep::host::test {
namespace {

// At each ';' that is not in a text.
std::vector<std::string> statements_in(const std::string& script) {
  std::vector<std::string> statements(1);
  bool in_text = false;
  for (const char letter : script) {
    if (letter == '\'') in_text = !in_text;
    if (letter == ';' && !in_text) {
      statements.emplace_back();
    } else {
      statements.back() += letter;
    }
  }
  return statements;
}

}  // namespace

bool MiniScript::holds(const std::string& text) const {
  for (const std::string sign : {">=", "==", "!=", "<", ">"}) {
    const auto at = text.find(sign);
    if (at == std::string::npos) continue;
    const double left = value(text.substr(0, at)), right = value(text.substr(at + sign.size()));
    // "The same tolerance as of barriers": a child is at b with e >= b - eps, and behind it with
    // e > b + eps.
    const double eps = text.starts_with("progress(") ? 1e-9 : 0;
    const bool is_at_least = left >= right - eps, is_more = left > right + eps;
    if (sign == ">=") return is_at_least;
    if (sign == "<") return !is_at_least;
    if (sign == ">") return is_more;
    return (sign == "==") == (is_at_least && !is_more);
  }
  throw std::logic_error("what is the condition " + text);
}

double MiniScript::number(const std::string& text) const {
  const auto plus = text.find('+');
  if (plus == std::string::npos) return value(text);
  return value(text.substr(0, plus)) + value(text.substr(plus + 1));
}

void MiniScript::run(const std::string& text) const {
  for (const std::string& statement : statements_in(text)) assign(statement);
}

void MiniScript::assign(const std::string& statement) const {
  const std::string name = statement.substr(0, 1), right = statement.substr(3);
  if (right[0] == '\'') {
    entries_.texts[name] = right.substr(1, right.size() - 2);
    return;
  }
  const bool adds = statement[1] == '+';
  const double number = difference(right);
  entries_.numbers[name] = adds ? value(name) + number : number;
}

double MiniScript::difference(const std::string& text) const {
  const auto minus = text.find('-');
  if (minus == std::string::npos) return value(text);
  return value(text.substr(0, minus)) - value(text.substr(minus + 1));
}

double MiniScript::value(const std::string& text) const {
  if (std::isdigit(static_cast<unsigned char>(text[0])) != 0) return std::stod(text);
  static const std::map<std::string, double> kWords{{"idle", 0},    {"running", 1}, {"success", 2},
                                                    {"failure", 3}, {"skipped", 4}, {"none", -1},
                                                    {"true", 1},    {"false", 0}};
  if (const auto word = kWords.find(text); word != kWords.end()) return word->second;
  const auto other = meanings_.find(text);
  const auto reading = entries_.readings.find(other == meanings_.end() ? text : other->second);
  if (reading != entries_.readings.end()) return reading->second;
  const auto entry = entries_.numbers.find(text);
  if (entry == entries_.numbers.end()) throw ReferenceFault{node_};
  return entry->second;
}

}  // namespace lockstep::host::test
