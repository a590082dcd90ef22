// Any bytes as a tree of built-in nodes and mock leaves: loaded, and if it is right ticked a
// hundred times under both fault policies. After each tick the laws of the life of a node hold, and
// a restarted run is the run once more.
#include <optional>
#include <string>

#include "engine/compile.h"
#include "mock_leaf.h"
#include "require.h"
#include "run/loading/plugins.h"
#include "run/run.h"
#include "tree/resolve.h"
#include "tree_from_bytes.h"

namespace fuzz_run_target {
namespace {

using namespace lockstep::host;
using fuzz::begin_tick;
using fuzz::require;

constexpr int kTicks = 100;
constexpr std::size_t kMaxTickedNodes = 300;

// Nothing: it is refused, or too large to be ticked.
std::optional<Tree> load(const std::string& text, const PluginSet& plugins) {
  Diagnostics diagnostics;
  const auto project = load_project_text("/nowhere/tree.xml", text, {}, diagnostics);
  require(project != nullptr, "what the generator writes is XML");
  const auto definition = resolve(*project, make_catalog(plugins), {}, diagnostics);
  require(definition.has_value() != diagnostics.has_errors(), "a definition, or errors");
  if (!definition || definition->nodes.size() > kMaxTickedNodes) return std::nullopt;
  return compile(*definition);
}

void check_activities(const Ticker& ticker) {
  const Tree& tree = ticker.tree();
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    const Status status = ticker.status(node);
    if (status == Status::Running) continue;
    for (NodeIndex below = node + 1; below < tree.nodes[node].end; ++below) {
      if (status == Status::Idle) {
        require(ticker.status(below) == Status::Idle, "an idle node has only idle descendants");
      } else {
        require(ticker.status(below) != Status::Running, "a completed one no running descendant");
      }
    }
  }
}

void check_progress(Ticker& ticker) {
  for (NodeIndex node = 0; node < ticker.tree().nodes.size(); ++node) {
    const double progress = ticker.progress(node);
    require(progress >= 0 && progress <= 1, "progress lies in [0, 1]");
    if (ticker.faulted()) return;
  }
}

// What its leaves were told.
std::string play(Run& run) {
  for (int i = 0; i < kTicks && run.fault() == nullptr; ++i) {
    begin_tick();
    const Status status = run.tick(i * run.period());
    if (run.fault() != nullptr) break;
    require(status != Status::Idle, "a tick does not return idle");
    check_activities(run.ticker());
    if (i % 2 == 0) check_progress(run.ticker());
    run.ticker().take_tolerated();
  }
  run.halt();
  for (NodeIndex node = 0; node < run.ticker().tree().nodes.size(); ++node) {
    require(run.ticker().status(node) != Status::Running, "nothing runs after a halt");
  }
  return fuzz::take_events();
}

void run_twice(const Tree& tree, FaultPolicy policy) {
  fuzz::take_events();
  {
    Run run(tree, {.seed = 1, .rate = 20, .on_fault = policy});
    const std::string first = play(run);
    run.restart(1);
    const std::string second = play(run);
    require(second.ends_with(first), "a restarted run is the run once more");
    require(policy == FaultPolicy::Stop || run.fault() == nullptr || run.fault()->in_last_halt ||
                first.find('t') == first.npos,
            "the run goes on after a fault");
  }
  require(fuzz::living_leaves() == 0, "every leaf is destroyed");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static PluginSet& plugins = []() -> PluginSet& {
    static PluginSet set;
    Diagnostics diagnostics;
    require(set.add(fuzz::kMockPlugin, "mock", diagnostics), "the mock plugin is one");
    return set;
  }();
  const auto tree = load(fuzz::tree_from_bytes({data, size}), plugins);
  if (!tree) return 0;
  run_twice(*tree, FaultPolicy::Stop);
  run_twice(*tree, FaultPolicy::Fail);
  return 0;
}

}  // namespace fuzz_run_target
