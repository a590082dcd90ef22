// Descriptors as node types, and structs that are shorter than this host's.
#include "plugin/descriptor.h"

#include <sys/mman.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <new>

#include "unit/plugin/lab_plugin.h"

namespace lockstep::test {
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
  new (place) lockstep_port{
      sizeof(lockstep_port), LOCKSTEP_INT, LOCKSTEP_INPUT, "ticks", nullptr, nullptr, "doc"};

  const auto* const from = static_cast<const LongerPort*>(place);
  const LongerPort copy = covered_copy(from, from->base.struct_size);
  CHECK(std::string(copy.base.name) == "ticks");
  CHECK(std::string(copy.base.doc) == "doc");
  CHECK(copy.more == nullptr);
  munmap(pages, 2 * page);
}

}  // namespace
}  // namespace lockstep::test
