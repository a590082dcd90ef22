// What becomes of memory that has been freed. Loading a tree makes and frees several times what it
// keeps, and to get a page anew from the system costs more than to fill it: by default malloc hands
// back and asks again all the time. For who loads; the numbers are in docs/performance.md.
#pragma once

namespace lockstep {

// From now on freed memory stays with the process, for what is allocated next.
void keep_freed_memory();
// No longer; and what is free now goes back to the system.
void return_freed_memory();

}  // namespace lockstep
