#include "plugin/call_mark.h"

#include <array>
#include <mutex>
#include <string_view>
#include <unordered_set>
#include <utility>

namespace lockstep {
namespace {

// A signal handler may read it.
static_assert(std::atomic<const CallSite*>::is_always_lock_free &&
              std::atomic<std::uint32_t>::is_always_lock_free &&
              std::atomic<std::uint64_t>::is_always_lock_free);

struct Hash {
  std::size_t operator()(const CallSite& site) const {
    return std::hash<std::string>()(site.leaf) ^ std::hash<std::string>()(site.plugin);
  }
};

struct Same {
  bool operator()(const CallSite& a, const CallSite& b) const {
    return a.leaf == b.leaf && a.plugin == b.plugin && a.is_local == b.is_local &&
           std::string_view(a.kind) == b.kind;
  }
};

}  // namespace

const char* name_of(PluginFunction function) {
  static constexpr std::array kNames{"none",     "load",       "describe", "init",    "create_run",
                                     "create",   "start",      "tick",     "halt",    "pause",
                                     "resume",   "progress",   "run",      "destroy", "destroy_run",
                                     "deinit",   "retain",     "release",  "to_text", "from_text",
                                     "to_bytes", "from_bytes", "end"};
  static_assert(kNames.size() == static_cast<std::size_t>(PluginFunction::End) + 1);
  return kNames[static_cast<std::size_t>(function)];
}

const CallSite& CallSite::of(CallSite site) {
  // Never destroyed: threads outlive the end of main.
  static auto& mutex = *new std::mutex;
  static auto& sites = *new std::unordered_set<CallSite, Hash, Same>;
  const std::lock_guard lock(mutex);
  return *sites.insert(std::move(site)).first;
}

// What was read between two equal looks at `call_` belongs to that call.
CallMark::Look CallMark::look() const {
  std::uint32_t before = call_.load(std::memory_order_acquire);
  while (true) {
    const CallSite* const site = site_.load(std::memory_order_acquire);
    const std::uint32_t after = call_.load(std::memory_order_acquire);
    if (before == after) return {site, after};
    before = after;
  }
}

}  // namespace lockstep
