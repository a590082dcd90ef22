#include "probe.h"
/* As the libraries of OpenMP and sanitizers have it: its place must be there when the program
 * starts. */
static __thread volatile char much[1 << 20] __attribute__((tls_model("initial-exec")));
static void start(void* leaf) {
  (void)leaf;
  much[0] = 1;
}
#define LEAF_START start
#include "entry.h"
