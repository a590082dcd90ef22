// Reading and writing ports, and the services of the host, from inside a leaf.
#include <catch2/catch.hpp>

#include <functional>

#include "fake_host.h"
#include "lockstep/leaf.hpp"

namespace {

using sdk_test::FakeHost;
using sdk_test::FakeLeaf;
using sdk_test::PortValue;

struct ProbePorts : lockstep::Ports {
  Input<bool> flag{this, "flag", required, ""};
  Input<std::int64_t> count{this, "count", required, ""};
  Input<double> length{this, "length", required, ""};
  InOut<std::string> text{this, "text", required, ""};
  InOut<std::vector<double>> list{this, "list", required, ""};
  Output<double> out{this, "out", ""};
};

// Does in its tick what the test says.
class Probe : public lockstep::Action<ProbePorts> {
 public:
  using Action::context;
  using Action::host_extension;
  using Action::log;
  using Action::now;
  using Action::random;
  using Action::random_bits;
  using Action::tick_period;
  using Action::uniform;

  Status tick() override {
    work(*this);
    return Status::Success;
  }
  static inline std::function<void(Probe&)> work;
};

constexpr lockstep_leaf_type kProbe = lockstep::leaf<Probe>("Probe", "");

// The error of a probe with these ports that does this work; "" for none.
std::string error_of(std::function<void(Probe&)> work, FakeLeaf& leaf) {
  Probe::work = std::move(work);
  leaf.tick();
  return leaf.host.take_error();
}

std::vector<PortValue> values() {
  return {true, std::int64_t{-5}, 0.25, std::string("door"), std::vector<double>{1, 2.5}, 0.0};
}

}  // namespace

TEST_CASE("each type of port is read", "[sdk]") {
  FakeLeaf leaf(kProbe, values());
  CHECK(error_of(
            [](Probe& it) {
              CHECK(it.flag.get() == true);
              CHECK(it.count.get() == -5);
              CHECK(it.length.get() == 0.25);
              CHECK(it.text.get() == "door");
              CHECK(it.text.view() == "door");
              CHECK(it.list.get() == std::vector<double>{1, 2.5});
              CHECK(it.list.view().size() == 2);
              CHECK(it.list.view()[1] == 2.5);
              CHECK(it.list.try_get() == std::vector<double>{1, 2.5});
            },
            leaf)
            .empty());
}

TEST_CASE("what lasts is read and dropped without the host", "[sdk]") {
  FakeHost::tells_what_lasts = true;
  FakeLeaf leaf(kProbe, values(), nullptr, false);
  FakeHost::tells_what_lasts = false;
  leaf.host.writable.assign(leaf.host.ports.size(), true);  // so that the host would take it
  CHECK(error_of(
            [](Probe& it) {
              CHECK(it.flag.is_constant());
              CHECK(it.flag.get() == true);
              CHECK(it.count.get() == -5);
              CHECK(it.length.try_get() == 0.25);
              CHECK_FALSE(it.text.is_constant());
              CHECK(it.text.get() == "door");
              CHECK_FALSE(it.out.set(7.5));
              CHECK_FALSE(it.text.set("window"));
            },
            leaf)
            .empty());
  CHECK(leaf.host.ports == values());
}

TEST_CASE("a host that does not tell what lasts is asked each time", "[sdk]") {
  FakeLeaf leaf(kProbe, values());
  Probe::work = [](Probe& it) {
    CHECK_FALSE(it.length.is_constant());
    CHECK(it.length.get() == 0.25);
  };
  leaf.tick();
  leaf.host.ports[2] = 0.5;
  Probe::work = [](Probe& it) { CHECK(it.length.get() == 0.5); };
  leaf.tick();
}

TEST_CASE("ports are written, also with what they hold", "[sdk]") {
  FakeLeaf leaf(kProbe, values());
  Probe::work = [](Probe& it) {
    CHECK(it.out.set(7.5));
    CHECK(it.text.set("window"));
    CHECK(it.list.set({3}));
  };
  leaf.tick();
  CHECK(leaf.host.ports[5] == PortValue(7.5));
  CHECK(leaf.host.ports[3] == PortValue(std::string("window")));
  CHECK(leaf.host.ports[4] == PortValue(std::vector<double>{3}));
}

TEST_CASE("setting an output that the tree does not bind says so, and is no error", "[sdk]") {
  FakeLeaf leaf(kProbe, values());
  leaf.host.writable[5] = false;
  CHECK(error_of([](Probe& it) { CHECK_FALSE(it.out.set(1)); }, leaf).empty());
}

TEST_CASE("reading a port without a value is an error that names the port", "[sdk]") {
  FakeLeaf leaf(kProbe, std::vector<PortValue>(6));
  CHECK(error_of([](Probe& it) { it.length.get(); }, leaf) == "port 'length' has no value");
  CHECK(error_of([](Probe& it) { it.text.get(); }, leaf) == "port 'text' has no value");
  CHECK(error_of([](Probe& it) { it.list.view(); }, leaf) == "port 'list' has no value");
}

TEST_CASE("a host that knows why a port is empty is told which one", "[sdk]") {
  FakeHost::knows_empty_ports = true;
  FakeLeaf leaf(kProbe, std::vector<PortValue>(6));
  CHECK(error_of([](Probe& it) { it.length.get(); }, leaf) == "empty: 2");
  CHECK(error_of([](Probe& it) { it.list.view(); }, leaf) == "empty: 4");
  CHECK(error_of([](Probe&) { throw std::runtime_error("port 'length' has no value"); }, leaf) ==
        "port 'length' has no value");
  FakeHost::knows_empty_ports = false;
}

TEST_CASE("try_get of a port without a value is nothing", "[sdk]") {
  FakeLeaf leaf(kProbe, std::vector<PortValue>(6));
  CHECK(error_of(
            [](Probe& it) {
              CHECK(it.flag.try_get() == std::nullopt);
              CHECK(it.text.try_get() == std::nullopt);
            },
            leaf)
            .empty());
}

TEST_CASE("two leaves of a type have ports of their own", "[sdk]") {
  FakeLeaf one(kProbe, values());
  FakeLeaf two(kProbe, values());
  two.host.ports[2] = 9.0;
  CHECK(error_of([](Probe& it) { CHECK(it.length.get() == 0.25); }, one).empty());
  CHECK(error_of([](Probe& it) { CHECK(it.length.get() == 9.0); }, two).empty());
}

TEST_CASE("a leaf asks its host for time, random numbers, log lines and extensions", "[sdk]") {
  FakeLeaf leaf(kProbe, values());
  leaf.host.time = 3.5;
  CHECK(error_of(
            [](Probe& it) {
              CHECK(it.now() == 3.5);
              CHECK(it.tick_period() == 0.125);
              CHECK(it.random_bits() == 0);
              CHECK(it.random() == 0.25);
              CHECK(it.uniform(-1, 1) == 0);
              it.log("hello");
              it.log(lockstep::LogLevel::Warning, "careful");
              REQUIRE(it.host_extension<int>("test.answer") != nullptr);
              CHECK(*it.host_extension<int>("test.answer") == 42);
              CHECK(it.host_extension<int>("unheard of") == nullptr);
            },
            leaf)
            .empty());
  CHECK(leaf.host.lines == std::vector<std::string>{"1 hello", "2 careful"});
}

namespace {

class Early : public lockstep::Action<ProbePorts> {
 public:
  Early() : length_(length.get()), random_(random()) {}
  Status tick() override { return length_ == 0.25 ? Status::Success : Status::Failure; }

 private:
  double length_;
  double random_;
};

}  // namespace

TEST_CASE("a constructor may use ports and services", "[sdk]") {
  static constexpr auto kEarly = lockstep::leaf<Early>("Early", "");
  FakeLeaf leaf(kEarly, values());
  REQUIRE(leaf.exists());
  CHECK(leaf.tick() == LOCKSTEP_SUCCESS);
  CHECK(leaf.host.draws == 1);
}

TEST_CASE("a leaf is created by its host only", "[sdk]") {
  CHECK_THROWS_WITH(Probe(), "a leaf can only be created by its host");
}

namespace {

struct MorePorts : lockstep::Ports {
  InOut<std::vector<std::int64_t>> steps{this, "steps", "1;-2", ""};
  InOut<std::vector<bool>> flags{this, "flags", "true 0", ""};
  InOut<std::vector<std::string>> doors{this, "doors", "red;blue", ""};
  Input<lockstep::Number> number{this, "number", "0.5", ""};
};

class More : public lockstep::Action<MorePorts> {
 public:
  Status tick() override {
    work(*this);
    return Status::Success;
  }
  static inline std::function<void(More&)> work;
};

constexpr lockstep_leaf_type kMore = lockstep::leaf<More>("More", "");

}  // namespace

TEST_CASE("lists are read and written", "[sdk]") {
  using Strings = std::vector<std::string>;
  FakeLeaf leaf(kMore, {std::vector<std::int64_t>{4, 5}, sdk_test::Flags{true, false, true},
                        Strings{"a", ""}, std::int64_t{3}});
  More::work = [](More& it) {
    CHECK(it.steps.get() == std::vector<std::int64_t>{4, 5});
    CHECK(it.steps.view()[1] == 5);
    CHECK(it.flags.get() == std::vector<bool>{true, false, true});
    CHECK(it.flags.view()[1] == false);
    CHECK(it.doors.get() == Strings{"a", ""});
    CHECK(it.doors.view().size() == 2);
    CHECK(it.doors.view()[0] == "a");
    CHECK(it.steps.set({7}));
    CHECK(it.flags.set({false, true}));
    CHECK(it.doors.set({"red", "a;b"}));
  };
  CHECK(leaf.tick() == LOCKSTEP_SUCCESS);
  CHECK(leaf.host.take_error().empty());
  CHECK(leaf.host.ports[0] == PortValue(std::vector<std::int64_t>{7}));
  CHECK(leaf.host.ports[1] == PortValue(sdk_test::Flags{false, true}));
  CHECK(leaf.host.ports[2] == PortValue(Strings{"red", "a;b"}));
}

TEST_CASE("a number is an int or a double", "[sdk]") {
  FakeLeaf leaf(kMore, {{}, {}, {}, std::int64_t{1} << 60});
  More::work = [](More& it) {
    CHECK(it.number.get().is_int());
    CHECK(it.number.get().to_int() == std::int64_t{1} << 60);
    CHECK(it.number.get() > 1e18);
  };
  leaf.tick();
  leaf.host.ports[3] = 2.75;
  More::work = [](More& it) {
    CHECK_FALSE(it.number.get().is_int());
    CHECK(it.number.get().to_int() == 2);
    CHECK(it.number.get() == 2.75);
  };
  leaf.tick();
  leaf.host.ports[3] = {};
  More::work = [](More& it) { CHECK(it.number.try_get() == std::nullopt); };
  leaf.tick();
  CHECK(leaf.host.take_error().empty());
}
