#include "leaves/plugin/contract/plugin_clock.h"

#include <algorithm>
#include <ctime>

#include "base/core/plugin_exception.h"
#include "base/system/call_mark.h"

namespace lockstep::host {
namespace {

// False: a signal has come.
bool sleep_for(Nanoseconds time) {
  const timespec wait{.tv_sec = 0, .tv_nsec = time.count()};
  return clock_nanosleep(CLOCK_MONOTONIC, 0, &wait, nullptr) == 0;
}

}  // namespace

const lockstep_clock* clock_of(const lockstep_plugin& plugin) {
  if (plugin.get_extension == nullptr) return nullptr;
  const void* table = nullptr;
  const MarkedCall mark(CallSite::of_plugin(plugin.name), PluginFunction::Describe);
  thrown_by([&] { table = plugin.get_extension(LOCKSTEP_CLOCK); });
  const auto* const clock = static_cast<const lockstep_clock*>(table);
  return clock != nullptr && clock->struct_size >= sizeof *clock ? clock : nullptr;
}

std::optional<std::string> PluginClock::open() {
  const char* why = nullptr;
  if (clock_.open(&why)) return std::nullopt;
  return why == nullptr ? "it does not open" : why;
}

Nanoseconds PluginClock::now() {
  const std::int64_t there = clock_.now();
  if (there < 0) return Nanoseconds(now_);
  if (has_begun_) now_ += std::max<std::int64_t>(there - there_, 0);
  has_begun_ = true;
  there_ = there;
  return Nanoseconds(now_);
}

// Nobody says when the time has come, so it is looked at. While the clock stands, whoever waits
// wants to look at other things from time to time.
void PluginClock::sleep_until(Nanoseconds deadline) {
  constexpr Nanoseconds kLook = std::chrono::milliseconds(1);
  constexpr int kMostLooks = 100;
  for (int i = 0; i < kMostLooks && now() < deadline; ++i) {
    if (!sleep_for(kLook)) return;
  }
}

}  // namespace lockstep::host
