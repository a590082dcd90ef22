#include "base/system/freed_memory.h"

#include <malloc.h>

#include <limits>

namespace lockstep::host {

namespace {

// Free memory at the end of the heap that goes back at once; blocks that never come from it.
void set_threshold(int bytes) {
  ::mallopt(M_TRIM_THRESHOLD, bytes);
  ::mallopt(M_MMAP_THRESHOLD, bytes);
}

}  // namespace

void keep_freed_memory() {
  set_threshold(std::numeric_limits<int>::max());
}

void return_freed_memory() {
  constexpr int kDefault = 128 << 10;
  set_threshold(kDefault);
  ::malloc_trim(0);
}

}  // namespace lockstep::host
