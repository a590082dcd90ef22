#include "base/core/audience.h"

#include <fmt/format.h>

#include <utility>

#include "base/core/wording.h"

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

std::string how_to_give(std::string_view entry) {
  return worded(fmt::format("give it a value with --set {}=…", brief(entry)),
                std::string("give it a start value"));
}

}  // namespace lockstep::host
