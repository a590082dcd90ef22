#include "study/plots/plot_style.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/core/diagnostics.h"
#include "base/core/utf8.h"
#include "study/plots/gnuplot.h"

namespace lockstep::host {
namespace {

constexpr int kLargest = 15, kSmallest = 10;  // pixels of a letter
constexpr double kTitleWidth = 0.85;          // of the picture's

// The longest end of at most `most` columns; it begins with a whole character.
std::string_view end_of(std::string_view text, std::size_t most) {
  for (std::size_t left = columns(text); left > most;) {
    const Character first = first_character(text);
    left -= columns(first.code);
    text.remove_prefix(first.bytes);
  }
  return text;
}

// Where the second line begins: after a blank, a slash or the like, so that neither line is too
// long; else where the first is full.
std::size_t second_line(std::string_view text, std::size_t most) {
  std::size_t place = 0;
  for (std::size_t at = 1; at < text.size(); ++at) {
    if (std::string_view(" /_-").find(text[at - 1]) == std::string_view::npos) continue;
    if (columns(text.substr(0, at)) <= most && columns(text.substr(at)) <= most) place = at;
  }
  return place > 0 ? place : text.size() - end_of(text, most).size();
}

}  // namespace

int letter_height(PlotSize size) {
  const PlotSize usual;
  const double scale = std::min(static_cast<double>(size.width) / usual.width,
                                static_cast<double>(size.height) / usual.height);
  return std::clamp(static_cast<int>(std::lround(kLargest * scale)), kSmallest, kLargest);
}

std::size_t letters_in(double pixels, int height) {
  constexpr double kLetterWidth = 0.55;  // of its height, on average
  return std::max<std::size_t>(static_cast<std::size_t>(pixels / (kLetterWidth * height)), 4);
}

std::string shortened(std::string_view text, std::size_t most) {
  const std::string visible = printable(text);
  if (columns(visible) <= most) return visible;
  return "…" + std::string(end_of(visible, most - 1));
}

std::string plot_title(std::string_view text, PlotSize size) {
  const std::size_t most = letters_in(kTitleWidth * size.width, letter_height(size));
  const std::string all = shortened(text, 2 * most - most / 6);  // to break where words end
  if (columns(all) <= most) return gnuplot_string(all);
  const std::size_t second = second_line(all, most);
  const std::size_t end_of_first = all.find_last_not_of(' ', second - 1) + 1;
  return fmt::format("{}.\"\\n\".{}", gnuplot_string(std::string_view(all).substr(0, end_of_first)),
                     gnuplot_string(std::string_view(all).substr(second)));
}

}  // namespace lockstep::host
