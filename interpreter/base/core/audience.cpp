#include "base/core/audience.h"

#include <utility>

namespace lockstep::host {
namespace {

thread_local bool t_for_program = false;

}  // namespace

ForProgram::ForProgram() : before_(std::exchange(t_for_program, true)) {}

ForProgram::~ForProgram() {
  t_for_program = before_;
}

bool is_for_program() {
  return t_for_program;
}

}  // namespace lockstep::host
