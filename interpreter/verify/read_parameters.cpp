#include "verify/read_parameters.h"

#include <algorithm>
#include <set>

#include "engine/blackboard.h"
#include "engine/tree.h"

namespace lockstep::host {
namespace {

// One that was read from such an entry would be read again.
bool is_same(const Entry& one, const Entry& other) {
  return one.typing == Typing::Strict && other.typing == Typing::Strict &&
         one.writes() == other.writes() && one.is_present == other.is_present &&
         one.value() == other.value();
}

std::size_t count_known(const BoundParameters::State& state) {
  return static_cast<std::size_t>(
      std::ranges::count_if(state.values, &BoundParameters::Values::known));
}

}  // namespace

ReadParameters::ReadParameters(const Tree& tree, const SavedRun& fresh)
    : tree_(tree), fresh_(fresh) {
  std::set<std::uint32_t> slots;
  for (const BoundNode& node : tree.bound) {
    const std::size_t count = node.kind->type.parameters.size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t slot = tree.ports[node.first_port + i].slot;
      if (slot != PortBinding::kUnbound) slots.insert(slot);
    }
  }
  slots_.assign(slots.begin(), slots.end());
  for (const std::uint32_t slot : slots_) entries_.push_back(fresh.entries[slot]);
}

bool ReadParameters::are_known(const std::vector<Entry>& entries) const {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (!is_same(entries[slots_[i]], entries_[i])) return false;
  }
  return true;
}

void ReadParameters::learn(const SavedRun& from, Ticker& ticker) {
  const BoundParameters::State& read = ticker.parameters().state();
  if (count_ == read.values.size() || count_known(read) <= count_) return;
  if (!are_known(from.entries) || !are_known(ticker.blackboard().entries)) return;
  count_ = count_known(read);
  known_ = read;
}

void ReadParameters::give(SavedRun& run, std::span<const ReadValues> values, Ticker& ticker) {
  give_known(run);
  const auto is_missing = [&](std::uint32_t place) {
    return status_of(run.run.activity[tree_.bound[place].node]) == Status::Running &&
           !run.parameters.values[place].known;
  };
  const auto places = static_cast<std::uint32_t>(tree_.bound.size());
  std::uint32_t place = 0;
  while (place != places && !is_missing(place)) ++place;
  if (values.empty() && place == places) return;
  ticker.restore(run);
  for (; place != places; ++place) {
    if (is_missing(place)) ticker.parameters().read_bound(place);
  }
  for (const ReadValues& it : values) ticker.parameters().set(it.place, it.values);
  run.parameters = ticker.parameters().state();
  given_ = kOthers;
}

void ReadParameters::give_known(SavedRun& run) {
  const std::size_t wanted = are_known(run.entries) ? count_ : 0;
  if (wanted == given_) return;
  run.parameters = wanted > 0 ? known_ : fresh_.parameters;
  given_ = wanted;
}

}  // namespace lockstep::host
