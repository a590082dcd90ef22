#include "leaves/remote/shared_memory/host_log.h"

#include <sys/eventfd.h>

namespace lockstep::host {

void HostLog::write(std::uint32_t caller, lockstep_log_level level, std::string_view text) {
  if (std::this_thread::get_id() == server_) {
    const bool fills_up = calls_.append(caller, level, text);
    if (!fills_up) return;
  } else {
    threads_.append(caller, level, text);
  }
  eventfd_write(bell_, 1);  // which the host may have missed already
}

}  // namespace lockstep::host
