#include "trace/progress_text.h"

#include <fmt/format.h>

namespace lockstep::host {

std::string out_of_range_text(double reported) {
  return fmt::format(
      "reported the progress {:.6g}: progress is a share from 0 to 1, so it counts as {}", reported,
      reported < 0 ? 0 : 1);
}

std::string went_on_text(double from, double to) {
  return fmt::format("continued while it was held: its progress rose from {:.6g} to {:.6g}", from,
                     to);
}

std::string heard_text(double progress, Nanoseconds age) {
  return fmt::format("heard at {:.2f}, {:.2f} s ago", progress, to_seconds(age));
}

std::string over_budget_text(PluginFunction function, Nanoseconds took, Nanoseconds budget) {
  return fmt::format("took {:.3f} ms in {}, more than the budget of {:.3f} ms",
                     to_seconds(took) * 1e3, name_of(function), to_seconds(budget) * 1e3);
}

}  // namespace lockstep::host
