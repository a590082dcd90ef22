#include "plugin/initialize.h"

#include <fmt/format.h>

#include "core/plugin_exception.h"
#include "plugin/call_mark.h"
#include "plugin/host.h"

namespace lockstep {

std::string initialize_plugin(const lockstep_plugin& plugin) {
  if (plugin.init == nullptr) return {};
  static const LeafTime no_time;
  static const LeafLog no_log;
  LeafSlot slot;
  lockstep_caller caller{plugin.name, {}, RandomStream(0, 0), &no_time, &no_log, &slot};
  const MarkedCall mark(CallSite::of("", plugin.name), PluginFunction::Init);
  bool works = false;
  const std::string thrown = thrown_by([&] { works = plugin.init(&host_table(), &caller); });
  if (!thrown.empty()) return fmt::format("refuses to work: its init {}", thrown);
  if (slot.error != nullptr) return fmt::format("refuses to work: {}", slot.error);
  return works ? "" : "refuses to work: its init returned false";
}

}  // namespace lockstep
