#include "embedding/warnings.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "trace/progress_text.h"

namespace lockstep::host {

Warnings::Warnings(const Tree& tree, LeafLog log) : tree_(tree), log_(std::move(log)) {}

void Warnings::tell(const Ticker& ticker, std::span<const Fault> faults, std::uint64_t tick) {
  if (!log_) return;
  const auto warn = [this](NodeIndex node, const std::string& text) {
    log_(tree_.path(node), LOCKSTEP_LOG_WARNING, text);
  };
  for (const Fault& it : faults) {
    warn(it.node, it.in_last_halt
                      ? fmt::format("could not be halted: {}", it.message)
                      : fmt::format("failed in tick {}: {}; counted as Failure", tick, it.message));
  }
  const auto all = ticker.out_of_range();
  for (; out_of_range_ < all.size(); ++out_of_range_) {
    warn(all[out_of_range_].node, out_of_range_text(all[out_of_range_].reported));
  }
  const auto went_on = ticker.went_on();
  for (; went_on_ < went_on.size(); ++went_on_) {
    const WentOn& it = went_on[went_on_];
    warn(it.node, went_on_text(it.from, it.to));
  }
}

}  // namespace lockstep::host
