// Laws of BT::Blackboard: by itself, in the constructors and ticks of nodes, from other threads,
// and before, during and after the life of a tree.
#include <atomic>
#include <iostream>
#include <thread>

#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/json_export.h"
#include "behaviortree_cpp/scripting/script_parser.hpp"

using namespace BT;

static void law(const std::string& what, bool holds) {
  std::cout << (holds ? "" : "NOT: ") << what << std::endl;
}

template <class Error = std::exception, class Call>
static bool throws(Call call) {
  try {
    call();
  } catch (const Error&) {
    return true;
  } catch (...) {
  }
  return false;
}

struct Driver {
  int calls = 0;
};
struct Point {
  double x = 0, y = 0;
};
BT_JSON_CONVERTER(Point, point) {
  add_field("x", &point.x);
  add_field("y", &point.y);
}

// Finds what all nodes share where it is made, and counts in an entry that nothing else names.
class Drive : public SyncActionNode {
 public:
  Drive(const std::string& name, const NodeConfig& config)
      : SyncActionNode(name, config),
        driver_(config.blackboard->get<std::shared_ptr<Driver>>("driver")) {
    config.blackboard->set("made", config.blackboard->rootBlackboard()->get<int>("before") + 1);
  }
  static PortsList providedPorts() {
    return {InputPort<int>("speed"), OutputPort<Point>("where"),
            InputPort<std::uint8_t>("small", 0, "")};
  }
  NodeStatus tick() override {
    ++driver_->calls;
    Timestamp stamp;
    int speed = 0;
    if (const auto read = getInputStamped("speed", speed)) stamp = *read;
    setOutput("where", Point{1.0 * speed, static_cast<double>(stamp.seq)});
    int count = 0;
    static_cast<void>(config().blackboard->get("count", count));
    config().blackboard->set("count", count + 1);
    return NodeStatus::SUCCESS;
  }

 private:
  std::shared_ptr<Driver> driver_;
};

static void by_itself() {
  const auto board = Blackboard::create();
  board->set("n", 3);
  law("a number keeps its value and type", board->get<int>("n") == 3);
  law("a text that is no number does not go into a number",
      throws<LogicError>([&] { board->set("n", "three"); }));
  law("a text that is one does", (board->set("n", "4"), board->get<int>("n") == 4));
  law("nor does a number without that value", throws<LogicError>([&] { board->set("n", 4.5); }));
  board->createEntry("small", TypeInfo::Create<std::uint8_t>());
  board->set("long", std::int64_t{5});
  law("an int goes into an int64_t", (board->set("long", -7), board->get<int>("long") == -7));
  law("300 goes into no uint8", throws<LogicError>([&] { board->set("small", 300); }));
  law("255 does", (board->set("small", 255), board->get<int>("small") == 255));
  law("an entry has one type",
      throws<LogicError>([&] { board->createEntry("n", TypeInfo::Create<std::string>()); }));
  law("nothing is no value",
      throws<RuntimeError>([&] { static_cast<void>(board->get<int>("nothing")); }));
  const auto before = board->getStamped<int>("n");
  board->set("n", 5);
  const auto after = board->getStamped<int>("n");
  law("each write is counted and has its time",
      after->stamp.seq == before->stamp.seq + 1 && after->stamp.time >= before->stamp.time);
  const auto child = Blackboard::create(board);
  law("a child has its own entries", !child->getEntry("n"));
  child->addSubtreeRemapping("m", "n");
  law("and the parent's by remapping", child->get<int>("m") == 5);
  child->enableAutoRemapping(true);
  law("or all, but those with '_'",
      child->get<int>("n") == 5 && (board->set("_p", 1), !child->getEntry("_p")));
  child->set("@far", 7);
  law("'@' is the outermost", board->get<int>("far") == 7);
  board->unset("far");
  law("unset removes", !board->getEntry("far"));
  board->set("point", Point{1, 2});
  const auto copy = Blackboard::create();
  ImportBlackboardFromJSON(ExportBlackboardToJSON(*board), *copy);
  law("JSON carries numbers and registered types",
      copy->get<int>("n") == 5 && copy->get<Point>("point").y == 2);
}

static const char* const kTree = R"(
<root BTCPP_format="4" main_tree_to_execute="Main">
  <BehaviorTree ID="Main">
    <Sequence>
      <Script code="speed := 2; text := 'a'"/>
      <Drive speed="{speed}" where="{where}"/>
      <SubTree ID="Inside" outer="{count}" driver="{driver}"/>
    </Sequence>
  </BehaviorTree>
  <BehaviorTree ID="Inside">
    <Sequence>
      <Script code="own := outer + 1; @root := own"/>
      <Drive speed="{own}" where="{there}"/>
    </Sequence>
  </BehaviorTree>
</root>)";

static void in_a_tree() {
  const auto board = Blackboard::create();
  const auto driver = std::make_shared<Driver>();
  board->set("driver", driver);
  board->set("before", 1);
  BehaviorTreeFactory factory;
  factory.registerNodeType<Drive>("Drive");
  auto tree = factory.createTreeFromText(kTree, board);
  law("constructors read and write entries", board->get<int>("made") == 2);
  const auto held = board->getEntry("speed");
  law("the tree succeeds", tree.tickWhileRunning() == NodeStatus::SUCCESS);
  law("an entry that is held has what the tree wrote", held->value.cast<int>() == 2);
  law("objects go by reference", driver->calls == 2 && driver.use_count() > 3);
  law("a port's entry has the C++ type of the port",
      board->entryInfo("where")->type() == typeid(Point) && board->get<Point>("where").x == 2);
  law("a port says how often its entry was written", board->get<Point>("where").y == 1);
  law("entries that only code names are there", board->get<int>("count") == 1);
  const auto inside = tree.subtrees.at(1)->blackboard;
  law("a SubTree has a board of its own", inside->get<int>("own") == 2 && !board->getEntry("own"));
  law("with what is remapped", inside->get<int>("outer") == 1);
  law("and the main tree's", inside->get<int>("@root") == 2 && board->get<int>("root") == 2);
  law("its parent is the board outside", inside->parent() == board);
  law("a tree's entries keep their type too",
      throws<LogicError>([&] { board->set("where", "nowhere"); }));
  law("its XML says what is remapped",
      throws<LogicError>([&] { board->addSubtreeRemapping("a", "b"); }) &&
          throws<LogicError>([&] { board->enableAutoRemapping(true); }));
  law("no number above the range of int64_t goes into it",
      throws<LogicError>([&] { board->set("huge", std::uint64_t{1} << 63); }));
  law("what is written into an entry's value is not seen by the tree",
      (held->value = Any(9.0), board->get<int>("speed") == 2));
  const auto backup = BlackboardBackup(tree);
  board->set("count", 40);
  inside->set("more", 1);
  BlackboardRestore(backup, tree);
  law("a backup restores values, and that there were none",
      board->get<int>("count") == 1 && !inside->getEntry("more"));
  Ast::Environment environment{board, nullptr};
  law("scripts of C++ see the same",
      ParseScriptAndExecute(environment, "count += 4; count == 5")->cast<bool>() &&
          board->get<int>("count") == 5);
  tree = Tree();
  law("values stay after the tree", board->get<int>("count") == 5 && board->get<int>("speed") == 2);
}

// A board for all trees, whose entries have an '@' there.
static void outside() {
  const auto world = Blackboard::create();
  world->set("n", 2);
  const auto mine = Blackboard::create(world);
  mine->set("n", 30);
  BehaviorTreeFactory factory;
  factory.registerNodeType<Drive>("Drive");
  auto tree = factory.createTreeFromText(R"(<root BTCPP_format="4" main_tree_to_execute="Main">
    <BehaviorTree ID="Main"><SubTree ID="Deep" n="{n}"/></BehaviorTree>
    <BehaviorTree ID="Deep"><Script code="@sum := n + @n; @n += 1; n += 1"/></BehaviorTree>
    </root>)",
                                         mine);
  tree.tickOnce();
  law("'@' is the board outside of the main tree",
      world->get<int>("sum") == 32 && world->get<int>("n") == 3 && mine->get<int>("n") == 31);
  law("not its own", !mine->getEntry("sum") && mine->get<int>("@sum") == 32);
  const auto deep = tree.subtrees.at(1)->blackboard;
  deep->set("@later", 1);
  law("code of a SubTree writes there, too", world->get<int>("later") == 1);
  world->set("n", 8);
  tree.tickOnce();
  law("what changed there is seen in the next tick", world->get<int>("sum") == 39);
  law("and is in no list of the inner keys", mine->getKeys().size() == 1);
}

// A board that two trees have, and one outside of both.
static void shared() {
  const auto world = Blackboard::create();
  world->set("n", 1);
  world->set("driver", std::make_shared<Driver>());
  const auto mine = Blackboard::create(world);
  mine->enableAutoRemapping(true);
  BehaviorTreeFactory factory;
  factory.registerBehaviorTreeFromText(R"(<root BTCPP_format="4">
    <BehaviorTree ID="Add"><Script code="n += 1; fresh := 'new'"/></BehaviorTree></root>)");
  auto tree = factory.createTree("Add", mine);
  auto other = factory.createTree("Add", mine);
  tree.tickOnce();
  law("a tree writes to the board outside", world->get<int>("n") == 2);
  law("and makes entries there", world->get<std::string>("fresh") == "new");
  world->set("n", 10);
  tree.tickOnce();
  law("and reads from it", world->get<int>("n") == 11);
  other.tickOnce();
  law("as does another tree with the same board", world->get<int>("n") == 12);
}

static void from_threads() {
  const auto board = Blackboard::create();
  board->set("sum", 0);
  board->set("free", 0);
  BehaviorTreeFactory factory;
  auto tree = factory.createTreeFromText(R"(<root BTCPP_format="4"><BehaviorTree ID="Count">
      <Repeat num_cycles="20"><Script code="sum += 1"/></Repeat></BehaviorTree></root>)",
                                         board);
  constexpr int kThreads = 4, kTimes = 500;
  std::atomic<bool> goes_on = true;
  std::thread reader([&] {
    int number = 0;
    while (goes_on)
      static_cast<void>(board->get("of_0", number) + board->getKeys().size() +
                        ExportBlackboardToJSON(*board).size());
  });
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&, i] {
      for (int n = 0; n < kTimes; ++n) {
        auto value = board->getAnyLocked("sum");
        value.assign(value->cast<int>() + 1);
        value = {};
        board->set("of_" + std::to_string(i), n);
      }
    });
  }
  int ticks = 0;
  for (; ticks < 40; ++ticks) tree.tickWhileRunning(std::chrono::milliseconds(0));
  for (std::thread& it : threads) it.join();
  goes_on = false;
  reader.join();
  law("no increment is lost, of scripts or of threads",
      board->get<int>("sum") == kThreads * kTimes + ticks * 20);
}

int main() {
  RegisterJsonDefinition<Point>();
  by_itself();
  in_a_tree();
  outside();
  shared();
  from_threads();
}
