// Sets ports that the tree may leave out, and says what it reads before and after.
#include <lockstep/leaf.hpp>

namespace {

using lockstep::Status;

struct UnboundPorts : lockstep::Ports {
  Output<double> out{this, "out", "is set to 1"};
  InOut<double> both{this, "both", "0.25", "is set to 2"};
};

class Unbound : public lockstep::Action<UnboundPorts> {
 public:
  void start() override { ticks_ = 0; }
  Status tick() override {
    say();
    if (++ticks_ == 2) return Status::Success;
    out.set(1);
    both.set(2);
    say();
    return Status::Running;
  }

 private:
  void say() { log(both.get() == 0.25 ? "both 0.25" : "both 2"); }

  int ticks_ = 0;
};

}  // namespace

LOCKSTEP_PLUGIN("unbound", "1.0", "A leaf that sets what nobody may have bound",
                lockstep::leaf<Unbound>("Unbound", "sets its ports in its first tick"));
