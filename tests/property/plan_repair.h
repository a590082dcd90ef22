// Takes members out of their barriers where a document would be refused.
#pragma once

#include "property/plan.h"

namespace lockstep::host::test {

// "One member only; a member below a member of the same barrier; two members in different children
// of one Sequence or Fallback with `wait`": each of these becomes its child.
void take_out_lonely_members(Plan& plan);
bool has_lonely_members(const Plan& plan);

}  // namespace lockstep::host::test
