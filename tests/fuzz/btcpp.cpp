// Any text as a tree for BehaviorTree.CPP, whose leaves are stand-ins: ends in errors with a place,
// or in a tree that ticks under both fault policies. After each tick the laws of the life of a node
// hold, and a restarted run is the run once more.
#include <cstdint>
#include <optional>
#include <string>

#include "dialect/btcpp/rules.h"
#include "engine/compile.h"
#include "language/document/language_of.h"
#include "require.h"
#include "run/loading/plugins.h"
#include "run/run.h"
#include "tree/resolve.h"

namespace fuzz_btcpp_target {
namespace {

using namespace lockstep::host;
using fuzz::require;

constexpr int kTicks = 40;
// A tick may be repeated ten thousand times: for ever, as the tree says.
constexpr std::size_t kMostTickedNodes = 60;
constexpr std::uint64_t kMostElements = 400;  // an expansion may be as large as the law allows

std::optional<Tree> load(const std::string& text) {
  const Catalog catalog = make_catalog({}, btcpp::kRules);
  Diagnostics diagnostics;
  const auto project = load_project_text("/nowhere/tree.xml", text, {}, diagnostics);
  if (project == nullptr) {
    require(diagnostics.has_errors(), "a project, or errors");
    return std::nullopt;
  }
  if (project->documents.front()->elements().size() > kMostElements) return std::nullopt;
  ResolveOptions options;
  options.unknown = MissingNodes::AreMocked;
  const auto definition = resolve(*project, catalog, options, diagnostics);
  require(definition.has_value() != diagnostics.has_errors(), "a definition, or errors");
  diagnostics.sort();
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    require(!render(diagnostic, false).empty(), "a diagnostic has a text");
  }
  if (!definition || definition->nodes.size() > kMostTickedNodes) return std::nullopt;
  return compile(*definition);
}

void check_nodes(Ticker& ticker) {
  const Tree& tree = ticker.tree();
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    const Status status = ticker.status(node);
    for (NodeIndex below = node + 1; status != Status::Running && below < tree.nodes[node].end;
         ++below) {
      require(ticker.status(below) != Status::Running, "what runs is below running nodes only");
    }
    const double progress = ticker.progress(node);
    require(progress >= 0 && progress <= 1, "progress lies in [0, 1]");
    if (ticker.faulted()) return;
  }
}

// The statuses of all nodes after each tick.
std::string play(Run& run) {
  std::string statuses;
  int faults = 0;
  for (int i = 0; i < kTicks && run.fault() == nullptr && faults < 3; ++i) {
    const Status status = run.tick(i * run.period());
    require(status != Status::Idle, "a tick does not return idle");
    if (run.fault() != nullptr) break;
    check_nodes(run.ticker());
    faults += run.ticker().take_tolerated().empty() ? 0 : 1;  // such a tick may have been endless
    const Tree& tree = run.ticker().tree();
    for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
      statuses += static_cast<char>('0' + static_cast<int>(run.ticker().activity(node)));
    }
  }
  run.halt();
  for (NodeIndex node = 0; node < run.ticker().tree().nodes.size(); ++node) {
    require(run.ticker().status(node) != Status::Running, "nothing runs after a halt");
  }
  return statuses;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (&language_of(text) != &btcpp::kRules) return 0;
  const auto tree = load(text);
  if (!tree) return 0;
  for (const FaultPolicy policy : {FaultPolicy::Stop, FaultPolicy::Fail}) {
    Run run(*tree, {.rate = 20, .on_fault = policy});
    const std::string first = play(run);
    run.restart(0);
    require(play(run) == first, "a restarted run is the run once more");
  }
  return 0;
}

}  // namespace fuzz_btcpp_target
