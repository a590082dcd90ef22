// A plugin over leaf.h that brings its own C++ runtime, and throws.
#include <lockstep/leaf.h>

#include <stdexcept>

namespace {

void* create(const lockstep_host* /*host*/, const lockstep_caller* /*caller*/, void* /*run*/) {
  static int leaf = 0;
  return &leaf;
}
void destroy(void* /*leaf*/) {}
lockstep_status tick(void* /*leaf*/) {
  throw std::runtime_error("the gripper is gone");
}

constexpr lockstep_leaf_type kThrows = [] {
  lockstep_leaf_type type{};
  type.struct_size = sizeof type;
  type.kind = LOCKSTEP_ACTION;
  type.id = "Throws";
  type.create = create;
  type.destroy = destroy;
  type.tick = tick;
  return type;
}();
const lockstep_leaf_type* const kTypes[] = {&kThrows};

constexpr lockstep_plugin entry() {
  lockstep_plugin plugin{};
  plugin.abi_major = LOCKSTEP_ABI_MAJOR;
  plugin.abi_minor = LOCKSTEP_ABI_MINOR;
  plugin.struct_size = sizeof plugin;
  plugin.name = "static_runtime";
  plugin.leaf_type_count = 1;
  plugin.leaf_types = kTypes;
  return plugin;
}

}  // namespace

extern "C"
    __attribute__((visibility("default"))) constinit const lockstep_plugin lockstep_plugin_entry =
        entry();
