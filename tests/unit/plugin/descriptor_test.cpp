// Descriptors as node types, and structs that are shorter than this host's.
#include "leaves/plugin/contract/descriptor.h"

#include <sys/mman.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <deque>
#include <new>

#include "unit/plugin/lab_plugin.h"

namespace lockstep::host::test {
namespace {

using Strings = std::vector<std::string>;

TEST_CASE("a leaf is told as a node type, with its ports as parameters") {
  PluginSet plugins;
  Diagnostics diagnostics;
  REQUIRE(plugins.add(lab_plugin(), "lab", diagnostics));
  REQUIRE(plugins.types().size() == 1);
  const NodeType& type = *plugins.types()[0];
  CHECK(type.id == "Lab");
  CHECK(type.category == NodeCategory::Action);
  CHECK(type.doc == "shows itself");
  CHECK(type.arity.max == 0);
  CHECK(type.plugin == "lab");
  CHECK_FALSE(type.has_progress);
  REQUIRE(type.parameters.size() == 7);

  const Parameter& flag = type.parameters[kFlag];
  CHECK((flag.name == "flag" && flag.type == ValueType::Bool && flag.unit == "m/s"));
  CHECK((flag.required && flag.direction == Direction::Input && !flag.default_text));
  CHECK((type.parameters[kCount].required && type.parameters[kCount].type == ValueType::Int));
  CHECK(type.parameters[kCount].direction == Direction::InOut);
  CHECK(type.parameters[kSpeed].type == ValueType::Double);
  CHECK(type.parameters[kText].type == ValueType::String);
  CHECK(type.parameters[kList].type == ValueType::DoubleList);
  const Parameter& limit = type.parameters[kLimit];
  CHECK((!limit.required && limit.default_text == "0.5"));
  const Parameter& result = type.parameters[kResult];
  CHECK((!result.required && result.direction == Direction::Output));
}

TEST_CASE("a plugin is initialized once, and deinitialized with its set") {
  lab = {};
  {
    PluginSet plugins;
    Diagnostics diagnostics;
    REQUIRE(plugins.add(lab_plugin(), "lab", diagnostics));
    CHECK(lab.events.empty());
    CHECK(plugins.initialize(diagnostics));
    CHECK(plugins.initialize(diagnostics));
    CHECK(lab.events == Strings{"init"});
  }
  CHECK(lab.events == Strings{"init", "deinit"});
}

TEST_CASE("a plugin that was only listed is neither initialized nor deinitialized") {
  lab = {};
  {
    PluginSet plugins;
    Diagnostics diagnostics;
    REQUIRE(plugins.add(lab_plugin(), "lab", diagnostics));
  }
  CHECK(lab.events.empty());
}

// A plugin of so many leaf types, each with so many ports.
struct Crowd {
  Crowd(std::uint32_t leaves, std::uint32_t ports_of_each) {
    for (std::uint32_t i = 0; i < ports_of_each; ++i) {
      const char* const name = names.emplace_back("p" + std::to_string(i)).c_str();
      ports.push_back({sizeof(lockstep_port), LOCKSTEP_BOOL, LOCKSTEP_INPUT, name, "true", nullptr,
                       nullptr, nullptr, 0, 0, nullptr, 0});
    }
    for (const lockstep_port& port : ports) port_list.push_back(&port);
    for (std::uint32_t i = 0; i < leaves; ++i) {
      lockstep_leaf_type& type = types.emplace_back(*lab_plugin().leaf_types[0]);
      type.id = names.emplace_back("Leaf" + std::to_string(i)).c_str();
      type.port_count = ports_of_each;
      type.ports = port_list.data();
      type_list.push_back(&type);
    }
  }
  std::string refusal() const {
    lockstep_plugin plugin = lab_plugin();
    plugin.leaf_type_count = static_cast<std::uint32_t>(types.size());
    plugin.leaf_types = type_list.data();
    Descriptors descriptors;
    const auto refusal = read_descriptors(plugin, 0, descriptors);
    return refusal ? refusal->message : "";
  }

  std::deque<std::string> names;
  std::deque<lockstep_port> ports;
  std::deque<lockstep_leaf_type> types;
  std::vector<const lockstep_port*> port_list;
  std::vector<const lockstep_leaf_type*> type_list;
};

TEST_CASE("a plugin has at most 4096 leaf types, and each of them 4096 ports") {
  CHECK(Crowd(1, 4096).refusal() == "");
  CHECK_THAT(Crowd(1, 4097).refusal(),
             Catch::Contains("claims to have 4097 ports, expected at most 4096"));
  CHECK(Crowd(4096, 1).refusal() == "");
  CHECK_THAT(Crowd(4097, 1).refusal(),
             Catch::Contains("claims to have 4097 leaf types, expected at most 4096"));
}

// The struct of a minor to come, and a plugin that knows only today's.
struct LongerPort {
  lockstep_port base;
  const char* more;
};

TEST_CASE("of a struct that is shorter than ours only what is there is read") {
  // The short struct ends where readable memory ends.
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const pages =
      mmap(nullptr, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  REQUIRE(pages != MAP_FAILED);
  char* const end = static_cast<char*>(pages) + page;
  REQUIRE(mprotect(end, page, PROT_NONE) == 0);
  void* const place = end - sizeof(lockstep_port);
  new (place) lockstep_port{sizeof(lockstep_port),
                            LOCKSTEP_INT,
                            LOCKSTEP_INPUT,
                            "ticks",
                            nullptr,
                            nullptr,
                            "doc",
                            nullptr,
                            0,
                            0,
                            nullptr,
                            0};

  const auto* const from = static_cast<const LongerPort*>(place);
  const LongerPort copy = covered_copy(from, from->base.struct_size);
  CHECK(std::string(copy.base.name) == "ticks");
  CHECK(std::string(copy.base.doc) == "doc");
  CHECK(copy.more == nullptr);
  munmap(pages, 2 * page);
}

}  // namespace
}  // namespace lockstep::host::test
