#include "lockstep/leaf.h"
static bool init(const lockstep_host* host, const lockstep_caller* caller) {
  double number = 0;
  const bool has_nothing = !host->get_double(caller, 0, &number) && host->now(caller) == 0;
  host->log(caller, LOCKSTEP_LOG_INFO, "nobody listens yet");
  host->set_error(caller, has_nothing ? "no license" : "has ports or time");
  return true;
}
#define PLUGIN_INIT init
#include "entry.h"
