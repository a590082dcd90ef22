// The plugin of 1.0. frozen.so beside it was built from this source, with the headers of that
// version, by
//   g++ -std=c++20 -O2 -shared -fPIC -fvisibility=hidden -Iplugins/sdk frozen.cpp -o frozen.so &&
//   strip frozen.so
#include <lockstep/leaf.hpp>

#include <algorithm>

namespace {

struct MovePorts : lockstep::Ports {
  Input<double> step{this, "step", required, "progress per tick"};
  Input<double> noise{this, "noise", "0", "of a step"};
  Output<double> moved{this, "moved", "the way so far"};
};

class Move : public lockstep::ProgressAction<MovePorts> {
 public:
  void start() override { way_ = 0; }
  Status tick() override {
    way_ = std::clamp(way_ + step.get() + uniform(-noise.get(), noise.get()), 0.0, 1.0);
    moved.set(way_);
    set_progress(way_);
    return way_ >= 1 ? Status::Success : Status::Running;
  }
  void pause() override { log("pause"); }
  void resume() override { log("resume"); }
  void halt() override { log("halt"); }

 private:
  double way_ = 0;
};

struct NotePorts : lockstep::Ports {
  Input<double> text{this, "text", required, "a number"};
  Input<std::vector<double>> list{this, "list", "1;2", "a list"};
  Input<std::int64_t> whole{this, "whole", "1", "a whole number"};
  Input<bool> flag{this, "flag", "false", "yes or no"};
};

class Note : public lockstep::Action<NotePorts> {
 public:
  Status tick() override {
    const auto all = list.get();
    log("note " + std::to_string(text.get()) + " " + std::to_string(all.size()) + " " +
        std::to_string(whole.get()) + (flag.get() ? " yes" : " no"));
    return Status::Success;
  }
};

}  // namespace

LOCKSTEP_PLUGIN("frozen", "1.0.0", "What 1.0 could do", lockstep::leaf<Move>("Move", "moves"),
                lockstep::leaf<Note>("Note", "logs"));
