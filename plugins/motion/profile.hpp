// A progress that is known in advance, which other actions can follow.
#pragma once

#include <lockstep/leaf.hpp>

#include <algorithm>

#include "curve.hpp"
#include "pace.hpp"
#include "report.hpp"

namespace motion {

struct ProfilePorts : lockstep::Ports {
  Input<std::string> shape{this, "shape", "line", "line, or sigmoid: slow, fast, slow"};
  Input<double> step{this, "step", "0.001",
                     "1 / the number of ticks, or of seconds, from 0 to 1; of ticks in (0, 1]"};
  Input<std::vector<double>> points{
      this, "points", "",
      "instead of shape and step: when, and the progress there, as 0 0;5 0.2;10 1, with straight "
      "lines in between; the progress ends at 1"};
  Input<std::string> clock{this, "clock", "ticks", kClockDoc};
  ReportPorts report{this};
  ObeyPorts obey{this};
};

class Profile : public lockstep::Action<ProfilePorts> {
 public:
  void start() override;
  Status tick() override;
  void pause() override;
  double set_pace(double factor) override;
  double progress() const override;

 private:
  // Ticks or seconds after its start.
  double progress_at(double elapsed) const;
  double position(double elapsed) const { return std::min(1.0, elapsed * step_); }

  Pace pace_;
  Report report_;
  Obey obey_;
  Curve curve_;  // of points
  double step_ = 0;
  bool is_sigmoid_ = false;
};

}  // namespace motion
