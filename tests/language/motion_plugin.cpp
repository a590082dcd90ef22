#include <lockstep/leaf.hpp>

#include "language/robot_plugin.h"

#undef LOCKSTEP_PLUGIN
#define LOCKSTEP_PLUGIN(...) LOCKSTEP_PLUGIN_TABLE(shipped_motion_plugin, __VA_ARGS__)
#include "../../plugins/motion/motion.cpp"
#include "../../plugins/motion/profile.cpp"
#include "../../plugins/motion/recorded.cpp"
#include "../../plugins/motion/unpacked.cpp"

namespace lockstep::host::test {

const lockstep_plugin& motion_plugin() {
  return shipped_motion_plugin;
}

}  // namespace lockstep::host::test
