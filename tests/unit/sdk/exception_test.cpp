// No exception crosses the contract, whatever it is and wherever it is thrown.
#include <catch2/catch.hpp>

#include <functional>
#include <stdexcept>
#include <string>

#include "fake_host.h"
#include "lockstep/leaf.hpp"

namespace {

using sdk_test::FakeLeaf;

// Throws `what` in the function named `where`.
std::string where;
std::function<void()> what = [] {};
void here(const std::string& name) {
  if (name == where) what();
}

class Thrower : public lockstep::Action<> {
 public:
  Thrower() { here("create"); }
  void start() override { here("start"); }
  Status tick() override {
    here("tick");
    return Status::Success;
  }
  void halt() override { here("halt"); }
  void pause() override { here("pause"); }
  void resume() override { here("resume"); }
  double progress() const override {
    here("progress");
    return 0.5;
  }
};

class Doubter : public lockstep::Condition<> {
 public:
  bool check() override {
    here("check");
    return true;
  }
};

constexpr lockstep_leaf_type kThrower = lockstep::leaf<Thrower>("Thrower", "");
constexpr lockstep_leaf_type kDoubter = lockstep::leaf<Doubter>("Doubter", "");

struct Thrown {
  const char* name;
  std::function<void()> action;
  const char* message;
};

struct Mute : std::exception {
  const char* what() const noexcept override { return nullptr; }
};

const Thrown kThrown[] = {
    {"std::exception", [] { throw std::runtime_error("no power"); }, "no power"},
    {"text", [] { throw "no grip"; }, "no grip"},
    {"string", [] { throw std::string("no way"); }, "no way"},
    {"what() that is NULL", [] { throw Mute(); }, "an exception without a text"},
    {"42", [] { throw 42; }, "an exception that is not a std::exception"},
};

void call(FakeLeaf& leaf, const std::string& function) {
  if (function == "start") leaf.start();
  if (function == "tick") leaf.tick();
  if (function == "halt") leaf.halt();
  if (function == "pause") leaf.pause();
  if (function == "resume") leaf.resume();
  if (function == "progress") leaf.progress();
}

}  // namespace

TEST_CASE("an exception in any function of a leaf is its error", "[sdk]") {
  const auto& thrown = kThrown[GENERATE(range(0, 5))];
  const std::string function =
      GENERATE(as<std::string>(), "start", "tick", "halt", "pause", "resume", "progress");
  CAPTURE(thrown.name, function);
  where = function;
  what = thrown.action;
  FakeLeaf leaf(kThrower);
  call(leaf, function);
  CHECK(leaf.host.take_error() == thrown.message);
  where = "";
  call(leaf, function);
  CHECK(leaf.host.take_error().empty());
}

TEST_CASE("an exception in a constructor is an error, and there is no leaf", "[sdk]") {
  const auto& thrown = kThrown[GENERATE(range(0, 5))];
  where = "create";
  what = thrown.action;
  FakeLeaf leaf(kThrower);
  CHECK_FALSE(leaf.exists());
  CHECK(leaf.host.take_error() == thrown.message);
  where = "";
  CHECK(FakeLeaf(kThrower).exists());
}

TEST_CASE("an exception in a condition is its error", "[sdk]") {
  where = "check";
  what = [] { throw 42; };
  FakeLeaf leaf(kDoubter);
  leaf.tick();
  CHECK(leaf.host.take_error() == "an exception that is not a std::exception");
  where = "";
  CHECK(leaf.tick() == LOCKSTEP_SUCCESS);
}
