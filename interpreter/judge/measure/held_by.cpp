// Which child held another one: the first of those with the least progress, since the limit follows
// from that.
#include <cmath>
#include <cstdint>

#include "base/core/progress.h"
#include "base/core/synchronization.h"
#include "judge/measure/measure.h"

namespace lockstep::host {
namespace {

class HeldBy final : public Accumulator {
 public:
  explicit HeldBy(const MeasureTarget& target)
      : place_(target.place), child_(target.child), other_(target.other) {}

  void reset() override { reached_ = false, ticks_ = 0; }

  void after_tick(const TickView& view) override {
    const SynchronizedTick& tick = view.parallels[place_];
    if (!tick.ticked) return;
    reached_ = true;
    ticks_ += tick.held[child_] && first_least(tick) == other_;
  }

  double value(const EndView&) const override {
    return reached_ ? static_cast<double>(ticks_) : kNoValue;
  }

 private:
  // Of the others. What waits to begin, at a barrier at 0, is as far as what it waits for.
  std::size_t first_least(const SynchronizedTick& tick) const {
    const std::size_t count = tick.used.size();
    std::size_t first = count;
    for (std::size_t i = 0; i < count; ++i) {
      if (i == child_ || is_left_out(tick.used[i])) continue;
      const double ahead = first == count ? -1 : tick.used[i] - tick.used[first];
      const bool is_level = std::fabs(ahead) <= kProgressEpsilon;
      if (is_level ? tick.held[first] && !tick.held[i] : ahead < 0) first = i;
    }
    return first;
  }

  std::size_t place_, child_, other_;
  bool reached_ = false;  // the node, by any tick
  std::uint64_t ticks_ = 0;
};

// The next of two names. One that contains ':', or begins with a quote, is in quotes; in them, two
// quotes are one. False: it is not, or there is none.
bool take_name(std::string_view& rest, std::string& name) {
  const bool is_quoted = rest.starts_with('"');
  if (!is_quoted) {
    name = rest.substr(0, rest.find(':'));
    rest.remove_prefix(name.size());
    return !name.empty();
  }
  for (rest.remove_prefix(1); !rest.empty(); rest.remove_prefix(1)) {
    if (rest.front() == '"') {
      rest.remove_prefix(1);
      if (!rest.starts_with('"')) return !name.empty();
    }
    name += rest.front();
  }
  return false;
}

std::string name_text(std::string_view name) {
  if (name.find(':') == std::string_view::npos && !name.starts_with('"')) return std::string(name);
  std::string text = "\"";
  for (const char character : name) text.append(character == '"' ? 2 : 1, character);
  return text + '"';
}

// ":A:B".
std::string parse_names(std::string_view argument, MeasureSpec& spec) {
  const auto take = [&](std::string& name) {
    if (!argument.starts_with(':')) return false;
    argument.remove_prefix(1);
    return take_name(argument, name);
  };
  if (!take(spec.name) || !take(spec.other) || !argument.empty()) {
    return "expected 'held-by:A:B', two names; one that contains ':' is written in quotes: "
           "held-by:\"a:b\":c";
  }
  spec.argument = ":" + name_text(spec.name) + ":" + name_text(spec.other);
  return {};
}

}  // namespace

extern const Measure kHeldBy{
    .name = "held-by",
    .argument = ":A:B",
    .of = MeasureOf::Pair,
    .axis = "held",
    .unit = "ticks",
    .doc =
        "how many of the ticks that `held:A` counts were withheld because of B: it was the first "
        "child of the synchronized node, or the first member of the barrier, with the least "
        "progress",
    .make = make_accumulator<HeldBy>,
    .is_possible = is_count_of_ticks,
    .parse = parse_names,
    .label = [](const MeasureSpec& spec) { return "held by " + spec.other + " (ticks)"; }};

}  // namespace lockstep::host
