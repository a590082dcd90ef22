#include "record/live/run_status.h"

#include <algorithm>

#include "base/json/json.h"
#include "record/live/orders.h"

namespace lockstep::host {
namespace {

Json json_of(Breakpoint breakpoint) {
  return {{"node", breakpoint.node}, {"when", word_of(breakpoint.when)}};
}

}  // namespace

void RunStatus::note(Breakpoint breakpoint, bool is_on) {
  std::erase(breakpoints_, breakpoint);
  if (is_on) breakpoints_.push_back(breakpoint);
  is_changed_ = true;
}

std::optional<std::string> RunStatus::next(const RunControl::State& state, LineFeed& feed,
                                           bool is_real_time, Nanoseconds now) {
  const bool is_new = is_changed_ || told_ != state;
  const bool is_due = now - told_at_ >= kPeriod;
  if (!is_new && !is_due) return std::nullopt;
  const auto times = is_due ? feed.take_times() : std::nullopt;
  if (!is_new && !times) return std::nullopt;
  told_ = state;
  is_changed_ = false;
  Json json = {{"state", state.is_paused ? "paused" : "running"}};
  if (state.is_attended) json["attended"] = *state.is_attended;
  if (!is_real_time) json["speed"] = state.speed;
  json["breakpoints"] = Json::array();
  for (const Breakpoint& it : breakpoints_) json["breakpoints"].push_back(json_of(it));
  if (state.breakpoint) json["reached"] = json_of(*state.breakpoint);
  if (times) {
    told_at_ = now;
    json["late_ms"] = to_seconds(times->late) * 1e3;
    json["tick_us"] = to_seconds(times->took) * 1e6;
  }
  return json.text();
}

}  // namespace lockstep::host
