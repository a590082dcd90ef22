#include "runtime/progress_text.h"

#include <fmt/format.h>

namespace lockstep {

std::string out_of_range_text(double reported) {
  return fmt::format(
      "reported the progress {:.6g}: progress is a share from 0 to 1, so it counts as {}", reported,
      reported < 0 ? 0 : 1);
}

}  // namespace lockstep
