#include "plugin/contract/call_mark.h"

#include <array>
#include <mutex>
#include <string_view>
#include <unordered_set>

#include "core/diagnostics.h"

namespace lockstep::host {
namespace {

// A signal handler may read it.
static_assert(std::atomic<const CallSite*>::is_always_lock_free &&
              std::atomic<std::uint32_t>::is_always_lock_free &&
              std::atomic<std::uint64_t>::is_always_lock_free);

CallSite::Words words_of(const CallSite& site) {
  return site.words();
}
CallSite::Words words_of(const CallSite::Words& words) {
  return words;
}

// Finds a site by its words, without making one.
struct Hash {
  using is_transparent = void;
  std::size_t operator()(const auto& site) const {
    const CallSite::Words words = words_of(site);
    return std::hash<std::string_view>()(words.path.empty() ? words.plugin : words.path);
  }
};

struct Same {
  using is_transparent = void;
  bool operator()(const auto& a, const auto& b) const { return words_of(a) == words_of(b); }
};

std::string text_of(const CallSite::Words& words) {
  if (words.path.empty()) return "";
  std::string text = "'" + printable(words.path) + "' (";
  if (!words.id.empty()) text.append(words.id).append(" ");
  return text.append("of plugin '").append(words.plugin).append("')");
}

}  // namespace

bool CallSite::Words::operator==(const Words& other) const {
  return path == other.path && id == other.id && plugin == other.plugin &&
         is_local == other.is_local && std::string_view(kind) == other.kind;
}

const char* name_of(PluginFunction function) {
  static constexpr std::array kNames{
      "none",     "load",          "describe",  "init",        "create_run", "create",
      "start",    "start_unreset", "tick",      "halt",        "pause",      "resume",
      "progress", "run",           "destroy",   "destroy_run", "deinit",     "retain",
      "release",  "to_text",       "from_text", "to_bytes",    "from_bytes", "end"};
  static_assert(kNames.size() == static_cast<std::size_t>(PluginFunction::End) + 1);
  return kNames[static_cast<std::size_t>(function)];
}

const CallSite& CallSite::of(const Words& words) {
  // Never destroyed: threads outlive the end of main.
  static auto& mutex = *new std::mutex;
  static auto& sites = *new std::unordered_set<CallSite, Hash, Same>;
  const std::lock_guard lock(mutex);
  if (const auto found = sites.find(words); found != sites.end()) return *found;
  return *sites
              .insert({std::string(words.path), std::string(words.id), std::string(words.plugin),
                       words.kind, words.is_local, text_of(words)})
              .first;
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

}  // namespace lockstep::host
