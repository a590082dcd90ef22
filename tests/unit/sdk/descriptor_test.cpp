// The constants that leaf.hpp makes of classes: what a host can list without creating anything.
#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <vector>

#include "base/core/value.h"
#include "fake_host.h"
#include "lockstep/leaf.hpp"

namespace {

struct AllPorts : lockstep::Ports {
  Input<bool> flag{this, "flag", "true", "a flag"};
  Input<std::int64_t> count{this, "count", "-3", "a count"};
  Input<double> length{this, "length", required, "a length", "m"};
  InOut<std::string> text{this, "text", "", "a text"};
  Output<std::vector<double>> list{this, "list", "a list", "s"};
};

struct MoreThanAllPorts : AllPorts {
  Input<double> extra{this, "extra", "1e-3", "one more"};
};

int created = 0;

class Bare : public lockstep::Action<> {
 public:
  Bare() { ++created; }
  Status tick() override { return Status::Success; }
};

class Full : public lockstep::Action<AllPorts> {
 public:
  void start() override {}
  Status tick() override { return Status::Success; }
  void halt() override {}
  void pause() override {}
  void resume() override {}
  double progress() const override { return 0.5; }
};

class Heir : public Full {
 public:
  Status tick() override { return Status::Failure; }
};

class Extended : public lockstep::Action<MoreThanAllPorts> {
 public:
  Status tick() override { return Status::Success; }
};

class Question : public lockstep::Condition<> {
 public:
  bool check() override { return true; }
};

class Threaded : public lockstep::ThreadedAction<> {
 public:
  Status run(lockstep::Token&) override { return Status::Success; }
};

class Driver : public lockstep::Action<> {
 public:
  static constexpr bool kRealTime = true;
  Status tick() override { return Status::Success; }
};

constexpr lockstep_leaf_type kBare = lockstep::leaf<Bare>("Bare", "does nothing");
constexpr lockstep_leaf_type kFull = lockstep::leaf<Full>("Full", "has all");
constexpr lockstep_leaf_type kHeir = lockstep::leaf<Heir>("Heir", "");
constexpr lockstep_leaf_type kExtended = lockstep::leaf<Extended>("Extended", "");
constexpr lockstep_leaf_type kQuestion = lockstep::leaf<Question>("Question", "asks");
constexpr lockstep_leaf_type kThreaded = lockstep::leaf<Threaded>("Threaded", "");

LOCKSTEP_PLUGIN_TABLE(sdk_test_plugin, "sdk-test_1", "2.3", "a plugin of two leaves",
                      lockstep::leaf<Bare>("Bare", "does nothing"),
                      lockstep::leaf<Question>("Question", "asks"));

std::string describe(const lockstep_port& port) {
  return std::to_string(port.type) + std::to_string(port.direction) + " " + port.name + "=" +
         (port.default_value != nullptr ? port.default_value : "required") + " [" + port.unit +
         "] " + port.doc;
}

}  // namespace

TEST_CASE("a leaf type is described without creating a leaf", "[sdk]") {
  const int before = created;
  CHECK(kBare.struct_size == sizeof(lockstep_leaf_type));
  CHECK(kBare.kind == LOCKSTEP_ACTION);
  CHECK(std::string(kBare.id) == "Bare");
  CHECK(std::string(kBare.doc) == "does nothing");
  CHECK(kBare.port_count == 0);
  CHECK(kQuestion.kind == LOCKSTEP_CONDITION);
  CHECK(created == before);
}

TEST_CASE("a leaf may say that it works in real time, a threaded action does not", "[sdk]") {
  CHECK(kBare.flags == 0);
  CHECK(kQuestion.flags == 0);
  CHECK(kThreaded.flags == 0);
  CHECK(lockstep::leaf<Driver>("Driver", "").flags == LOCKSTEP_REAL_TIME);
}

TEST_CASE("ports are listed in the order of the members", "[sdk]") {
  std::vector<std::string> ports;
  for (std::uint32_t i = 0; i < kFull.port_count; ++i) {
    CHECK(kFull.ports[i]->struct_size == sizeof(lockstep_port));
    ports.push_back(describe(*kFull.ports[i]));
  }
  CHECK(ports == std::vector<std::string>{"11 flag=true [] a flag", "21 count=-3 [] a count",
                                          "31 length=required [m] a length", "43 text= [] a text",
                                          "52 list=required [s] a list"});
}

TEST_CASE("a struct of ports extends another", "[sdk]") {
  REQUIRE(kExtended.port_count == 6);
  CHECK(std::string(kExtended.ports[0]->name) == "flag");
  CHECK(std::string(kExtended.ports[5]->name) == "extra");
}

TEST_CASE("functions that a class does not override are NULL", "[sdk]") {
  CHECK(kBare.create != nullptr);
  CHECK(kBare.destroy != nullptr);
  CHECK(kBare.tick != nullptr);
  for (const auto* type : {&kBare, &kQuestion}) {
    CHECK(type->start == nullptr);
    CHECK(type->halt == nullptr);
    CHECK(type->pause == nullptr);
    CHECK(type->resume == nullptr);
    CHECK(type->progress == nullptr);
  }
}

TEST_CASE("functions that a class or its base overrides are there", "[sdk]") {
  for (const auto* type : {&kFull, &kHeir, &kThreaded}) {
    CHECK(type->start != nullptr);
    CHECK(type->halt != nullptr);
    CHECK(type->pause != nullptr);
    CHECK(type->resume != nullptr);
    CHECK(type->progress != nullptr);
  }
}

TEST_CASE("the plugin is one constant with all its leaves", "[sdk]") {
  CHECK(sdk_test_plugin.abi_major == LOCKSTEP_ABI_MAJOR);
  CHECK(sdk_test_plugin.abi_minor == LOCKSTEP_ABI_MINOR);
  CHECK(sdk_test_plugin.struct_size == sizeof(lockstep_plugin));
  CHECK(std::string(sdk_test_plugin.name) == "sdk-test_1");
  CHECK(std::string(sdk_test_plugin.version) == "2.3");
  CHECK(std::string(sdk_test_plugin.doc) == "a plugin of two leaves");
  REQUIRE(sdk_test_plugin.leaf_type_count == 2);
  CHECK(std::string(sdk_test_plugin.leaf_types[0]->id) == "Bare");
  CHECK(std::string(sdk_test_plugin.leaf_types[1]->id) == "Question");
  CHECK(sdk_test_plugin.init == nullptr);
  CHECK(sdk_test_plugin.create_run == nullptr);
}

TEST_CASE("the compiler accepts the defaults that the tree language accepts", "[sdk]") {
  using lockstep::host::parse_value;
  using lockstep::host::ValueType;
  const std::string text = GENERATE(
      as<std::string>(), "", " ", "0", "1", "-7", "+7", "+-7", "--7", "1.", ".5", ".", "1.5", " 2 ",
      "1e3", "1e", "1e+3", "1E-3", "e3", "0x10", "inf", "nan", "true", "false", "True", " true ",
      "1;2", "1, 2", "0.25;0.5;", ";;", "1;x", "1;-", "1 2\t3", "1 . 2", "7,", "+", "1_0");
  CAPTURE(text);
  const auto accepted = [&](ValueType type) { return parse_value(type, text).has_value(); };
  CHECK(lockstep::detail::is_bool(text) == accepted(ValueType::Bool));
  CHECK(lockstep::detail::is_int(text) == accepted(ValueType::Int));
  CHECK(lockstep::detail::is_double(text) == accepted(ValueType::Double));
  CHECK(lockstep::detail::PortTraits<lockstep::Number>::accepts(text) ==
        accepted(ValueType::Number));
  CHECK(lockstep::detail::PortTraits<std::vector<double>>::accepts(text) ==
        accepted(ValueType::DoubleList));
  CHECK(lockstep::detail::PortTraits<std::vector<std::int64_t>>::accepts(text) ==
        accepted(ValueType::IntList));
  CHECK(lockstep::detail::PortTraits<std::vector<bool>>::accepts(text) ==
        accepted(ValueType::BoolList));
  CHECK(lockstep::detail::PortTraits<std::vector<std::string>>::accepts(text) ==
        accepted(ValueType::StringList));
}

namespace {

enum class Grip { Soft, Firm };

}  // namespace

LOCKSTEP_CHOICES(Grip, "soft;firm");

namespace {

struct LimitedPorts : lockstep::Ports {
  Input<Grip> grip{this, "grip", "firm", ""};
  Input<double> force{this, "force", "0.5", "", "N", between(-1, 20)};
  Input<std::int64_t> count{this, "count", required, "", at_least(1)};
  Output<std::vector<double>> angles{this, "angles", "", at_most(1.5)};
  InOut<std::string> hand{this, "hand", "left", "", one_of("left;right")};
};

class Limited : public lockstep::Action<LimitedPorts> {
 public:
  Status tick() override { return Status::Success; }
};

constexpr lockstep_leaf_type kLimited = lockstep::leaf<Limited>("Limited", "");

}  // namespace

TEST_CASE("ports say which values they take", "[sdk]") {
  const auto port = [](std::size_t index) { return *kLimited.ports[index]; };
  CHECK(port(0).type == LOCKSTEP_STRING);
  CHECK(std::string(port(0).choices) == "soft;firm");
  CHECK((port(1).min == -1 && port(1).max == 20 && port(1).choices == nullptr));
  CHECK((port(2).min == 1 && port(2).max == HUGE_VAL && port(2).default_value == nullptr));
  CHECK((port(3).min == -HUGE_VAL && port(3).max == 1.5 && std::string(port(3).unit).empty()));
  CHECK(std::string(port(4).choices) == "left;right");
  CHECK((kFull.ports[0]->min == 0 && kFull.ports[0]->max == 0));
}

TEST_CASE("the compiler looks whether a default is within the limits", "[sdk]") {
  using lockstep::detail::may_be_within;
  CHECK(may_be_within("0.1", 0.1, 0.1));
  CHECK(may_be_within(" -2.50 ", -2.5, -2.5));
  CHECK_FALSE(may_be_within("+20.5", 0, 20));
  CHECK_FALSE(may_be_within("-1", 0, 20));
  CHECK(may_be_within("1e9", 0, 20));  // left to the host
}

namespace {

struct EntryPorts : lockstep::Ports {
  Input<double> speed{this, "speed", "{speed}", "how fast", "m/s", at_least(0)};
  Input<lockstep::Any> goal{this, "goal", "{=}", "where to"};
  Input<lockstep::Any> path{this, "path", required, "the way"};
};

class Watching : public lockstep::Condition<EntryPorts> {
 public:
  bool check() override { return goal.changed(); }
};

constexpr lockstep_leaf_type kWatching = lockstep::leaf<Watching>("Watching", "");

}  // namespace

TEST_CASE("a default may be an entry, and a port of any type", "[sdk]") {
  const auto port = [](std::size_t index) { return *kWatching.ports[index]; };
  CHECK(port(0).flags == LOCKSTEP_DEFAULT_ENTRY);
  CHECK(describe(port(0)) == "31 speed={speed} [m/s] how fast");
  CHECK(port(0).max == HUGE_VAL);
  CHECK((port(1).type == LOCKSTEP_ANY && port(1).flags == LOCKSTEP_DEFAULT_ENTRY));
  CHECK(std::string(port(1).default_value) == "{=}");
  CHECK((port(2).type == LOCKSTEP_ANY && port(2).flags == 0 && port(2).default_value == nullptr));
}

TEST_CASE("a host that is too old to know whether a port has changed is an error", "[sdk]") {
  sdk_test::FakeLeaf leaf(kWatching, {1.0, 1.0, 1.0});
  leaf.tick();
  CHECK(leaf.host.take_error() ==
        "this lockstep does not say whether port 'goal' has changed: it is older than contract "
        "1.4");
}
