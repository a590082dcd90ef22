// The words of a crash report.
#include "run/crash_text.h"

#include <signal.h>

#include <catch2/catch.hpp>
#include <string>

namespace lockstep::host::test {
namespace {

const CallSite& kCrashedLeaf =
    CallSite::of({.path = "Main/arm", .id = "Advance", .plugin = "motion"});
const CallSite& kMotion = CallSite::of_plugin("motion");

CallMark::Look in(const CallSite& site, PluginFunction function) {
  return {.site = &site, .function = function};
}

std::string first_line(const Crash& crash) {
  SignalText text;
  describe(crash, text);
  return std::string(text.text().substr(0, text.text().find('\n')));
}

Crash segv(const CallMark::Look& call) {
  return {.kind = CrashKind::Signal,
          .call = call,
          .tick = 12,
          .signal = SIGSEGV,
          .code = SEGV_MAPERR,
          .address = 0x1f};
}

TEST_CASE("a crash is reported with the function it was in") {
  const std::string begin = "lockstep: error: the leaf 'Main/arm' (Advance of plugin 'motion') ";
  const std::string end = ": SIGSEGV, invalid memory reference (address 0x1f)";
  using F = PluginFunction;
  CHECK(first_line(segv(in(kCrashedLeaf, F::Tick))) == begin + "crashed in tick 12" + end);
  CHECK(first_line(segv(in(kCrashedLeaf, F::Halt))) ==
        begin + "crashed in its halt function (tick 12)" + end);
  CHECK(first_line(segv(in(kCrashedLeaf, F::Create))) ==
        begin + "crashed in its create function" + end);
  Crash before_ticks = segv(in(kCrashedLeaf, F::Start));
  before_ticks.tick = CallMark::kNoTick;
  CHECK(first_line(before_ticks) == begin + "crashed in its start function" + end);
  CHECK(first_line(segv(in(kMotion, F::Init))) ==
        "lockstep: error: the plugin 'motion' crashed in its init function" + end);
  CHECK(first_line(segv(in(kMotion, F::Load))) ==
        "lockstep: error: the plugin 'motion' crashed in the loading of its shared object" + end);
}

TEST_CASE("a crash names what it was in, and isolation only where it would help") {
  const auto said = [](const CallSite& site) {
    SignalText text;
    describe(segv(in(site, PluginFunction::Tick)), text);
    return std::string(text.text());
  };
  const CallSite& node = CallSite::of({.path = "Main/retry",
                                       .id = "RecoveryNode",
                                       .plugin = "nav",
                                       .kind = CallSite::kControlNode,
                                       .is_local = true});
  CHECK(said(node).starts_with("lockstep: error: the control node 'Main/retry' (RecoveryNode of "));
  CHECK(said(node).find("--isolate") == std::string::npos);
  CHECK(said(node).find("the author of the plugin needs the backtrace") != std::string::npos);
  CHECK(said(kCrashedLeaf).find("with --isolate --on-fault fail, the run survives") !=
        std::string::npos);
  const CallSite& leaf =
      CallSite::of({.path = "Main/arm", .id = "Advance", .plugin = "motion", .is_local = true});
  CHECK(said(leaf).find("--isolate") == std::string::npos);
}

TEST_CASE("a crash outside of all calls is somebody else's") {
  Crash crash = segv({});
  const std::string end = " crashed: SIGSEGV, invalid memory reference (address 0x1f)";
  CHECK(first_line(crash) == "lockstep: error: lockstep" + end);
  crash.is_foreign_thread = true;
  CHECK(first_line(crash) == "lockstep: error: a thread that a plugin has started" + end);
}

TEST_CASE("a crash of lockstep is a bug in lockstep, and tells the last call to a leaf") {
  const auto said = [](const CallSite& site) {
    SignalText text;
    describe(segv({.site = &site}), text);
    return std::string(text.text());
  };
  CHECK(said(kCrashedLeaf).find("hint: it is a bug in lockstep") != std::string::npos);
  CHECK(said(kCrashedLeaf).find("the last call was to the leaf 'Main/arm'") != std::string::npos);
  // A plugin that was only opened is not blamed.
  CHECK(said(kMotion).find("hint: it is a bug in lockstep") != std::string::npos);
  CHECK(said(kMotion).find("motion") == std::string::npos);
  CHECK(said(kMotion).find("--isolate") == std::string::npos);
}

TEST_CASE("a crash by an exception of floating-point numbers is no bug in lockstep") {
  Crash crash = segv({.site = &kCrashedLeaf});
  crash.signal = SIGFPE;
  for (const auto& [code, is_bug] : {std::pair(FPE_FLTDIV, false), std::pair(FPE_INTDIV, true)}) {
    crash.code = code;
    SignalText text;
    describe(crash, text);
    CHECK((text.text().find("bug in lockstep") != std::string::npos) == is_bug);
    CHECK((text.text().find("a plugin has enabled floating-point") != std::string::npos) != is_bug);
  }
}

TEST_CASE("a crash in a study is reported with its run") {
  Crash crash = segv(in(kCrashedLeaf, PluginFunction::Tick));
  crash.run = {.cell = 3, .number = 17, .seed = 1234};
  SignalText text;
  describe(crash, text);
  CHECK(std::string(text.text()).find("hint: this was run 17 of cell 3, with the seed 1234\n") !=
        std::string::npos);
}

TEST_CASE("exit and hang are reported with the function they were in") {
  const std::string begin = "lockstep: error: the leaf 'Main/arm' (Advance of plugin 'motion') ";
  Crash crash{.kind = CrashKind::Exit, .call = in(kCrashedLeaf, PluginFunction::Tick), .tick = 0};
  CHECK(first_line(crash) == begin + "called exit() in tick 0");
  crash.call = {};
  crash.is_foreign_thread = true;
  CHECK(first_line(crash) ==
        "lockstep: error: a thread that a plugin has started called exit() before the work was "
        "done");
  crash = {.kind = CrashKind::Hang,
           .call = in(kCrashedLeaf, PluginFunction::Tick),
           .tick = 3,
           .seconds = 1.96};
  CHECK(first_line(crash) == begin + "has not returned from tick 3 for 2.0 s");
  crash.call = in(kCrashedLeaf, PluginFunction::Resume);
  CHECK(first_line(crash) ==
        begin + "has not returned from its resume function for 2.0 s (tick 3)");
  crash.call = {.site = &kCrashedLeaf};  // it just has
  CHECK(first_line(crash) == begin + "has not returned from a call for 2.0 s");
}

TEST_CASE("a signal from another process is not the leaf's") {
  Crash crash = segv(in(kCrashedLeaf, PluginFunction::Tick));
  crash.code = SI_USER;
  crash.sender = 4711;
  CHECK(first_line(crash) ==
        "lockstep: error: process 4711 sent SIGSEGV while the leaf 'Main/arm' (Advance of plugin "
        "'motion') was in tick 12");
  crash.call = {};
  CHECK(first_line(crash) ==
        "lockstep: error: process 4711 sent SIGSEGV while lockstep was at work");
}

TEST_CASE("a text that is too long is cut") {
  SignalText text;
  for (int i = 0; i < 1000; ++i) text << "0123456789";
  CHECK(text.text().size() == 4096);
  CHECK(text.text().substr(4090) == "012345");
}

}  // namespace
}  // namespace lockstep::host::test
