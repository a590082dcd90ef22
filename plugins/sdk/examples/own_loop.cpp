// A program with its own loop at 100 Hz, and with the leaves of its robot: two arms that reach
// out and wait for each other at half of the way. Ends with the time at which each arm was there.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <lockstep/runtime.hpp>
#include <thread>

namespace {

using lockstep::Status;
namespace runtime = lockstep::runtime;

struct ReachPorts : lockstep::Ports {
  Input<double> speed{this, "speed", "0.5", "share of the way per second", "1/s"};
  Output<double> reached{this, "reached", "when the hand was there", "s"};
};

// Moves a hand by a step in each tick. A real one would send a command here.
class Reach : public lockstep::Action<ReachPorts> {
 public:
  void start() override { way_ = 0; }
  Status tick() override {
    way_ = std::min(1.0, way_ + speed.get() * tick_period());
    if (way_ < 1) return Status::Running;
    reached.set(now());
    return Status::Success;
  }
  double progress() const override { return way_; }

 private:
  double way_ = 0;
};

constexpr const char* kTree = R"(
  <root lockstep="1">
    <BehaviorTree ID="Main">
      <ParallelAbsolute name="both" barriers="0.5">
        <Reach name="left" speed="2" reached="{left_reached}"/>
        <Reach name="right" speed="{right_speed}" reached="{right_reached}"/>
      </ParallelAbsolute>
    </BehaviorTree>
  </root>)";

int run() {
  runtime::Project project;
  project.add_leaf<Reach>("Reach", "Moves a hand");
  project.set_value("right_speed", "1");
  project.load_text(kTree);
  const std::uint32_t left = project.find_node("Main/both/left");

  runtime::Run tree(project);
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  int held = 0;
  Status status = Status::Running;
  for (int cycle = 0; status == Status::Running; ++cycle) {
    const auto deadline = start + cycle * std::chrono::milliseconds(10);
    std::this_thread::sleep_until(deadline);
    // Everything else that the program does in a cycle is here.
    status = tree.tick(std::chrono::duration<double>(deadline - start).count());
    held += tree.node(left).held ? 1 : 0;
    if (cycle == 60) tree.set("right_speed", 2.0);
  }
  std::printf("%s: left at %.2f s (held for %d ticks), right at %.2f s\n",
              status == Status::Success ? "success" : "failure", tree.get<double>("left_reached"),
              held, tree.get<double>("right_reached"));
  return status == Status::Success ? 0 : 1;
}

}  // namespace

int main() {
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "own_loop: %s\n", error.what());
    return 2;
  }
}
