// Controls what malloc does with freed memory. Loading a tree allocates several times what it
// keeps, and getting a page from the system costs more than filling it. By default malloc returns
// pages and asks for them again all the time. docs/decisions/loading.md has the numbers.
#pragma once

namespace lockstep::host {

// From now on freed memory stays in the process for later allocations.
void keep_freed_memory();
// Restores the default, and returns free memory to the system.
void return_freed_memory();

}  // namespace lockstep::host
