#include "language/robot_plugin.h"

#include <algorithm>
#include <lockstep/leaf.hpp>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace {

using lockstep::host::test::said;

struct FindPorts : lockstep::Ports {
  Input<std::string> sees{this, "sees", "front door", "what there is to be found"};
  Output<std::string> door{this, "door", "the door that was found"};
};

class FindDoor : public lockstep::Action<FindPorts> {
 public:
  Status tick() override {
    door.set(sees.get());
    return Status::Success;
  }
};

struct GoToPorts : lockstep::Ports {
  Input<std::string> target{this, "target", required, "where to go"};
  Input<double> speed{this, "speed", "0.5", "progress per tick"};
};

class GoTo : public lockstep::Action<GoToPorts> {
 public:
  void start() override {
    progress_ = 0;
    said.push_back("go to " + target.get());
  }
  Status tick() override {
    progress_ = std::min(1.0, progress_ + speed.get());
    return progress_ == 1.0 ? Status::Success : Status::Running;
  }
  double progress() const override { return progress_; }

 private:
  double progress_ = 0;
};

struct SayPorts : lockstep::Ports {
  Input<std::string> text{this, "text", required, "what to say"};
};

class Say : public lockstep::Action<SayPorts> {
 public:
  Status tick() override {
    said.push_back(text.get());
    return Status::Success;
  }
};

struct CountPorts : lockstep::Ports {
  InOut<std::int64_t> total{this, "total", required, "what is counted up"};
};

class Count : public lockstep::Action<CountPorts> {
 public:
  Status tick() override {
    total.set(total.try_get().value_or(0) + 1);
    said.push_back(std::to_string(total.get()));
    return Status::Success;
  }
};

struct TallyPorts : lockstep::Ports {
  InOut<std::int64_t> sum{this, "sum", "10", "what is counted up"};
};

class Tally : public lockstep::Action<TallyPorts> {
 public:
  Status tick() override {
    sum.set(sum.get() + 1);
    said.push_back(std::to_string(sum.get()));
    return Status::Success;
  }
};

struct ShowPorts : lockstep::Ports {
  Input<bool> flag{this, "flag", "false", "a bool"};
  Input<std::int64_t> count{this, "count", "0", "an int"};
  Input<double> speed{this, "speed", "0", "a double"};
  Input<std::string> text{this, "text", "", "a string"};
  Input<std::vector<double>> points{this, "points", "", "a list"};
};

class Show : public lockstep::Action<ShowPorts> {
 public:
  Status tick() override {
    std::ostringstream line;
    line << std::boolalpha << flag.get() << ' ' << count.get() << ' ' << speed.get() << " '"
         << text.get() << "' [";
    for (const double point : points.get()) line << point << ';';
    line << ']';
    said.push_back(line.str());
    return Status::Success;
  }
};

struct ListPorts : lockstep::Ports {
  Input<std::vector<std::int64_t>> steps{this, "steps", "1;2", "a list of int"};
  Input<std::vector<bool>> flags{this, "flags", "true;false", "a list of bool"};
  InOut<std::vector<std::string>> doors{this, "doors", "red;blue", "a list of strings"};
  Output<std::vector<std::int64_t>> next{this, "next", "the steps, each one more"};
  Output<std::vector<bool>> inverse{this, "inverse", "the flags, inverted"};
};

class ShowLists : public lockstep::Action<ListPorts> {
 public:
  Status tick() override {
    std::ostringstream line;
    line << std::boolalpha;
    std::vector<std::int64_t> larger;
    for (const std::int64_t step : steps.view()) {
      line << step << ',';
      larger.push_back(step + 1);
    }
    std::vector<bool> inverted;
    for (const bool flag : flags.get()) {
      line << flag << ',';
      inverted.push_back(!flag);
    }
    std::vector<std::string> longer = doors.get();
    for (const std::string_view door : doors.view()) line << '\'' << door << "',";
    longer.emplace_back("a;b");
    next.set(larger);
    inverse.set(inverted);
    doors.set(longer);
    said.push_back(line.str());
    return Status::Success;
  }
};

enum class Grip { Soft, Firm };

}  // namespace

LOCKSTEP_CHOICES(Grip, "soft;firm");

namespace {

struct HoldPorts : lockstep::Ports {
  Input<Grip> grip{this, "grip", "soft", "how it holds"};
  Input<double> force{this, "force", "5", "how much", "N", between(0, 20)};
  Input<std::int64_t> fingers{this, "fingers", "2", "how many", at_least(1)};
  Input<std::string> hand{this, "hand", "left", "which one", one_of("left;right")};
  Input<std::vector<double>> angles{this, "angles", "", "of the fingers", at_most(1.5)};
  Output<Grip> used{this, "used", "how it has held"};
  Output<double> reached{this, "reached", "how much it was", "N", at_most(22)};
};

class Hold : public lockstep::Action<HoldPorts> {
 public:
  Status tick() override {
    std::ostringstream line;
    line << (grip.get() == Grip::Firm ? "firm " : "soft ") << force.get() << ' ' << fingers.get()
         << ' ' << hand.get() << ' ' << angles.view().size();
    used.set(grip.get());
    reached.set(force.get() + static_cast<double>(angles.view().size()));
    said.push_back(line.str());
    return Status::Success;
  }
};

// Counts itself.
struct Alive {
  Alive() { ++lockstep::host::test::objects_alive; }
  Alive(const Alive&) { ++lockstep::host::test::objects_alive; }
  Alive& operator=(const Alive&) = default;
  ~Alive() { --lockstep::host::test::objects_alive; }
};

struct Pose {
  double x = 0, y = 0;
  Alive alive = {};
};

std::string to_text(const Pose& pose) {
  std::ostringstream text;
  text << pose.x << ';' << pose.y;
  return text.str();
}

bool from_text(std::string_view text, Pose& pose) {
  std::istringstream in{std::string(text)};
  char separator = 0;
  if (text == "throw") throw std::runtime_error("a pose that throws");
  return in >> pose.x >> separator >> pose.y && separator == ';' && in.peek() == EOF;
}

struct Route {
  std::vector<double> points;
  Alive alive = {};
};

}  // namespace

LOCKSTEP_OBJECT_TYPE(Pose, "robot.Pose");
LOCKSTEP_OBJECT_TYPE(Route, "robot.Route");

namespace {

struct PlanPorts : lockstep::Ports {
  Input<std::shared_ptr<const Pose>> goal{this, "goal", required, "where to go"};
  Output<std::shared_ptr<const Route>> route{this, "route", "how to get there"};
  Output<std::shared_ptr<const Pose>> half{this, "half", "half of the way"};
};

class Plan : public lockstep::Action<PlanPorts> {
 public:
  Status tick() override {
    const auto pose = goal.get();
    route.set(std::make_shared<Route>(Route{{0, 0, pose->x, pose->y}}));
    half.set(std::make_shared<Pose>(Pose{pose->x / 2, pose->y / 2}));
    said.push_back("plan to " + to_text(*pose));
    return Status::Success;
  }
};

struct FollowPorts : lockstep::Ports {
  InOut<std::shared_ptr<const Route>> route{this, "route", required, "where to go"};
};

// Makes the route shorter as it goes.
class Follow : public lockstep::Action<FollowPorts> {
 public:
  Status tick() override {
    const auto given = route.get();
    if (given->points.empty()) return Status::Success;
    route.set(std::make_shared<Route>(Route{{given->points.begin() + 2, given->points.end()}}));
    said.push_back("at " + std::to_string(given->points.size()));
    return route.set(nullptr) ? Status::Failure : Status::Running;
  }
};

struct MeasurePorts : lockstep::Ports {
  Input<lockstep::Number> value{this, "value", "1", "an int or a double"};
};

class Measure : public lockstep::Action<MeasurePorts> {
 public:
  Status tick() override {
    std::ostringstream line;
    line << (value.get().is_int() ? "int " : "double ") << value.get();
    said.push_back(line.str());
    return Status::Success;
  }
};

struct IsOpenPorts : lockstep::Ports {
  Input<bool> open{this, "open", "false", "whether the door is open"};
};

class IsOpen : public lockstep::Condition<IsOpenPorts> {
 public:
  bool check() override { return open.get(); }
};

// Ports with the names of parameters of built-in nodes.
struct EitherPorts : lockstep::Ports {
  Input<bool> memory{this, "memory", "false", "whether it is the second child"};
};

class Either : public lockstep::Control<EitherPorts> {
 public:
  Status tick() override { return tick_child(memory.get() ? 1 : 0); }
};

struct AtPorts : lockstep::Ports {
  Input<std::string> times{this, "times", required, "said before its child"};
};

class At : public lockstep::Decorator<AtPorts> {
 public:
  void start() override { said.push_back(times.get()); }
  Status tick() override { return tick_child(); }
};

}  // namespace

LOCKSTEP_PLUGIN_TABLE(robot_table, "robot", "1.0", "A robot that only says what it does",
                      lockstep::leaf<FindDoor>("FindDoor", "Finds a door."),
                      lockstep::leaf<GoTo>("GoTo", "Goes somewhere."),
                      lockstep::leaf<GoTo>("AlwaysReach",
                                           "The same, under a name like a built-in's."),
                      lockstep::leaf<Say>("Say", "Says a text."),
                      lockstep::leaf<Count>("Count", "Counts."),
                      lockstep::leaf<Tally>("Tally", "Counts from ten."),
                      lockstep::leaf<Show>("Show", "Shows its ports."),
                      lockstep::leaf<ShowLists>("ShowLists", "Shows lists, and sets longer ones."),
                      lockstep::leaf<Hold>("Hold", "Holds something."),
                      lockstep::leaf<Plan>("Plan", "Plans a route."),
                      lockstep::leaf<Follow>("Follow", "Follows a route."),
                      lockstep::leaf<Measure>("Measure", "Shows a number."),
                      lockstep::leaf<IsOpen>("IsOpen", "Whether a door is open."),
                      lockstep::leaf<Either>("Either", "One of its children."),
                      lockstep::leaf<At>("At", "Says when."));

namespace lockstep::host::test {

const lockstep_plugin& robot_plugin() {
  return robot_table;
}

}  // namespace lockstep::host::test
