#include "runtime/progress_text.h"

#include <fmt/format.h>

namespace lockstep::host {

std::string out_of_range_text(double reported) {
  return fmt::format(
      "reported the progress {:.6g}: progress is a share from 0 to 1, so it counts as {}", reported,
      reported < 0 ? 0 : 1);
}

std::string went_on_text(double from, double to) {
  return fmt::format("went on while it was held: its progress rose from {:.6g} to {:.6g}", from,
                     to);
}

}  // namespace lockstep::host
