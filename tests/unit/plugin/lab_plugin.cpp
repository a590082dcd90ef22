#include "unit/plugin/lab_plugin.h"

namespace lockstep::host::test {
namespace {

void* create(const lockstep_host* host, const lockstep_caller* caller, void* context) {
  const std::size_t index = lab.leaves.size();
  lab.events.push_back("create " + std::to_string(index) + (context == &lab ? "" : " without run"));
  lab.leaves.push_back(caller);
  if (index == lab.leaf_that_fails) {
    host->set_error(caller, "no arm");
    return nullptr;
  }
  return new std::size_t(index);
}

void destroy(void* leaf) {
  const auto* index = static_cast<std::size_t*>(leaf);
  lab.events.push_back("destroy " + std::to_string(*index));
  delete index;
}

lockstep_status tick(void*) {
  return LOCKSTEP_SUCCESS;
}

bool init(const lockstep_host*, const lockstep_caller*) {
  lab.events.emplace_back("init");
  return true;
}
void deinit() {
  lab.events.emplace_back("deinit");
}

void* create_run(const lockstep_host* host, const lockstep_caller* caller) {
  lab.events.emplace_back("create run");
  lab.host = host;
  lab.run = caller;
  if (lab.run_error != nullptr) host->set_error(caller, lab.run_error);
  return &lab;
}
void destroy_run(void* context) {
  lab.events.emplace_back(context == &lab ? "destroy run" : "destroy something else");
}

constexpr lockstep_port port(const char* name, lockstep_type type, lockstep_direction direction,
                             const char* default_value = nullptr) {
  return {sizeof(lockstep_port),
          type,
          direction,
          name,
          default_value,
          "m/s",
          nullptr,
          nullptr,
          0,
          0,
          nullptr,
          0};
}

const lockstep_port kPorts[] = {
    port("flag", LOCKSTEP_BOOL, LOCKSTEP_INPUT),
    port("count", LOCKSTEP_INT, LOCKSTEP_INOUT),
    port("speed", LOCKSTEP_DOUBLE, LOCKSTEP_INOUT),
    port("text", LOCKSTEP_STRING, LOCKSTEP_INOUT),
    port("list", LOCKSTEP_DOUBLE_LIST, LOCKSTEP_INOUT),
    port("limit", LOCKSTEP_DOUBLE, LOCKSTEP_INPUT, "0.5"),
    port("result", LOCKSTEP_DOUBLE, LOCKSTEP_OUTPUT),
};
const lockstep_port* const kPortList[] = {&kPorts[0], &kPorts[1], &kPorts[2], &kPorts[3],
                                          &kPorts[4], &kPorts[5], &kPorts[6]};
const lockstep_leaf_type kLeaf = {sizeof(lockstep_leaf_type),
                                  LOCKSTEP_ACTION,
                                  "Lab",
                                  "shows itself",
                                  std::size(kPortList),
                                  kPortList,
                                  create,
                                  destroy,
                                  nullptr,
                                  tick,
                                  nullptr,
                                  nullptr,
                                  nullptr,
                                  nullptr,
                                  nullptr,
                                  0,
                                  0,
                                  0,
                                  nullptr};
const lockstep_leaf_type* const kLeaves[] = {&kLeaf};
const lockstep_plugin kPlugin = {LOCKSTEP_ABI_MAJOR,
                                 LOCKSTEP_ABI_MINOR,
                                 sizeof(lockstep_plugin),
                                 "lab",
                                 nullptr,
                                 nullptr,
                                 1,
                                 kLeaves,
                                 init,
                                 deinit,
                                 create_run,
                                 destroy_run,
                                 nullptr,
                                 nullptr};

}  // namespace

const lockstep_plugin& lab_plugin() {
  return kPlugin;
}

Tree lab_tree(const NodeType& type, std::uint32_t leaves) {
  Tree tree;
  tree.id = "Test";
  tree.labels.push_back({"root", nullptr, 0});
  tree.constants = {Value(true), Value(0.5)};
  tree.slots = {{"count", ValueType::Int, {}},
                {"speed", ValueType::Double, Value(1.5)},
                {"text", ValueType::String, Value("hello")},
                {"list", ValueType::DoubleList, Value(std::vector{1.0, 2.0, 3.0})}};
  for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) {
    constexpr std::string_view kNames[] = {"lab0", "lab1", "lab2", "lab3",
                                           "lab4", "lab5", "lab6", "lab7"};
    tree.leaves.push_back({leaf + 1, &type, static_cast<std::uint32_t>(tree.ports.size())});
    tree.labels.push_back({kNames[leaf], &type, 0});
    tree.ports.push_back({.constant = 0});
    for (std::uint32_t slot = 0; slot < 4; ++slot) tree.ports.push_back({.slot = slot});
    tree.ports.push_back({.constant = 1});
    tree.ports.push_back({});
  }
  return tree;
}

}  // namespace lockstep::host::test
