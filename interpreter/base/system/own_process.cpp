#include "base/system/own_process.h"

#include <pthread.h>

namespace lockstep::host {

OwnProcess::OwnProcess() {
  static const int kIsRegistered = pthread_atfork(nullptr, nullptr, [] { ++s_forks; });
  static_cast<void>(kIsRegistered);
  forks_ = s_forks;
}

}  // namespace lockstep::host
