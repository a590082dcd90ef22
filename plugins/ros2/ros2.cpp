// The plugin ros2: docs/ros2.md.
#include <lockstep/leaf.h>

#include <cstring>
#include <string>
#include <vector>

#include "middleware.hpp"
#include "named_leaves.hpp"
#include "ros_action.hpp"
#include "ros_lifecycle.hpp"
#include "ros_parameter.hpp"
#include "ros_service.hpp"
#include "ros_topics.hpp"
#include "run_end.hpp"
#include "time_source.hpp"

namespace {

bool init(const lockstep_host* host, const lockstep_caller* caller) {
  const std::string why = ros2::Middleware::get().start();
  if (!why.empty()) host->set_error(caller, ("ROS 2 does not start: " + why).c_str());
  return why.empty();
}

void deinit() {
  ros2::Middleware::get().stop();
}

void* create_run(const lockstep_host* /*host*/, const lockstep_caller* /*caller*/) {
  return new ros2::RunEnd;
}

void destroy_run(void* run) {
  delete static_cast<ros2::RunEnd*>(run);
}

const void* get_extension(const char* id) {
  return std::strcmp(id, LOCKSTEP_CLOCK) == 0 ? &ros2::ros_clock() : nullptr;
}

const lockstep_plugin* describe(const char** /*why*/);

constexpr lockstep_plugin plugin_of(std::uint32_t count, const lockstep_leaf_type* const* types) {
  lockstep_plugin plugin{};
  plugin.abi_major = LOCKSTEP_ABI_MAJOR;
  plugin.abi_minor = LOCKSTEP_ABI_MINOR;
  plugin.struct_size = sizeof plugin;
  plugin.name = "ros2";
  plugin.version = "1.0.0";
  plugin.doc = "Every action, service and topic of ROS 2 as a leaf.";
  plugin.leaf_type_count = count;
  plugin.leaf_types = types;
  plugin.init = init;
  plugin.deinit = deinit;
  plugin.create_run = create_run;
  plugin.destroy_run = destroy_run;
  plugin.get_extension = get_extension;
  if (count == 0) plugin.describe = describe;
  return plugin;
}

// The tables of leaf types are made when the plugin is opened.
const lockstep_plugin* describe(const char** why) {
  static std::vector<const lockstep_leaf_type*> types = {
      &ros2::ros_action(),  &ros2::ros_service(),   &ros2::ros_publish(),
      &ros2::ros_receive(), &ros2::ros_parameter(), &ros2::ros_lifecycle()};
  static const std::string wrong = ros2::read_named_leaves({{"action", &ros2::ros_action()},
                                                            {"service", &ros2::ros_service()},
                                                            {"topic", &ros2::ros_receive()}},
                                                           types);
  if (!wrong.empty()) {
    *why = wrong.c_str();
    return nullptr;
  }
  static const lockstep_plugin plugin =
      plugin_of(static_cast<std::uint32_t>(types.size()), types.data());
  return &plugin;
}

}  // namespace

extern "C" {
const lockstep_plugin lockstep_plugin_entry = plugin_of(0, nullptr);
}
