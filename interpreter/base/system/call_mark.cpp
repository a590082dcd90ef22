#include "base/system/call_mark.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>

#include "base/core/diagnostics.h"

namespace lockstep::host {
namespace {

// A signal handler may read it.
static_assert(std::atomic<const CallSite*>::is_always_lock_free &&
              std::atomic<std::uint64_t>::is_always_lock_free);

}  // namespace

const char* name_of(PluginFunction function) {
  static constexpr std::array kNames{
      "none",          "load",        "describe", "init",     "create_run", "create",   "start",
      "start_unreset", "tick",        "halt",     "pause",    "resume",     "progress", "run",
      "destroy",       "destroy_run", "deinit",   "retain",   "release",    "to_text",  "from_text",
      "to_bytes",      "from_bytes",  "reads",    "set_pace", "save",       "restore",  "end"};
  static_assert(kNames.size() == static_cast<std::size_t>(PluginFunction::End) + 1);
  return kNames[static_cast<std::size_t>(function)];
}

// The tables are never destroyed: threads outlive the end of main.
const CallSite::Origin& CallSite::origin_of(const Words& words) {
  using Key = std::tuple<std::string, std::string, std::string_view, bool>;
  static auto& mutex = *new std::mutex;
  static auto& origins = *new std::map<Key, Origin>;
  const std::lock_guard lock(mutex);
  Key key(words.id, words.plugin, words.kind, words.is_local);
  const Origin origin{std::get<0>(key), std::get<1>(key), words.kind, words.is_local};
  return origins.try_emplace(std::move(key), origin).first->second;
}

const CallSite& CallSite::of(const Words& words) {
  struct KnownSite {
    std::string shown;
    CallSite site;
  };
  static auto& mutex = *new std::mutex;
  static auto& sites = *new std::map<std::pair<const Origin*, std::string>, KnownSite>;
  const Origin& origin = origin_of(words);
  const std::lock_guard lock(mutex);
  const auto [it, is_new] = sites.try_emplace({&origin, std::string(words.path)});
  if (is_new) {
    it->second.shown = printable(words.path);
    it->second.site = {it->first.second.c_str(), it->second.shown.c_str(), &origin};
  }
  return it->second.site;
}

std::string CallSite::text() const {
  if (is_plugin()) return "";
  return fmt::format("'{}' ({}{}of plugin '{}')", shown, origin->id, origin->id.empty() ? "" : " ",
                     origin->plugin);
}

// Between two calls there is a moment without one, in which the site changes. So what was read
// between two equal looks at the function belongs to one call, if no other has begun meanwhile: of
// a tick, a halt and a tick, both looks could be at a tick, and the site that of the halt.
CallMark::Look CallMark::look() const {
  while (true) {
    const std::uint64_t serial = serial_.load(std::memory_order_acquire);
    const std::uint8_t before = function_.load(std::memory_order_acquire);
    const Look seen = as_read(before);
    const std::uint8_t after = function_.load(std::memory_order_acquire);
    if (before == after && serial == serial_.load(std::memory_order_acquire)) return seen;
  }
}

}  // namespace lockstep::host
