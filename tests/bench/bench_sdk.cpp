// The cheapest leaf in C++: what lockstep/leaf.hpp costs.
#include <lockstep/leaf.hpp>

namespace {

class SdkSuccess : public lockstep::Action<> {
 public:
  Status tick() override { return Status::Success; }
};

}  // namespace

LOCKSTEP_PLUGIN("bench_sdk", "1.0", "For benchmarks",
                lockstep::leaf<SdkSuccess>("SdkSuccess", "Succeeds"));
