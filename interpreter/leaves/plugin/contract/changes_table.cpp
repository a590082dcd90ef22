// Whether a port has another value than before: lockstep_changes.
#include "leaves/plugin/contract/host.h"

namespace lockstep::host {
namespace {

const Value kUnwritten;

bool changed(const lockstep_caller* caller, std::uint32_t port) {
  BoundPort* const it = port_of(*caller, port);
  if (it == nullptr || it->read == nullptr || it->entry.empty()) return false;
  try {
    const InEngine scope(caller->run->lock);
    const Value* const value = it->value();
    const Value& now = value == nullptr ? kUnwritten : *value;
    Value& seen = it->remembered().seen;
    if (now == seen) return false;
    seen = now;
  } catch (const std::exception&) {
    // Out of memory: it has changed, and will have at the next call.
  }
  return true;
}

}  // namespace

const lockstep_changes& changes_table() {
  static constexpr lockstep_changes kTable{.struct_size = sizeof(lockstep_changes),
                                           .changed = changed};
  return kTable;
}

}  // namespace lockstep::host
