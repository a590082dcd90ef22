// What the leaves of one run share, and the hooks of a plugin.
#include <catch2/catch.hpp>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "fake_host.h"
#include "lockstep/leaf.hpp"

namespace {

using sdk_test::FakeHost;
using sdk_test::FakeLeaf;

int worlds = 0;
bool world_fails = false;

struct World {
  explicit World(lockstep::Run& of) : run(of), seed(of.random_bits()) {
    if (world_fails) throw std::runtime_error("no world");
    ++worlds;
  }
  ~World() noexcept(false) {
    --worlds;
    if (world_fails) throw std::runtime_error("no end");
  }
  lockstep::Run& run;
  std::uint64_t seed;
  int ticks = 0;
};

struct Other {};

class Walk : public lockstep::Action<> {
 public:
  Status tick() override {
    return ++context<World>().ticks >= 3 ? Status::Success : Status::Running;
  }
};

class Stray : public lockstep::Action<> {
 public:
  Status tick() override {
    context<Other>();
    return Status::Success;
  }
};

bool initialized = false;
void start() {
  initialized = true;
}
void end() {
  initialized = false;
}
void refuse() {
  throw std::runtime_error("no license");
}

LOCKSTEP_PLUGIN_TABLE(world_plugin, "world", "1", "", lockstep::run_context<World>(),
                      lockstep::init<start>(), lockstep::deinit<end>(),
                      lockstep::leaf<Walk>("Walk", ""), lockstep::leaf<Stray>("Stray", ""));
LOCKSTEP_PLUGIN_TABLE(refusing_plugin, "refusing", "1", "", lockstep::init<refuse>(),
                      lockstep::leaf<Walk>("Walk", ""));

struct FakeRun {
  FakeRun() : context(world_plugin.create_run(&FakeHost::table(), host.caller())) {}
  ~FakeRun() {
    if (context != nullptr) world_plugin.destroy_run(context);
  }
  FakeHost host;
  void* context;
};

const lockstep_leaf_type& kWalk = *world_plugin.leaf_types[0];
const lockstep_leaf_type& kStray = *world_plugin.leaf_types[1];

}  // namespace

TEST_CASE("the leaves of a run share its context, other runs have their own", "[sdk]") {
  FakeRun one;
  FakeRun two;
  CHECK(worlds == 2);
  FakeLeaf a(kWalk, {}, one.context);
  FakeLeaf b(kWalk, {}, one.context);
  FakeLeaf c(kWalk, {}, two.context);
  CHECK(a.tick() == LOCKSTEP_RUNNING);
  CHECK(b.tick() == LOCKSTEP_RUNNING);
  CHECK(c.tick() == LOCKSTEP_RUNNING);
  CHECK(a.tick() == LOCKSTEP_SUCCESS);
  CHECK(c.tick() == LOCKSTEP_RUNNING);
}

TEST_CASE("a context ends with its run", "[sdk]") {
  { const FakeRun run; }
  CHECK(worlds == 0);
}

TEST_CASE("a context uses the services of its run", "[sdk]") {
  FakeRun run;
  CHECK(run.host.draws == 1);
}

TEST_CASE("an exception while a context is made is an error of the run", "[sdk]") {
  world_fails = true;
  FakeRun run;
  world_fails = false;
  CHECK(run.context == nullptr);
  CHECK(run.host.take_error() == "no world");
  world_plugin.destroy_run(nullptr);  // what is not there needs no end
}

TEST_CASE("an exception in the end of a context is a warning", "[sdk]") {
  FakeRun run;
  world_fails = true;
  world_plugin.destroy_run(std::exchange(run.context, nullptr));
  world_fails = false;
  CHECK(run.host.lines == std::vector<std::string>{"2 its destructor threw: no end"});
}

TEST_CASE("asking for a context of another type, or for none, is an error", "[sdk]") {
  FakeRun run;
  FakeLeaf stray(kStray, {}, run.context);
  stray.tick();
  CHECK(stray.host.take_error() == "the plugin declares no run context of this type");
  FakeLeaf alone(kWalk);
  alone.tick();
  CHECK(alone.host.take_error() == "the plugin declares no run context of this type");
}

TEST_CASE("init and deinit are called, and an exception refuses with its reason", "[sdk]") {
  FakeHost host;
  CHECK(world_plugin.init(&FakeHost::table(), host.caller()));
  CHECK(initialized);
  world_plugin.deinit();
  CHECK_FALSE(initialized);
  CHECK_FALSE(refusing_plugin.init(&FakeHost::table(), host.caller()));
  CHECK(host.take_error() == "no license");
}
