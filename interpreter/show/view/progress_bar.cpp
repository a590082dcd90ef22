#include "show/view/progress_bar.h"

#include <string_view>

#include "base/core/progress.h"

namespace lockstep::host {
namespace {

struct Signs {
  std::string_view done, band, rest, mark;
};

constexpr Signs kAsciiSigns{"#", "=", ".", "|"};
constexpr Signs kUnicodeSigns{"█", "▒", "░", "┃"};

}  // namespace

std::string to_text(const ProgressBar& bar, bool unicode) {
  const Signs& signs = unicode ? kUnicodeSigns : kAsciiSigns;
  const auto cell_of = [&](double progress) {
    return static_cast<std::size_t>(progress * static_cast<double>(bar.cells) + kProgressEpsilon);
  };
  std::string text = "[";
  for (std::size_t cell = 0; cell < bar.cells; ++cell) {
    std::string_view sign = signs.rest;
    if (cell >= cell_of(bar.band_begin) && cell < cell_of(bar.band_end)) sign = signs.band;
    if (cell < cell_of(bar.progress)) sign = signs.done;
    for (const double mark : bar.marks) {
      if (cell == cell_of(mark)) sign = signs.mark;
    }
    text += sign;
  }
  return text + "]";
}

}  // namespace lockstep::host
