#include "hallway.hpp"

#include <algorithm>
#include <cmath>

namespace r1sim {
namespace {

// The head sweeps one stripe from left to right, the next from right to left.
double found_at(const HallwayObject& object, double stripe) {
  const double number = std::floor(object.place / stripe);
  const double across = (1 + object.side) / 2;
  const bool is_rightward = std::fmod(number, 2) == 0;
  return stripe * (number + (is_rightward ? across : 1 - across));
}

}  // namespace

void HallwayScene::furnish(const Hallway& hallway) {
  length_ = hallway.length;
  objects_.clear();
  for (std::int64_t i = 0; i < hallway.objects; ++i) {
    HallwayObject object;
    object.place = run_.uniform(0, length_);
    object.side = run_.uniform(-1, 1);
    object.seconds = run_.uniform(hallway.identify_min, hallway.identify_max);
    objects_.push_back(object);
  }
}

void HallwayScene::begin_sweep(const Head& begun) {
  head = begun;
  for (HallwayObject& object : objects_) {
    object.found = std::min(length_, found_at(object, head.stripe));
  }
  std::sort(objects_.begin(), objects_.end(),
            [](const auto& one, const auto& other) { return one.found < other.found; });
  next_ = 0;
  looked_ = 0;
  identified_ = 0;
  missed_ = 0;
}

void HallwayScene::advance() {
  const double seconds = run_.now() - time_;
  time_ = run_.now();
  if (!(seconds > 0)) return;
  if (base.moves) base.traveled = std::min(length_, base.traveled + base.speed * seconds);
  if (head.moves) sweep(seconds);
}

void HallwayScene::sweep(double seconds) {
  for (; next_ < objects_.size(); ++next_) {
    const HallwayObject& object = objects_[next_];
    const double way = object.found - head.swept;
    if (head.speed * seconds < way) break;
    head.swept = object.found;
    seconds -= way / head.speed;
    if (!is_settled(object, seconds)) return;
  }
  head.swept = std::min(length_, head.swept + head.speed * seconds);
}

bool HallwayScene::is_settled(const HallwayObject& object, double& seconds) {
  if (std::abs(object.place - base.traveled) > head.reach) {
    looked_ = 0;
    ++missed_;
    return true;
  }
  looked_ += seconds;
  if (looked_ < object.seconds) return false;
  seconds = looked_ - object.seconds;
  looked_ = 0;
  ++identified_;
  return true;
}

}  // namespace r1sim
