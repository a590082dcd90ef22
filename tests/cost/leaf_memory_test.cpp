// What a leaf of a plugin takes in a run, as the allocator counts it: its slot, its caller, its
// ports and its call site, and the leaf itself, over leaf.h, where it has nothing, and over
// leaf.hpp.
#include <malloc.h>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <lockstep/leaf.hpp>

#include <memory>
#include <optional>
#include <vector>

#include "leaves/plugin/contract/leaf_set.h"
#include "support/compiled.h"

// Sanitizers have a separate allocator.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace lockstep::host::test {
namespace {

lockstep_port input(const char* name) {
  lockstep_port port{};
  port.struct_size = sizeof port;
  port.type = LOCKSTEP_DOUBLE;
  port.direction = LOCKSTEP_INPUT;
  port.name = name;
  return port;
}

// A plugin with one type of leaf, which has two ports and allocates nothing.
struct Plain {
  lockstep_port size = input("size"), step = input("step");
  const lockstep_port* ports[2] = {&size, &step};
  lockstep_leaf_type leaf{};
  const lockstep_leaf_type* leaves[1] = {&leaf};
  lockstep_plugin plugin{};

  Plain() {
    leaf.struct_size = sizeof leaf;
    leaf.kind = LOCKSTEP_ACTION;
    leaf.id = "Plain";
    leaf.ports = ports;
    leaf.port_count = 2;
    leaf.create = [](const lockstep_host*, const lockstep_caller* caller, void*) -> void* {
      return const_cast<lockstep_caller*>(caller);
    };
    leaf.destroy = [](void*) {};
    leaf.tick = [](void*) -> lockstep_status { return LOCKSTEP_RUNNING; };
    plugin.abi_major = LOCKSTEP_ABI_MAJOR;
    plugin.abi_minor = LOCKSTEP_ABI_MINOR;
    plugin.struct_size = sizeof plugin;
    plugin.name = "plain";
    plugin.version = "1";
    plugin.leaf_types = leaves;
    plugin.leaf_type_count = 1;
  }
};

// The same over leaf.hpp.
struct ClassPorts : lockstep::Ports {
  Input<double> size{this, "size", required, "a number"};
  Input<double> step{this, "step", required, "another one"};
};
class Class : public lockstep::Action<ClassPorts> {
 public:
  Status tick() override { return size.get() > step.get() ? Status::Running : Status::Failure; }
};
LOCKSTEP_PLUGIN_TABLE(class_plugin, "class", "1", "For a test",
                      lockstep::leaf<Class>("Class", "Runs"));

enum class Constants { Same, Different };

// A Parallel of such leaves with two constant ports.
class PlainTree {
 public:
  explicit PlainTree(int leaves, const char* id = "Plain", Constants constants = Constants::Same) {
    Diagnostics diagnostics;
    REQUIRE(plugins_.add(plain_.plugin, "plain", diagnostics));
    REQUIRE(plugins_.add(class_plugin, "class", diagnostics));
    std::string text = R"(<root lockstep="1"><BehaviorTree ID="Main"><Parallel>)";
    for (int i = 0; i < leaves; ++i) {
      const int number = constants == Constants::Same ? 0 : i;
      text += fmt::format(R"(<{} size="{}.5" step="{}.25"/>)", id, number, number);
    }
    text += "</Parallel></BehaviorTree></root>";
    tree_ = test::compiled(text, plugins_);
  }
  const Tree& tree() const { return tree_; }

 private:
  Plain plain_;
  PluginSet plugins_;
  Tree tree_;
};

std::size_t bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

}  // namespace

TEST_CASE("a leaf with two constant ports takes little memory in a run") {
  struct Row {
    const char* id;
    Constants constants;
    double most;  // bytes
  };
  const auto row =
      GENERATE(Row{"Plain", Constants::Same, 250}, Row{"Class", Constants::Same, 400},
               Row{"Plain", Constants::Different, 400}, Row{"Class", Constants::Different, 550});
  constexpr int kLeaves = 20'000;
  struct Kept {
    explicit Kept(const Row& of) : plain(kLeaves, of.id, of.constants), board(plain.tree()) {}
    PlainTree plain;
    Blackboard board;
    LeafTime time;
    std::optional<LeafSet> set;
  };
  // Call sites go to later sets: so that each row needs new ones, none is given back.
  static std::vector<std::unique_ptr<Kept>> kept;
  Kept& it = *kept.emplace_back(std::make_unique<Kept>(row));
  const std::size_t before = bytes_in_use();
  it.set.emplace(it.plain.tree(), it.board, it.time, 0);
  const double per_leaf = static_cast<double>(bytes_in_use() - before) / kLeaves;
  REQUIRE_FALSE(it.set->fault());
  CAPTURE(row.id, per_leaf);
  CHECK(per_leaf > 100);  // it is counted
  CHECK(per_leaf <= row.most);
}

TEST_CASE("sets of leaves that come and go leave nothing behind that grows") {
  const PlainTree plain(100);
  Blackboard board(plain.tree());
  const LeafTime time;
  const auto make = [&] { const LeafSet set(plain.tree(), board, time, 0); };
  for (int i = 0; i < 10; ++i) make();
  const std::size_t before = bytes_in_use();
  for (int i = 0; i < 1000; ++i) make();
  CHECK(bytes_in_use() <= before + 1000);
}

}  // namespace lockstep::host::test

#endif
