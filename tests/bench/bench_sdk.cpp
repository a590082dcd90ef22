// The cheapest leaf in C++, and a Sequence: what lockstep/leaf.hpp costs.
#include <lockstep/leaf.hpp>

namespace {

class SdkSuccess : public lockstep::Action<> {
 public:
  Status tick() override { return Status::Success; }
};

struct ReadPorts : lockstep::Ports {
  Input<double> a{this, "a", required, "a number"};
};
class SdkRead : public lockstep::Action<ReadPorts> {
 public:
  Status tick() override {
    const auto value = a.try_get();
    return value && *value >= 0 ? Status::Success : Status::Failure;
  }
};

struct TwoPorts : lockstep::Ports {
  Input<double> a{this, "a", required, "a number"};
  Input<double> b{this, "b", required, "another one"};
};
class SdkTwo : public lockstep::Action<TwoPorts> {
 public:
  Status tick() override { return a.get() < b.get() ? Status::Running : Status::Failure; }
};

class SdkKeeps : public lockstep::ProgressAction<> {
 public:
  Status tick() override {
    set_progress(0.5);
    return Status::Running;
  }
};

class SdkSequence : public lockstep::Control<> {
 public:
  Status tick() override {
    const std::uint32_t count = child_count();
    for (std::uint32_t child = 0; child < count; ++child) {
      const Status status = tick_child(child);
      if (status != Status::Success) return status;
    }
    return Status::Success;
  }
};

}  // namespace

LOCKSTEP_PLUGIN("bench_sdk", "1.0", "For benchmarks",
                lockstep::leaf<SdkSuccess>("SdkSuccess", "Succeeds"),
                lockstep::leaf<SdkRead>("SdkRead", "Reads a port"),
                lockstep::leaf<SdkTwo>("SdkTwo", "Reads two ports"),
                lockstep::leaf<SdkKeeps>("SdkKeeps", "Runs, and keeps its progress"),
                lockstep::leaf<SdkSequence>("SdkSequence", "A Sequence without memory"));
