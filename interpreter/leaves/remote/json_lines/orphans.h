// Processes that a program has started outlive its guardian, if that is killed, unless another
// process takes them over: this one, where it is the program lockstep. A program that embeds
// lockstep is not made to, since it may have other children to wait for.
#pragma once

#include <sys/types.h>

#include <vector>

namespace lockstep::host {

// From now on, what outlives a guardian becomes a child of this process.
void take_over_orphans();

// The guardian has ended. Kills what it has left to this process, and waits for it: the group of
// the program, and what has left it.
void end_orphans_of(pid_t guardian, pid_t group);

// Those of all threads of this process.
std::vector<pid_t> own_children();

// In the guardian: its number, for the environment of all that the program starts.
void mark_own_orphans();

}  // namespace lockstep::host
