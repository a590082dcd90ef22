#include "unit/plugin/lab_plugin.h"

#include "support/plugin_tables.h"

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

constexpr lockstep_port with_unit(lockstep_port port) {
  port.unit = "m/s";
  return port;
}

const lockstep_port kPorts[] = {
    with_unit(tables::port(LOCKSTEP_BOOL, LOCKSTEP_INPUT, "flag")),
    tables::port(LOCKSTEP_INT, LOCKSTEP_INOUT, "count"),
    tables::port(LOCKSTEP_DOUBLE, LOCKSTEP_INOUT, "speed"),
    tables::port(LOCKSTEP_STRING, LOCKSTEP_INOUT, "text"),
    tables::port(LOCKSTEP_DOUBLE_LIST, LOCKSTEP_INOUT, "list"),
    tables::port(LOCKSTEP_DOUBLE, LOCKSTEP_INPUT, "limit", "0.5"),
    tables::port(LOCKSTEP_DOUBLE, LOCKSTEP_OUTPUT, "result"),
};
const auto kPortList = tables::list_of(kPorts);
const lockstep_leaf_type kLeaf[] = {[] {
  lockstep_leaf_type type = tables::leaf_type("Lab", create, destroy, tick);
  type.doc = "shows itself";
  tables::set_ports(type, kPortList);
  return type;
}()};
const auto kLeaves = tables::list_of(kLeaf);
const lockstep_plugin kPlugin = [] {
  lockstep_plugin plugin = tables::plugin("lab", kLeaves);
  plugin.init = init;
  plugin.deinit = deinit;
  plugin.create_run = create_run;
  plugin.destroy_run = destroy_run;
  return plugin;
}();

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
