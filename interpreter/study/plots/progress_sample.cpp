#include "study/plots/progress_sample.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace lockstep::host {
namespace {

constexpr std::size_t kPerLine = 4;

template <class Choose>
void choose(ProgressSample& into, const ProgressSample& from, Choose which) {
  into.least = which(into.least, from.least);
  const auto choose_each = [&](std::vector<double>& to, const std::vector<double>& values) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = which(to[i], values[i]);
  };
  choose_each(into.progress, from.progress);
  choose_each(into.factor, from.factor);
}

// How long it is held in all of them stands in the first.
void gather_held(std::span<ProgressSample> line) {
  ProgressSample& first = line.front();
  for (std::size_t child = 0; child < first.held_until.size(); ++child) {
    double until = first.time;
    for (const ProgressSample& sample : line) {
      // Held without a break, there is nothing to add up, and nothing to round.
      const double held = sample.held_until[child];
      if (held > sample.time) until = until == sample.time ? held : until + (held - sample.time);
    }
    first.held_until[child] = until;
  }
}

// Where between first and last the least and the most stand is all the same: it is one column.
void thin_line(std::span<ProgressSample> line, std::vector<ProgressSample>& to) {
  if (line.size() > kPerLine) {
    ProgressSample least = line[1], most = line[2];
    for (const ProgressSample& sample : line) {
      choose(least, sample, [](double a, double b) { return std::min(a, b); });
      choose(most, sample, [](double a, double b) { return std::max(a, b); });
    }
    gather_held(line);
    line[1] = std::move(least);
    line[2] = std::move(most);
    line[3] = std::move(line.back());
    for (std::size_t at = 1; at < kPerLine; ++at) {
      line[at].begins = false;
      std::ranges::fill(line[at].held_until, line[at].time);
    }
    line = line.first(kPerLine);
  }
  std::ranges::move(line, std::back_inserter(to));
}

// Where one activation ends and the next begins there is no line. With more of them in a column
// nobody sees it.
void thin_column(std::span<ProgressSample> column, std::vector<ProgressSample>& to) {
  const auto begins = [](const ProgressSample& sample) { return sample.begins; };
  const auto second = std::find_if(column.begin() + 1, column.end(), begins);
  const bool is_last = second == column.end() || std::none_of(second + 1, column.end(), begins);
  const auto first_line = is_last ? second - column.begin() : column.end() - column.begin();
  thin_line(column.first(static_cast<std::size_t>(first_line)), to);
  thin_line(column.subspan(static_cast<std::size_t>(first_line)), to);
}

}  // namespace

void thin(std::vector<ProgressSample>& samples, std::size_t columns) {
  if (samples.empty()) return;
  const double begin = samples.front().time;
  const double width = (samples.back().time - begin) / static_cast<double>(columns);
  const auto column_of = [&](const ProgressSample& sample) {
    const double last = static_cast<double>(columns) - 1;
    return width > 0 ? std::clamp(std::floor((sample.time - begin) / width), 0.0, last) : 0.0;
  };
  std::vector<ProgressSample> thinned;
  for (auto first = samples.begin(); first != samples.end();) {
    const double column = column_of(*first);
    const auto last = std::find_if(first, samples.end(), [&](const ProgressSample& sample) {
      return column_of(sample) > column;  // what goes back in time stays where it is
    });
    thin_column(std::span(first, last), thinned);
    first = last;
  }
  samples = std::move(thinned);
}

}  // namespace lockstep::host
