// Actions that do nothing but make progress: to try trees, and to give others a pace to keep.
#include <lockstep/leaf.hpp>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "profile.hpp"
#include "recorded.hpp"
#include "report.hpp"

namespace motion {

struct AdvancePorts : lockstep::Ports {
  Input<double> step{this, "step", "0.01", "progress per tick; may be negative"};
  Input<double> noise{this, "noise", "0", "each tick adds step + uniform(-noise, noise)"};
  Input<std::string> noise_per{this, "noise_per", "tick",
                               "tick, or run: the noise is drawn once, and the pace is constant"};
  ReportPorts report{this};
  ObeyPorts obey{this};
  Output<double> actual{this, "actual", "its progress after each tick, neither late nor in steps"};
};

struct AdvanceState {
  double progress = 0;
};

class Advance : public lockstep::ProgressAction<AdvancePorts>, public lockstep::Kept<AdvanceState> {
 public:
  void start() override { begin(); }
  lockstep::AfterCut after_cut(const lockstep::Cut&) override {
    begin();
    set_progress(kept.progress);
    return lockstep::AfterCut::Continues;
  }

  Status tick() override {
    if (report_.is_late()) report_.sample(now(), kept.progress);
    double change = is_noisy_ ? step.get() + drawn() : step.get();
    if (obey_.is_told()) [[unlikely]]
      change *= obey_.factor(now());
    kept.progress = std::clamp(kept.progress + change, 0.0, 1.0);
    actual.set(kept.progress);
    set_progress(kept.progress);
    return kept.progress >= kDone ? Status::Success : Status::Running;
  }

  void pause() override { report_.sample(now(), kept.progress); }
  double set_pace(double factor) override { return obey_.set(factor, now()); }
  double progress() const override {
    return report_.of_ticks(report_.is_late() ? now() : 0, kept.progress);
  }

 private:
  void begin() {
    report_.start(report);
    obey_.start(obey);
    is_constant_ = noise_per.view() == "run";
    if (!is_constant_ && noise_per.view() != "tick") {
      throw std::runtime_error("port 'noise_per' is neither 'tick' nor 'run'");
    }
    if (is_constant_ && !of_run_) of_run_ = uniform(-1, 1);
    is_noisy_ = !noise.is_constant() || noise.get() != 0;
  }

  double drawn() {
    const double half_width = noise.get();
    return is_constant_ ? half_width * *of_run_ : uniform(-half_width, half_width);
  }
  bool keeps_progress() const override { return report.is_plain(); }

  Report report_;
  Obey obey_;
  bool is_constant_ = false;
  bool is_noisy_ = true;          // false: it never is, so that no number is drawn
  std::optional<double> of_run_;  // in [-1, 1)
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

}  // namespace motion

LOCKSTEP_PLUGIN("motion", "1.0", "Actions that do nothing but make progress",
                lockstep::leaf<motion::Advance>(
                    "Advance",
                    "Moves on by a step, give or take a noise, in each tick that it receives; "
                    "Success when its progress reaches 1."),
                lockstep::leaf<motion::Profile>(
                    "Profile",
                    "A progress to keep pace with, from 0 to 1. With t = the ticks that it "
                    "received, or with clock=time the seconds since its start, and x = t * step: "
                    "line is x, sigmoid is (s(x) - s(0)) / (s(1) - s(0)) with s(x) = 1 / (1 + "
                    "exp(-10 (x - 0.5))), and points are its own values at times t."),
                lockstep::leaf<motion::Recorded>(
                    "Recorded",
                    "Plays the progress of a node as a recording has it, from the first tick of "
                    "the node to its end. Success or Failure as the node; it runs on where the "
                    "node was halted or the recording ends."),
                lockstep::leaf<motion::Replan>(
                    "Replan",
                    "Stands for a planner that changes its mind: writes a list of barriers, and "
                    "after a time another one; then Success."));
