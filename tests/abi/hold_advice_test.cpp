// `check` speaks of leaves whose robots may go on while they are held.
#include <catch2/catch.hpp>

#include "abi/support/isolated_leaves.h"
#include "run/loading/load.h"

namespace lockstep::host::test {
namespace {

// Warnings and notes, "line: message | hint".
Strings advice(const std::string& tree) {
  LoadOptions options;
  options.plugins.directories = {LOCKSTEP_ABI_PLUGINS};
  options.plugins.program_directory = LOCKSTEP_BINARY_DIR;
  Diagnostics diagnostics;
  const std::string text = "<root lockstep=\"1\"><plugin name=\"holdable\"/>" + tree + "</root>";
  CHECK(load_text("tree.xml", text, options, diagnostics));
  Strings all;
  for (const Diagnostic& it : diagnostics.all()) {
    if (it.message.find("robot") == std::string::npos) continue;
    all.push_back(fmt::format("{}: {} | {}", it.location.line, it.message, it.hint));
  }
  return all;
}

std::string in(const std::string& node, const std::string& leaves) {
  const std::string tag = node.substr(0, node.find(' '));
  return "<BehaviorTree ID=\"T\"><" + node + ">" + leaves + "</" + tag + "></BehaviorTree>";
}

TEST_CASE("a leaf that may be held is asked what its robot does then") {
  const std::string undecided = "<Probe name=\"a\"/>\n<Sequence><Probe name=\"b\"/></Sequence>";
  CHECK(advice(in("ParallelAbsolute barriers=\"0.5\"", undecided)) ==
        Strings{"1: 'a' may be held by 'ParallelAbsolute', and does not declare what the robot "
                "does then | give hold; `lockstep nodes Probe` has the ways",
                "2: 'b' may be held by 'ParallelAbsolute', and does not declare what the robot "
                "does then | give hold; `lockstep nodes Probe` has the ways"});
  CHECK(advice(in("Parallel", undecided)).empty());
}

TEST_CASE("a robot that goes on is named, one that is held is not") {
  const std::string decided = "<Probe name=\"a\" hold=\"nothing\"/><Probe hold=\"cancel\"/>";
  CHECK(advice(in("ParallelRelative delta=\"0.1\"", decided)) ==
        Strings{"1: while 'ParallelRelative' holds 'a', the robot continues: hold=\"nothing\" | "});
}

TEST_CASE("a member of a barrier may be held, too") {
  CHECK(advice("<barrier name=\"half\" barriers=\"0.5\"/><BehaviorTree ID=\"T\"><Parallel>"
               "<SyncProgress barrier=\"half\"><Probe name=\"a\"/></SyncProgress>"
               "<SyncProgress barrier=\"half\"><Probe name=\"b\" hold=\"cancel\"/></SyncProgress>"
               "</Parallel></BehaviorTree>") ==
        Strings{"1: 'a' may be held by 'half', and does not declare what the robot does then | "
                "give hold; `lockstep nodes Probe` has the ways"});
}

}  // namespace
}  // namespace lockstep::host::test
