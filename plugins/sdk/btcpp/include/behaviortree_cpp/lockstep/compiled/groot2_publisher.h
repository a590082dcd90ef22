// The functions of loggers/groot2_publisher.h. Included by it.
#pragma once

#include <string>

#include "behaviortree_cpp/lockstep/program.h"
#include "behaviortree_cpp/loggers/groot2_publisher.h"

namespace BT {

LOCKSTEP_BTCPP_INLINE Groot2Publisher::Groot2Publisher(const Tree& tree, unsigned server_port)
    : program_(tree.lockstep_program().weak_from_this()) {
  const std::string address = "0.0.0.0:" + std::to_string(server_port);
  if (!lockstep_run_groot2(tree.lockstep_program().run(), address.c_str())) {
    throw RuntimeError("Groot2Publisher: ", lockstep_last_error());
  }
}
LOCKSTEP_BTCPP_INLINE Groot2Publisher::~Groot2Publisher() {
  if (const auto program = program_.lock()) lockstep_run_groot2(program->run(), nullptr);
}

}  // namespace BT
