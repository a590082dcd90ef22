#include "run/fuse.h"

#include <sys/syscall.h>
#include <unistd.h>

#include "base/system/signal_mask.h"

namespace lockstep::host {
namespace {

WayToEnd g_fuse_end;

}  // namespace

void light_fuse(unsigned seconds, WayToEnd end) {
  g_fuse_end = end;
  struct sigaction action {};
  action.sa_handler = [](int) { end_at_once(g_fuse_end); };
  sigaction(SIGALRM, &action, nullptr);
  unblock(signal_set({SIGALRM}));
  alarm(seconds);
}

void end_at_once(int exit_code) {
  while (true) syscall(SYS_exit_group, exit_code);
}

void end_at_once(WayToEnd end) {
  if (end.signal != 0) {
    signal(end.signal, SIG_DFL);
    unblock(signal_set({end.signal}));
    raise(end.signal);
  }
  end_at_once(end.exit_code);
}

}  // namespace lockstep::host
