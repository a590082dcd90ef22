#include "record/use/recorded_joints.h"

#include <utility>

namespace lockstep::host {

std::optional<Joint> RecordedJoints::before(const RecordedTick& tick) {
  const std::size_t resumes = reader_.resumes().size();
  const bool continues = resumes > std::exchange(resumes_, resumes);
  const bool follows = tick.tick == std::exchange(next_, tick.tick + 1);
  if (!follows) return Joint::Lost;
  return continues ? std::optional(Joint::Cut) : std::nullopt;
}

}  // namespace lockstep::host
