#include "leaves/plugin/contract/initialize.h"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "base/core/plugin_exception.h"
#include "base/system/call_mark.h"
#include "base/system/mutex.h"
#include "leaves/plugin/contract/host.h"

namespace lockstep::host {

namespace {

// How many users a plugin has. Its functions stand for it: the table of a set is a copy.
using Functions = std::pair<decltype(lockstep_plugin::init), decltype(lockstep_plugin::deinit)>;
struct Users {
  Mutex mutex;
  std::map<Functions, int> counts LOCKSTEP_GUARDED_BY(mutex);
};
// Never destroyed: plugins are deinitialized at the end of main, or of a program that embeds us.
Users& users() {
  static auto& all = *new Users;
  return all;
}

Functions functions_of(const lockstep_plugin& plugin) {
  return {plugin.init, plugin.deinit};
}

std::string call_init(const lockstep_plugin& plugin) {
  if (plugin.init == nullptr) return {};
  static const LeafTime no_time;
  static const LeafLog no_log;
  LeafSlot slot;
  const CallerRun run{.log = &no_log};
  lockstep_caller caller(no_time, slot, run);
  caller.who = plugin.name;
  const MarkedCall mark(CallSite::of_plugin(plugin.name), PluginFunction::Init);
  bool works = false;
  const std::string thrown = thrown_by([&] { works = plugin.init(&host_table(), &caller); });
  if (!thrown.empty()) return fmt::format("refuses to work: its init {}", thrown);
  if (slot.error != nullptr) return fmt::format("refuses to work: {}", slot.error);
  return works ? "" : "refuses to work: its init returned false";
}

}  // namespace

std::string initialize_plugin(const lockstep_plugin& plugin) {
  Users& all = users();
  const Lock lock(all.mutex);
  int& count = all.counts[functions_of(plugin)];
  std::string failure = count == 0 ? call_init(plugin) : "";
  if (failure.empty()) ++count;
  return failure;
}

void deinitialize_plugin(const lockstep_plugin& plugin) {
  Users& all = users();
  const Lock lock(all.mutex);
  if (--all.counts[functions_of(plugin)] > 0 || plugin.deinit == nullptr) return;
  const MarkedCall mark(CallSite::of_plugin(plugin.name), PluginFunction::Deinit);
  thrown_by(plugin.deinit);  // the work is done; there is no one to report to
}

}  // namespace lockstep::host
