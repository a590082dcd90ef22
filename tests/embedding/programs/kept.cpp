// As kept.c, in the loop of the run and its virtual time: kept_cpp TREE FILE PERIOD [CUT_AT].
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <lockstep/runtime.hpp>

namespace {

namespace runtime = lockstep::runtime;
using lockstep::Status;

double cut_at = 1e9;

struct StepPorts : lockstep::Ports {
  Input<std::int64_t> ticks{this, "ticks", "1", "how many"};
};

class Step : public lockstep::Action<StepPorts>, public lockstep::Kept<std::int64_t> {
 public:
  void start() override { kept = 0; }
  Status tick() override {
    if (now() >= cut_at - 1e-9) std::raise(SIGKILL);
    return ++kept == ticks.get() ? Status::Success : Status::Running;
  }
  double progress() const override {
    return static_cast<double>(kept) / static_cast<double>(ticks.get());
  }
};

int run_tree(char** arguments) {
  runtime::Project project;
  project.add_leaf<Step>("Step", "Counts its ticks");
  project.load_file(arguments[1]);
  runtime::RunSettings settings;
  settings.tick_period = std::atof(arguments[3]);
  settings.virtual_time = true;
  runtime::Run run(project, settings);
  if (const auto resumed = run.keep(arguments[2])) {
    std::puts(resumed->text.c_str());
    for (const runtime::ResumedLeaf& leaf : resumed->leaves) {
      std::printf("leaf %d is %d at %.2f, asked %d\n", static_cast<int>(leaf.node),
                  leaf.status ? static_cast<int>(*leaf.status) : 0, leaf.progress, leaf.asked);
    }
  }
  const std::vector<runtime::NodeInfo> nodes = project.nodes();
  run.on_tick([&](std::uint64_t tick, double, Status) {
    std::printf("%d", static_cast<int>(tick));
    for (const runtime::NodeInfo& node : nodes) {
      const runtime::NodeState state = run.node(node.index);
      std::printf(" %d:%.2f%s", state.status ? static_cast<int>(*state.status) : 0, state.progress,
                  state.held ? "h" : "");
    }
    std::printf(" n=%d\n", static_cast<int>(run.get<std::int64_t>("n")));
    std::fflush(stdout);
  });
  runtime::LoopSettings loop;
  loop.virtual_clock = true;
  return run.loop(loop).status == Status::Success ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 4) return 2;
  if (count > 4) cut_at = std::atof(arguments[4]);
  try {
    return run_tree(arguments);
  } catch (const std::exception& error) {
    std::printf("error: %s\n", error.what());
    return 1;
  }
}
