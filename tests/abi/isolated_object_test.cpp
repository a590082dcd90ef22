// Objects that go from one process to another: as bytes, whatever these are.
#include <unistd.h>

#include <catch2/catch.hpp>

#include "abi/support/isolated_leaves.h"
#include "run/loading/load.h"

namespace lockstep::host::test {
namespace {

LoadOptions options() {
  LoadOptions options;
  options.plugins.directories = {LOCKSTEP_ABI_PLUGINS};
  options.plugins.program_directory = LOCKSTEP_BINARY_DIR;
  return options;
}

// With the plugins parcel_here, parcel_there and parcel_closed, as far as nodes are of them.
std::string document(const Strings& isolated, const std::string& nodes) {
  std::string plugins;
  for (const std::string name : {"Here", "There", "Closed"}) {
    if (nodes.find(name) == std::string::npos) continue;
    const std::string plugin =
        "parcel_" + std::string(1, static_cast<char>(name[0] + 32)) + name.substr(1);
    const bool is_isolated = std::ranges::find(isolated, plugin) != isolated.end();
    plugins +=
        fmt::format(R"(<plugin name="{}"{}/>)", plugin, is_isolated ? R"( isolate="true")" : "");
  }
  return fmt::format(
      R"(<root lockstep="1">{}<BehaviorTree ID="T"><Sequence memory="true">{}</Sequence>
</BehaviorTree></root>)",
      plugins, nodes);
}

struct Delivery {
  explicit Delivery(const Strings& isolated, const std::string& nodes,
                    const LoadOptions& with = options()) {
    auto loaded = load_text("tree.xml", document(isolated, nodes), with, diagnostics);
    if (loaded) runnable = make_runnable(std::move(*loaded));
  }

  // The fault, the errors, or the entries as "name=text".
  std::string run(int ticks = 1) {
    if (!runnable) return diagnostics.all().at(0).message;
    RunOptions run_options;
    run_options.log = [this](std::string_view, lockstep_log_level, std::string_view text) {
      log.emplace_back(text);
    };
    Run run(runnable->tree, run_options);
    for (int tick = 0; tick < ticks; ++tick) run.tick(Nanoseconds(tick));
    if (run.fault() != nullptr) return run.fault()->message;
    std::string text;
    for (std::size_t slot = 0; slot < runnable->tree.slots.size(); ++slot) {
      const Value& value = run.blackboard().entries[slot].value();
      if (runnable->tree.slots[slot].name == "p") {
        process = std::get<std::int64_t>(value);
        continue;
      }
      text += (text.empty() ? "" : " ") + runnable->tree.slots[slot].name + "=" + to_text(value);
    }
    return text;
  }

  Diagnostics diagnostics;
  std::optional<Runnable> runnable;
  std::int64_t process = 0;
  Strings log;
};

const Strings kHere = {"parcel_here"}, kThere = {"parcel_there"};
const Strings kBoth = {"parcel_here", "parcel_there"};

std::string send(const std::string& plugin, const std::string& content) {
  return fmt::format(R"(<Send{} content="{}" parcel="{{parcel}}"/>)", plugin, content);
}
std::string receive(const std::string& plugin, const std::string& parcel = "{parcel}") {
  return fmt::format(R"(<Receive{} parcel="{}" content="{{c}}" process="{{p}}"/>)", plugin, parcel);
}

TEST_CASE("objects go from process to process, and views show their text") {
  const NothingRemains nothing_remains;
  for (const Strings& isolated : {Strings{}, kHere, kThere, kBoth}) {
    Delivery delivery(isolated, send("Here", "tea; coffee") + receive("There"));
    CHECK(delivery.run() == "parcel=[tea; coffee] c=tea; coffee");
    CHECK((delivery.process == getpid()) == (isolated == Strings{} || isolated == kHere));
  }
  CHECK(Delivery(kThere, send("There", "") + receive("There")).run() == "parcel=[] c=");
  const std::string large(std::size_t{1} << 20, 'x');
  CHECK(Delivery(kBoth, send("Here", large) + receive("There")).run() ==
        "parcel=[" + large + "] c=" + large);
}

TEST_CASE("objects from texts go there too, and are made in the plugin's process") {
  const NothingRemains nothing_remains;
  LoadOptions with_value = options();
  with_value.values["parcel"] = "tea";
  for (const Strings& isolated : {Strings{}, kHere, kThere, kBoth}) {
    CHECK(Delivery(isolated, receive("There", "tea")).run() == "c=tea");
    CHECK(Delivery(isolated, receive("Here") + receive("There"), with_value).run() ==
          "parcel=[tea] c=tea");
    CHECK(Delivery(isolated, receive("There", "none")).run() ==
          "'none' is not the text of a test.Parcel, which 'parcel' must be");
  }
  CHECK(Delivery(kThere, receive("There", "segv in from_text") + receive("There", "tea")).run() ==
        "'segv in from_text' is not the text of a test.Parcel, which 'parcel' must be");
}

TEST_CASE("an object that is not set again is read as the same") {
  for (const Strings& isolated : {Strings{}, kHere, kThere, kBoth}) {
    const std::string twice =
        receive("There").replace(1, 12, R"(Repeat times="2"><ReceiveThere is_same="{same}")");
    CHECK(Delivery(isolated, send("Here", "tea") + twice + "</Repeat>").run(2) ==
          "parcel=[tea] c=tea same=true");
  }
}

TEST_CASE("a port of any type sees whether the object is another one, and not what it is") {
  const std::string watch = R"(<WatchThere seen="{seen}"/>)", again = R"(<Repeat times="2">)";
  for (const Strings& isolated : {Strings{}, kHere, kThere, kBoth}) {
    const auto ran = [&](int ticks, const std::string& nodes) {
      return Delivery(isolated, nodes).run(ticks);
    };
    CHECK(ran(1, send("Here", "tea") + watch) == "parcel=[tea] seen=true");
    CHECK(ran(2, send("Here", "tea") + again + watch + "</Repeat>") == "parcel=[tea] seen=false");
    CHECK(ran(2, again + R"(<Sequence memory="true">)" + watch + send("Here", "tea") +
                     "</Sequence></Repeat>") == "parcel=[tea] seen=true");
    CHECK(ran(2, again + watch + "</Repeat>") == "parcel= seen=false");
  }
}

// The plugin that destroys its run context first has set an object that the other one still has.
TEST_CASE("objects that crossed are released before the run contexts") {
  const std::string nodes = R"(<SendThere content="" parcel="{other}"/>)" + send("Here", "tea") +
                            receive("There") + receive("Here");
  for (const Strings& isolated : {Strings{}, kHere, kThere, kBoth}) {
    Delivery delivery(isolated, nodes);
    CHECK(delivery.run() == "other=[] parcel=[tea] c=tea");
    CHECK(delivery.log.empty());
  }
}

TEST_CASE("bytes that are none, and functions that fail, are faults with names") {
  const NothingRemains nothing_remains;
  struct Row {
    Strings isolated;
    std::string content, expected;
  };
  const std::string failed = "to_bytes of 'test.Parcel' has failed";
  const std::string large =
      "to_bytes of 'test.Parcel' has 67108865 bytes, at most 64 MiB can leave a process";
  const std::string none = "cannot read 'parcel': from_bytes of 'test.Parcel' finds no object in ";
  const Row rows[] = {
      {kHere, "throw in to_bytes", "cannot set 'parcel': " + failed},
      {kThere, "throw in to_bytes", "cannot be sent an object: " + failed},
      {kHere, "large", "cannot set 'parcel': " + large},
      {kThere, "large", "cannot be sent an object: " + large},
      {kHere, "damaged", none + "7 bytes"},
      {kThere, "damaged", none + "7 bytes"},
      {kBoth, "throw in from_bytes", none + "19 bytes"},
      {kThere, "segv in from_bytes", "its process was killed by SIGSEGV (Segmentation fault)"},
      {kHere, "segv in to_text", "its process was killed by SIGSEGV (Segmentation fault)"},
  };
  for (const Row& row : rows) {
    INFO(row.content << " " << row.expected);
    CHECK(Delivery(row.isolated, send("Here", row.content) + receive("There")).run() ==
          row.expected);
  }
}

TEST_CASE("after an object that cannot be sent the process goes on") {
  Delivery delivery(kThere, send("Here", "throw in to_bytes") + receive("There"));
  REQUIRE(delivery.runnable);
  Run run(delivery.runnable->tree, {});
  for (const std::uint64_t seed : {1, 2}) {
    run.restart(seed);
    run.tick(Nanoseconds(0));
    REQUIRE(run.fault() != nullptr);
    CHECK(run.fault()->message.starts_with("cannot be sent an object"));
  }
}

TEST_CASE("a type without bytes does not meet one of another process") {
  const std::string nodes = send("Closed", "tea") + "\n" + receive("There");
  CHECK(Delivery({}, nodes).run() == "parcel=[tea] c=tea");
  const std::string refused =
      "'{parcel}' carries a test.Parcel between processes, but the plugin of one of its uses has "
      "no to_bytes and from_bytes for it";
  CHECK(Delivery(kThere, nodes).run() == refused);
  CHECK(Delivery(kThere, send("There", "tea") + receive("Closed")).run() == refused);
  CHECK(Delivery({"parcel_closed"}, send("Closed", "tea"))
            .run()
            .find("cannot be isolated: the port 'parcel' of 'SendClosed' carries objects") !=
        std::string::npos);
}

}  // namespace
}  // namespace lockstep::host::test
