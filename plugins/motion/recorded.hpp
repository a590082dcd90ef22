// The progress of a node, from a recording.
#pragma once

#include <lockstep/leaf.hpp>

#include "curve.hpp"
#include "pace.hpp"
#include "report.hpp"

namespace motion {

// The first activation of a node.
struct RecordedProgress {
  enum class End { Success, Failure, None };  // None: it was halted, or the recording ends before

  Curve ticks, seconds;  // both from its first tick
  End end = End::None;
  // Where it is not in the file as a whole: what a person is told.
  std::string lack = {};
};

// Throws std::runtime_error with file, line and reason.
RecordedProgress read_recording(const std::string& file, const std::string& node);

struct RecordedPorts : lockstep::Ports {
  Input<std::string> file{this, "file", required,
                          "a recording of lockstep run; from the current directory"};
  Input<std::string> node{this, "node", required, "the path of the node in it: Door/pull/arm"};
  Input<std::string> clock{this, "clock", "ticks", kClockDoc};
  ReportPorts report{this};
  ObeyPorts obey{this};
};

class Recorded : public lockstep::Action<RecordedPorts> {
 public:
  Recorded();
  void start() override;
  Status tick() override;
  void pause() override;
  double set_pace(double factor) override;
  double progress() const override;

 private:
  void read(const std::string& from, const std::string& of);
  const Curve& curve() const { return pace_.is_time() ? recorded_.seconds : recorded_.ticks; }

  std::string file_, node_;  // that were read
  RecordedProgress recorded_;
  bool is_told_ = false;  // what it lacks
  Pace pace_;
  Report report_;
  Obey obey_;
};

}  // namespace motion
