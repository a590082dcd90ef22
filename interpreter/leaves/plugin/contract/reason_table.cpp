// Why a leaf fails, and what it waits for: lockstep_reason.
#include <new>

#include "engine/node_context.h"
#include "leaves/plugin/contract/host.h"

namespace lockstep::host {
namespace {

void say(const lockstep_caller* caller, const char* text) {
  if (caller->is_foreign() || caller->type == nullptr) return;
  take_reason(*caller, Shortened(text == nullptr ? "" : text));
}

}  // namespace

// Where the engine is in another process, the answer of the call takes it there.
void take_reason(const lockstep_caller& caller, const Shortened& text) {
  lockstep_caller& it = mine(&caller);
  if (it.run->node_context != nullptr) {
    return it.run->node_context->say(it.node, *it.slot, text.text());
  }
  if (it.rest == nullptr) it.rest.reset(new (std::nothrow) CallerRest);
  if (it.rest != nullptr) it.rest->reason = text;
}

const lockstep_reason& reason_table() {
  static constexpr lockstep_reason kTable{.struct_size = sizeof(lockstep_reason), .say = say};
  return kTable;
}

}  // namespace lockstep::host
