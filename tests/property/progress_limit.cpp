#include "property/progress_limit.h"

#include <algorithm>
#include <sstream>

namespace lockstep::host::test {
namespace {

constexpr double kEpsilon = 1e-9;

std::vector<double> equidistant(int count) {
  std::vector<double> barriers;
  for (int i = 1; i <= count; ++i) barriers.push_back(static_cast<double>(i) / count);
  return barriers;
}

// "0.25;0.5"
std::vector<double> numbers_in(const std::string& list) {
  std::vector<double> numbers;
  std::istringstream text(list);
  for (std::string number; std::getline(text, number, ';');) numbers.push_back(std::stod(number));
  return numbers;
}

// In [0, 1], rising, none twice.
bool are_barriers(const std::vector<double>& list) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i] < 0 || list[i] > 1 || (i > 0 && list[i] <= list[i - 1])) return false;
  }
  return true;
}

template <class Value>
Value read(const std::map<std::string, Value>& entries, const std::string& key) {
  const auto entry = entries.find(key);
  if (entry == entries.end()) throw ProgressLimit::BadEntry{};
  return entry->second;
}

}  // namespace

double least_of(const std::vector<double>& snapshot) {
  double least = 1;
  for (const double progress : snapshot) {
    if (!is_left_out(progress)) least = std::min(least, progress);
  }
  return least;
}

ProgressLimit::ProgressLimit(const Plan& plan)
    : barriers_(plan.has_barriers ? plan.barriers : equidistant(plan.barrier_count)),
      tick_at_barrier_(plan.tick_at_barrier) {
  if (!plan.has_barriers && plan.barrier_count < 0) delta_ = plan.delta;
}

ProgressLimit::ProgressLimit(const Plan& plan, const Entries& entries) : ProgressLimit(plan) {
  const auto& keys = plan.from_entries;
  if (const auto delta = keys.find("delta"); delta != keys.end()) {
    delta_ = read(entries.numbers, delta->second);
    if (*delta_ < 0 || *delta_ > 1) throw BadEntry{};
  }
  read_lists(plan, entries);
  const auto at_barrier = keys.find("at_barrier");
  if (at_barrier == keys.end()) return;
  // It has a default, until somebody writes the entry.
  const auto entry = entries.texts.find(at_barrier->second);
  const std::string word = entry == entries.texts.end() ? "wait" : entry->second;
  if (word != "wait" && word != "tick") throw BadEntry{};
  tick_at_barrier_ = word == "tick";
}

void ProgressLimit::read_lists(const Plan& plan, const Entries& entries) {
  const auto& keys = plan.from_entries;
  if (const auto list = keys.find("barriers"); list != keys.end()) {
    barriers_ = numbers_in(read(entries.texts, list->second));
    if (!are_barriers(barriers_)) throw BadEntry{};
  }
  if (const auto count = keys.find("barrier_count"); count != keys.end()) {
    const double number = read(entries.numbers, count->second);
    if (number < 0) throw BadEntry{};
    barriers_ = equidistant(static_cast<int>(number));
  }
}

// The smallest barrier b with b > m + eps, or none.
std::optional<double> ProgressLimit::next_barrier(double least) const {
  for (const double barrier : barriers_) {
    if (barrier > least + kEpsilon) return barrier;
  }
  return std::nullopt;
}

double ProgressLimit::farthest(double least) const {
  if (delta_) return least + *delta_;
  return next_barrier(least).value_or(std::numeric_limits<double>::infinity());
}

bool ProgressLimit::holds(double progress, double least) const {
  if (is_left_out(progress)) return false;
  if (delta_) return progress > least + *delta_ + kEpsilon;
  const auto barrier = next_barrier(least);
  if (!barrier) return false;
  return tick_at_barrier_ ? progress > *barrier + kEpsilon : progress >= *barrier - kEpsilon;
}

}  // namespace lockstep::host::test
