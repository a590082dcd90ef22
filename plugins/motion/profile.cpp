#include "profile.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace motion {
namespace {

// The logistic curve, shifted and scaled so that it goes through (0, 0) and (1, 1).
double sigmoid(double x) {
  constexpr double kSteepness = 10;
  const auto logistic = [](double t) { return 1 / (1 + std::exp(-kSteepness * (t - 0.5))); };
  return (logistic(x) - logistic(0)) / (logistic(1) - logistic(0));
}

[[noreturn]] void refuse(const char* why) {
  throw std::runtime_error(std::string("port 'points' ") + why);
}

Curve curve_of(lockstep::ListView numbers) {
  if (numbers.size() % 2 != 0) refuse("is not a list of pairs: when, and the progress there");
  std::vector<Point> points;
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    const Point point{numbers[i], numbers[i + 1]};
    if (point.at < (points.empty() ? 0 : points.back().at)) refuse("goes back in time");
    if (!points.empty() && point.at == points.back().at) refuse("has two points at one time");
    if (!(point.progress >= 0 && point.progress <= 1)) refuse("has a progress outside of [0, 1]");
    points.push_back(point);
  }
  if (!points.empty() && points.back().progress < kDone) refuse("does not end at progress 1");
  return Curve(std::move(points));
}

}  // namespace

void Profile::start() {
  pace_.start(clock.view(), now());
  report_.start(report);
  obey_.start(obey);
  curve_ = curve_of(points.view());
  step_ = step.get();
  const double most = pace_.is_time() ? std::numeric_limits<double>::max() : 1;
  if (!(step_ > 0 && step_ <= most)) throw std::runtime_error("port 'step' is not in (0, 1]");
  is_sigmoid_ = shape.view() == "sigmoid";
  if (!is_sigmoid_ && shape.view() != "line") {
    throw std::runtime_error("port 'shape' is neither 'line' nor 'sigmoid'");
  }
}

Profile::Status Profile::tick() {
  report_.sample(now(), progress_at(pace_.elapsed(now())));
  pace_.tick(obey_.is_told() ? obey_.factor(now()) : 1);
  const bool done = curve_.empty() ? position(pace_.elapsed(now())) >= kDone
                                   : pace_.has_reached(curve_.end(), now());
  return done ? Status::Success : Status::Running;
}

// What moves in time does so whatever it is told.
double Profile::set_pace(double factor) {
  return pace_.is_time() ? 1.0 : obey_.set(factor, now());
}

void Profile::pause() {
  report_.sample(now(), progress_at(pace_.elapsed(now())));
}

double Profile::progress() const {
  return report_.of(pace_, now(), [this](double elapsed) { return progress_at(elapsed); });
}

double Profile::progress_at(double elapsed) const {
  if (!curve_.empty()) return curve_.progress(elapsed);
  return is_sigmoid_ ? sigmoid(position(elapsed)) : position(elapsed);
}

}  // namespace motion
