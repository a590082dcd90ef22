#include "control.hpp"

namespace nav {

using Status = lockstep::Status;

Status RecoveryNode::tick() {
  while (retries_ <= number_of_retries.get()) {
    if (!recovers_) {
      const Status status = tick_child(kAction);
      if (status == Status::Running) return status;
      if (status != Status::Failure || retries_ == number_of_retries.get()) return finish(status);
    }
    const Status status = tick_child(kRecovery);
    recovers_ = status == Status::Running;
    if (recovers_ || status == Status::Failure) return recovers_ ? status : finish(status);
    if (status == Status::Skipped) return Status::Failure;  // retries_ stays, as in Nav2
    ++retries_;
    if (!may_tick_again_) return Status::Running;
  }
  return finish(Status::Failure);
}

Status RecoveryNode::finish(Status status) {
  forget();
  return status;
}

void RecoveryNode::forget() {
  retries_ = 0;
  recovers_ = false;
}

// A child that runs again, behind which others have been reached already, does not stop those. An
// action that has completed keeps its result until all end.
Status PipelineSequence::tick() {
  bool skips = true;
  for (std::uint32_t child = 0; child < child_count(); ++child) {
    const Status status = tick_child_unreset(child);
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

// Without wrap_around, whatever the last child returns ends the round: a success is a failure, too.
template <bool kWraps>
Status RoundRobin<kWraps>::tick() {
  const std::uint32_t count = this->child_count();
  std::uint32_t skipped = 0;  // in this tick
  for (bool ends = false; !ends && failed_ + skipped < count;) {
    const Status status = this->tick_child_unreset(current_);
    if (status == Status::Running) return status;
    current_ = (current_ + 1) % count;
    ends = current_ == 0 && !this->wrap_around.get();
    failed_ += status == Status::Failure;
    skipped += status == Status::Skipped;
    if (status == Status::Success && !ends) {
      failed_ = 0;
      return status;
    }
  }
  current_ = failed_ = 0;
  return skipped == count ? Status::Skipped : Status::Failure;
}

template class RoundRobin<true>;
template class RoundRobin<false>;

}  // namespace nav
