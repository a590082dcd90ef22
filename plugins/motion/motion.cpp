// Actions that do nothing but make progress: to try trees, and to give others a pace to keep.
#include <lockstep/leaf.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace {

constexpr double kDone = 1 - 1e-9;  // ten steps of 0.1 are one

struct AdvancePorts : lockstep::Ports {
  Input<double> step{this, "step", "0.01", "progress per tick; may be negative"};
  Input<double> noise{this, "noise", "0", "each tick adds step + uniform(-noise, noise)"};
};

class Advance : public lockstep::Action<AdvancePorts> {
 public:
  void start() override { progress_ = 0; }

  Status tick() override {
    const double half_width = noise.get();
    const double change = step.get() + uniform(-half_width, half_width);
    progress_ = std::clamp(progress_ + change, 0.0, 1.0);
    return progress_ >= kDone ? Status::Success : Status::Running;
  }

  double progress() const override { return progress_; }

 private:
  double progress_ = 0;
};

struct ProfilePorts : lockstep::Ports {
  Input<std::string> shape{this, "shape", "line", "line, or sigmoid: slow, fast, slow"};
  Input<double> step{this, "step", "0.001", "1 / the number of ticks from 0 to 1; in (0, 1]"};
};

// The logistic curve, shifted and scaled so that it goes through (0, 0) and (1, 1).
double sigmoid(double x) {
  constexpr double kSteepness = 10;
  const auto logistic = [](double t) { return 1 / (1 + std::exp(-kSteepness * (t - 0.5))); };
  return (logistic(x) - logistic(0)) / (logistic(1) - logistic(0));
}

class Profile : public lockstep::Action<ProfilePorts> {
 public:
  void start() override {
    ticks_ = 0;
    step_ = step.get();
    if (!(step_ > 0 && step_ <= 1)) throw std::runtime_error("port 'step' is not in (0, 1]");
    is_sigmoid_ = shape.view() == "sigmoid";
    if (!is_sigmoid_ && shape.view() != "line") {
      throw std::runtime_error("port 'shape' is neither 'line' nor 'sigmoid'");
    }
  }

  Status tick() override {
    ++ticks_;
    return position() >= kDone ? Status::Success : Status::Running;
  }

  double progress() const override { return is_sigmoid_ ? sigmoid(position()) : position(); }

 private:
  double position() const { return std::min(1.0, static_cast<double>(ticks_) * step_); }

  std::int64_t ticks_ = 0;
  double step_ = 0;
  bool is_sigmoid_ = false;
};

struct ReplanPorts : lockstep::Ports {
  Input<std::vector<double>> first{this, "first", required, "the barriers at the beginning"};
  Input<std::vector<double>> second{this, "second", required, "the barriers after that"};
  Input<double> after{this, "after", "1", "when the second list replaces the first", "s"};
  Output<std::vector<double>> barriers{this, "barriers", "the barriers that count now"};
};

class Replan : public lockstep::Action<ReplanPorts> {
 public:
  void start() override {
    start_ = now();
    barriers.set(first.get());
  }

  Status tick() override {
    if (now() - start_ < after.get()) return Status::Running;
    barriers.set(second.get());
    return Status::Success;
  }

 private:
  double start_ = 0;
};

}  // namespace

LOCKSTEP_PLUGIN("motion", "1.0", "Actions that do nothing but make progress",
                lockstep::leaf<Advance>(
                    "Advance",
                    "Moves on by a step, give or take a noise, in each tick that it receives; "
                    "Success when its progress reaches 1."),
                lockstep::leaf<Profile>(
                    "Profile",
                    "A progress to keep pace with, rising from 0 to 1 in 1 / step ticks. At x = "
                    "ticks * step, line is x, sigmoid is (s(x) - s(0)) / (s(1) - s(0)) with s(x) = "
                    "1 / (1 + exp(-10 (x - 0.5)))."),
                lockstep::leaf<Replan>(
                    "Replan",
                    "Stands for a planner that changes its mind: writes a list of barriers, and "
                    "after a time another one; then Success."));
