#include "control.hpp"

namespace nav {

using Status = lockstep::Status;

void RecoveryNode::start() {
  retries_ = 0;
  recovering_ = false;
}

Status RecoveryNode::tick() {
  if (recovering_) return recover();
  const Status status = tick_child(kAction);
  if (status != Status::Failure) return status;
  if (retries_ >= number_of_retries.get()) return Status::Failure;
  return recover();
}

Status RecoveryNode::recover() {
  const Status status = tick_child(kRecovery);
  recovering_ = status == Status::Running;
  const bool none = status == Status::Failure || status == Status::Skipped;
  if (none) return Status::Failure;
  if (status == Status::Success) ++retries_;
  return Status::Running;  // the action is tried again in the next tick
}

// A child that runs again, behind which others have been reached already, does not stop those.
Status PipelineSequence::tick() {
  bool skips = true;
  for (std::uint32_t child = 0; child < child_count(); ++child) {
    const Status status = tick_child(child);
    if (status == Status::Failure) return status;
    if (status == Status::Running && child >= furthest_) {
      furthest_ = child;
      return status;
    }
    skips = skips && status == Status::Skipped;
  }
  return skips ? Status::Skipped : Status::Success;
}

// The progress of the furthest child, as in a Sequence with memory.
double PipelineSequence::progress() const {
  return (furthest_ + child_progress(furthest_)) / child_count();
}

Status RoundRobin::tick() {
  while (!is_exhausted()) {
    const Status status = tick_child(current_);
    if (status == Status::Running) return status;
    ++current_;
    if (wrap_around.get()) current_ %= child_count();
    if (status == Status::Success) return status;
    skipped_ += status == Status::Skipped;
    ++passed_;
  }
  current_ = 0;
  const bool skips = passed_ > 0 && skipped_ == passed_;
  return skips ? Status::Skipped : Status::Failure;
}

bool RoundRobin::is_exhausted() const {
  return current_ >= child_count() || passed_ >= child_count();
}

}  // namespace nav
