#include "verify/same_tick.h"

#include <fmt/format.h>

namespace lockstep::host {
namespace {

std::string_view word(Activity activity) {
  return activity == Activity::Paused ? "held" : to_string(status_of(activity));
}

std::string fault_text(const Ticker& run) {
  const Fault* const fault = run.fault();
  return fault == nullptr ? "no fault"
                          : fmt::format("a fault of '{}'", run.tree().path(fault->node));
}

}  // namespace

std::string difference(const Ticker& run, const Ticker& in_search) {
  if (fault_text(run) != fault_text(in_search)) {
    return fmt::format("there is {}; in the search, {}", fault_text(run), fault_text(in_search));
  }
  if (run.faulted()) return "";
  const Tree& tree = run.tree();
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    if (run.activity(node) != in_search.activity(node)) {
      return fmt::format("'{}' is {}; in the search, it is {}", tree.path(node),
                         word(run.activity(node)), word(in_search.activity(node)));
    }
    if (has_ended(run.status(node))) node = run.end_of(node) - 1;
  }
  return "";
}

}  // namespace lockstep::host
