// A progress over time, as points with straight lines between them.
#pragma once

#include <algorithm>
#include <vector>

namespace motion {

struct Point {
  double at = 0;  // rising
  double progress = 0;
};

class Curve {
 public:
  Curve() = default;
  explicit Curve(std::vector<Point> points) : points_(std::move(points)) {}

  bool empty() const { return points_.empty(); }
  double end() const { return points_.back().at; }

  // Before the first point as there, after the last one as there.
  double progress(double at) const {
    const auto after =
        std::upper_bound(points_.begin(), points_.end(), at,
                         [](double value, const Point& point) { return value < point.at; });
    if (after == points_.begin()) return after->progress;
    if (after == points_.end()) return points_.back().progress;
    const Point& before = *(after - 1);
    const double part = (at - before.at) / (after->at - before.at);
    return before.progress + part * (after->progress - before.progress);
  }

 private:
  std::vector<Point> points_;
};

}  // namespace motion
