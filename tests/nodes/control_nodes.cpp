#include "nodes/control_nodes.h"

#include <lockstep/leaf.hpp>
#include <thread>

namespace lockstep::host::test {

std::function<void(const char*)> watching_seen;

namespace {

// Ticks its children from the left, as Sequence does.
class InOrder : public Control<> {
 public:
  Status tick() override {
    for (std::uint32_t child = 0; child < child_count(); ++child) {
      const Status status = tick_child(child);
      if (status != Status::Success) return status;
    }
    return Status::Success;
  }
};

// Ticks all children; has the result of the first one.
class First : public Control<> {
 public:
  Status tick() override {
    const Status status = tick_child(0);
    for (std::uint32_t child = 1; child < child_count(); ++child) tick_child(child);
    return status;
  }
};

// Ticks its child in every second tick, and holds it in between.
class Every : public Decorator<> {
 public:
  void start() override { ticks_ = 0; }
  Status tick() override {
    if (ticks_++ % 2 == 0) return tick_child();
    pause_child();
    return Status::Running;
  }

 private:
  int ticks_ = 0;
};

// Halts its child in the second tick.
class Halts : public Decorator<> {
 public:
  void start() override { ticks_ = 0; }
  Status tick() override {
    if (++ticks_ != 2) return tick_child();
    halt_child();
    return child_status() ? Status::Failure : Status::Running;
  }

 private:
  int ticks_ = 0;
};

struct BreachPorts : Ports {
  Input<std::string> what{this, "what", required, "what it does wrong"};
};

class Breach : public Control<BreachPorts> {
 public:
  void start() override {
    if (what.view() == "tick_in_start") tick_child(0);
  }
  Status tick() override {
    if (what.view() == "twice") tick_child(0);
    if (what.view() == "index") tick_child(7);
    if (what.view() == "after") throw std::runtime_error("broken");
    if (what.view() == "status") return static_cast<Status>(LOCKSTEP_IDLE);
    tick_child(0);
    return child_status(child_count()) ? Status::Success : Status::Failure;
  }
  void halt() override {
    if (what.view() == "halt_in_halt") halt_child(0);
  }
  double progress() const override { return child_progress(1); }
};

class TickInHalt : public Decorator<> {
 public:
  Status tick() override { return tick_child(); }
  void halt() override { tick_child(); }
};

// Reports what its child has done when it is called.
class Watching : public Decorator<> {
 public:
  Status tick() override { return tick_child(); }
  void halt() override { watching_seen("halt"); }
  void pause() override { watching_seen("pause"); }
  void resume() override { watching_seen("resume"); }
};

// Its halt comes before that of its children, and is a fault.
class HaltsFirst : public Control<> {
 public:
  Status tick() override {
    for (std::uint32_t child = 0; child < child_count(); ++child) tick_child(child);
    return Status::Running;
  }
  void halt() override {
    watching_seen("halt");
    throw std::runtime_error("broken");
  }
};

constexpr lockstep_leaf_type halts_first() {
  lockstep_leaf_type type = leaf<HaltsFirst>("HaltsFirst", "");
  type.flags |= LOCKSTEP_HALTS_CHILDREN;
  return type;
}

class OtherThread : public Decorator<> {
 public:
  Status tick() override {
    Status status{};
    std::thread([&] { status = tick_child(); }).join();
    return status;
  }
};

}  // namespace

LOCKSTEP_PLUGIN_TABLE(kTable, "tests", "1.0", "Control nodes for tests",
                      leaf<InOrder>("InOrder", ""), leaf<First>("First", ""),
                      leaf<Every>("Every", ""), leaf<Halts>("Halts", ""),
                      leaf<Breach>("Breach", ""), leaf<TickInHalt>("TickInHalt", ""),
                      leaf<Watching>("Watching", ""), leaf<OtherThread>("OtherThread", ""),
                      halts_first());

const lockstep_plugin& kControlNodes = kTable;

}  // namespace lockstep::host::test
