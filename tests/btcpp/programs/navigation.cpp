// Random trees of nodes for navigation: what each leaf does, and the status after each tick.
#include <iostream>
#include <random>

#include "../leaves/navigation_nodes.h"

using namespace BT;

// Makes a tree; the same of the same seed, everywhere.
class Maker {
 public:
  explicit Maker(unsigned seed) : random_(seed) {}
  std::string tree() {
    return "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\">" + node(4) +
           "</BehaviorTree></root>";
  }
  int below(int end) { return static_cast<int>(random_() % static_cast<unsigned>(end)); }

 private:
  std::string leaf() {
    static const char* const kAnswers[] = {"S",    "F",  "RS",  "RF",     "RRS",
                                           "RRRF", "SF", "RSF", "RRRRRS", "R"};
    const std::string number = std::to_string(++leaves_);
    const std::string answers = std::string(" answers=\"") + kAnswers[below(10)] + "\"/>";
    const int kind = below(5);
    if (kind < 2)
      return "<ComputePathToPose name=\"plan" + number + "\" goal=\"{goal}\" path=\"{path}\"" +
             answers;
    if (kind < 4) return "<FollowPath name=\"follow" + number + "\" path=\"{path}\"" + answers;
    return "<GoalUpdated name=\"goal" + number + "\"/>";
  }
  std::string nodes(int depth, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) all += node(depth);
    return all;
  }
  std::string control(const std::string& id, int depth, int count, const std::string& ports = {}) {
    return "<" + id + ports + ">" + nodes(depth - 1, count) + "</" + id + ">";
  }
  std::string node(int depth) {
    if (depth == 0) return leaf();
    switch (below(15)) {
      case 0:
      case 1:
      case 2:
        return control("PipelineSequence", depth, 1 + below(3));
      case 3:
      case 4:
        return control("RoundRobin", depth, 1 + below(3));
      case 5:
      case 6:
        return control("RecoveryNode", depth, 2,
                       " number_of_retries=\"" + std::to_string(below(4)) + "\"");
      case 7:
        return control("RateController", depth, 1, below(2) == 0 ? " hz=\"2.0\"" : " hz=\"1\"");
      case 8:
        return control("DistanceController", depth, 1, " distance=\"0.5\"");
      case 9:
        return control("SpeedController", depth, 1,
                       below(2) == 0 ? "" : " min_rate=\"0.1\" max_rate=\"2\"");
      case 10:
        return control("GoalUpdater", depth, 1, " input_goal=\"{goal}\" output_goal=\"{goal}\"");
      case 11:
        return control("ReactiveFallback", depth, 2);
      case 12:
        return control("Sequence", depth, 2);
      case 13:
        return control("KeepRunningUntilFailure", depth, 1);
      default:
        return leaf();
    }
  }

  std::mt19937 random_;
  int leaves_ = 0;
};

static void run(unsigned seed) {
  Maker maker(seed);
  const auto robot = std::make_shared<navigation::Robot>();
  robot->log = [](const std::string& text) { std::cout << "  " << text << std::endl; };
  BehaviorTreeFactory factory;
  navigation::register_nodes(factory, robot);
  const std::string text = maker.tree();
  std::cout << "tree " << seed << std::endl;
  auto tree = factory.createTreeFromText(text);
  for (int tick = 0; tick < 12; ++tick) {
    const NodeStatus status = tree.tickOnce();
    std::cout << " " << toStr(status) << std::endl;
    robot->seconds += 0.25;
    robot->x += robot->speed * 0.5;
    robot->speed = maker.below(3) * 0.5;
    robot->goal += maker.below(4) == 0 ? 1 : 0;
  }
  std::cout << " halted" << std::endl;
  tree.haltTree();
}

int main(int count, char** arguments) {
  const unsigned from = count > 2 ? static_cast<unsigned>(std::stoul(arguments[1])) : 0;
  const unsigned end = count > 2 ? static_cast<unsigned>(std::stoul(arguments[2])) : 60;
  for (unsigned seed = from; seed < end; ++seed) run(seed);
  return 0;
}
