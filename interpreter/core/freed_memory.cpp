#include "core/freed_memory.h"

#include <malloc.h>

#include <limits>

namespace lockstep {

void keep_freed_memory() {
  constexpr int kNever = std::numeric_limits<int>::max();
  ::mallopt(M_TRIM_THRESHOLD, kNever);
  ::mallopt(M_MMAP_THRESHOLD, kNever);  // also large blocks come from what was freed
}

void return_freed_memory() {
  ::malloc_trim(0);
}

}  // namespace lockstep
