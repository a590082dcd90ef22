// What a tick may not do: allocate, lock, call the system. Counted, not believed: the allocator and
// the locks of this program are replaced by ones that count, and the ticks of a child process
// happen in a mode in which the kernel kills it for any system call.
#include <dlfcn.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "judge/measure/entry_changes.h"
#include "judge/measure/measure_spec.h"
#include "judge/summary/statistics.h"
#include "language/expression/evaluator.h"
#include "record/json_lines.h"
#include "record/live/line_feed.h"
#include "record/live/snapshot_feed.h"
#include "record/live/status_feed.h"
#include "record/write/recorder.h"
#include "run/checkpoint/checkpoint_writer.h"
#include "run/loop.h"
#include "run/observers.h"
#include "run/run.h"
#include "run/run_control.h"
#include "run/shape_of.h"
#include "run/watched_leaves.h"
#include "study/run_measures.h"
#include "support/compiled.h"
#include "support/paths.h"
#include "support/program.h"

namespace {
thread_local bool t_counting = false;
thread_local bool t_no_memory = false;
std::atomic<int> g_allocations{0};
std::atomic<int> g_locks{0};
}  // namespace

// Sanitizers have an allocator and locks of their own, and call the system as they like.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

void* operator new(std::size_t size) {
  if (t_counting) ++g_allocations;
  if (t_no_memory) throw std::bad_alloc();
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  if (t_counting) ++g_allocations;
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  operator delete(memory);
}

extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) {
  using Lock = int (*)(pthread_mutex_t*);
  static const auto lock = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  if (t_counting) ++g_locks;
  return lock(mutex);
}

namespace lockstep::host::test {
namespace {

// Every kind of node, over leaves of a plugin in C++ that have ports and read them; it runs on.
constexpr const char* kTree = R"xml(
<root lockstep="1" main_tree_to_execute="Main">
  <barrier name="early" barriers="0.3;0.6" idle="ignore"/>
  <barrier name="close" delta="1e-8"/>
  <resources name="hands"/>
  <BehaviorTree ID="Main">
    <Parallel success_count="17">
      <Repeat><ParallelAbsolute barriers="0.3;0.6" hold="between"><SubTree ID="Road"/><Advance step="0.1"/></ParallelAbsolute></Repeat>
      <SyncProgress barrier="close"><Sequence memory="true"><SyncProgress barrier="early"><Advance step="1e-9"/></SyncProgress></Sequence></SyncProgress>
      <Sequence memory="true"><Wait seconds="0.5"/><SyncProgress barrier="close"><SubTree ID="Other" barrier="early"/></SyncProgress></Sequence>
      <SubTree ID="Planned" plan="0.3;0.6"/>
      <ParallelAbsolute barriers="0.3;0.6"><Advance step="1e-9"/><Advance step="2e-9"/></ParallelAbsolute>
      <ParallelRelative delta="1e-8"><Advance step="1e-9"/><Advance step="9e-9"/></ParallelRelative>
      <Sequence><Advance step="1"/><Fallback><AlwaysFailure/><Advance step="0"/></Fallback></Sequence>
      <Sequence memory="true"><Advance step="0.5"/><Wait name="long" seconds="1e6"/></Sequence>
      <WaitUntil code="progress(long) > 0.5 or status(long) == failure or held(long) or owner(left) == 'a path that is longer than any owner'"/>
      <KeepRunningUntilFailure><Sequence><SubTree ID="Part"/><Inverter><AlwaysFailure/></Inverter></Sequence></KeepRunningUntilFailure>
      <Repeat times="1000000"><Sequence><Advance step="0.5"/><Delay seconds="0.02"><AlwaysSuccess/></Delay></Sequence></Repeat>
      <KeepRunningUntilFailure><ForceSuccess><Timeout seconds="0.03"><Advance step="0"/></Timeout></ForceSuccess></KeepRunningUntilFailure>
      <SubTree ID="Uses" hand="left"/>
      <SubTree ID="Uses" hand="left;right"/>
      <SubTree ID="Uses" hand="any(left;right)"/>
      <SubTree ID="Exchanges" hand="foot"/>
      <UseResources pool="hands" resources="right" keep="true"><Advance step="1e-9"/></UseResources>
    </Parallel>
  </BehaviorTree>
  <BehaviorTree ID="Other"><SyncProgress barrier="barrier"><Advance step="9e-9"/></SyncProgress></BehaviorTree>
  <BehaviorTree ID="Uses">
    <Repeat><UseResources pool="hands" resources="{hand}" granted="{got}"><Advance step="0.3"/></UseResources></Repeat>
  </BehaviorTree>
  <BehaviorTree ID="Exchanges">
    <UseResources pool="hands" resources="{hand}" on_change="exchange" granted="{got}">
      <Repeat><Advance step="0.3" on_success="hand = hand == 'foot' ? 'any(left;foot)' : 'foot'"/></Repeat>
    </UseResources>
  </BehaviorTree>
  <BehaviorTree ID="Road">
    <Sequence memory="true">
      <UseResources pool="hands" resources="nose" keep="true"><Advance step="0.4"/></UseResources>
      <UseResources pool="hands" resources="nose;ear" on_change="exchange">
        <UseResources pool="hands" resources="nose"><Advance step="0.4"/></UseResources>
      </UseResources>
    </Sequence>
  </BehaviorTree>
  <BehaviorTree ID="Planned">
    <ParallelAbsolute barriers="{plan}"><Advance step="1e-9"/><Advance step="2e-9"/></ParallelAbsolute>
  </BehaviorTree>
  <BehaviorTree ID="Part"><RunOnce><AlwaysSuccess/></RunOnce></BehaviorTree>
</root>)xml";

constexpr const char* kMeasuredTree = R"(
<root lockstep="1" main_tree_to_execute="Main">
  <resources name="pool"/>
  <BehaviorTree ID="Main">
    <Parallel>
      <UseResources pool="pool" resources="left"><Advance name="c" step="1e-9"/></UseResources>
      <UseResources pool="pool" resources="left"><Advance name="d" step="1e-9"/></UseResources>
      <ParallelRelative delta="1e-8"><Advance name="a" step="1e-9"/><Advance name="b" step="9e-9"/></ParallelRelative>
      <SubTree ID="Rest" seconds="1e6"/>
    </Parallel>
  </BehaviorTree>
  <BehaviorTree ID="Rest"><Wait seconds="{seconds}"/></BehaviorTree>
</root>)";

class TickingTree {
 public:
  explicit TickingTree(const char* text = kTree) {
    Diagnostics diagnostics;
    REQUIRE(plugins_.load_file(LOCKSTEP_BINARY_DIR "/plugins/motion.so", diagnostics));
    REQUIRE(plugins_.initialize(diagnostics));
    tree_ = test::compiled(text, plugins_);
  }
  const Tree& tree() const { return tree_; }

 private:
  PluginSet plugins_;
  Tree tree_;
};

// As `lockstep run` ticks it: watched, with the measures of the summary, and maybe another
// observer.
class WatchedRun {
 public:
  explicit WatchedRun(const Tree& tree, Observer* observer = nullptr)
      : watch_({.budget = std::chrono::seconds(1)}),
        statistics_(shape_of(tree)),
        run_(tree, {.watch = &watch_}),
        observers_(tree, with_statistics(observer)) {
    observers_.run_started(run_.ticker(), {});
  }

  void tick(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i, ++tick_) {
      const Nanoseconds now = deadline_of(tick_, 100);
      run_.set_now(now);
      observers_.before_tick(run_.ticker(), tick_, now);
      observers_.after_tick(run_.ticker(), {tick_, now, run_.tick(now)});
    }
  }
  Ticker& ticker() { return run_.ticker(); }
  const Fault* fault() const { return run_.fault(); }
  Status status() { return run_.ticker().status(0); }

 private:
  std::vector<Observer*> with_statistics(Observer* other) {
    if (other == nullptr) return {&statistics_};
    return {&statistics_, other};
  }

  LeafWatch watch_;
  Statistics statistics_;
  Run run_;
  Observers observers_;
  std::uint64_t tick_ = 0;
};

// As with --checkpoint.
class KeptTicks {
 public:
  explicit KeptTicks(const Tree& tree)
      : run_(tree),
        writer_(std::make_unique<CheckpointFile>(directory_.path("run.checkpoint")),
                {.period = std::chrono::milliseconds(10)}) {
    REQUIRE(writer_.begin(run_.ticker(), {}, 0, 0));
  }
  void tick(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
      run_.ticker().set_durable(writer_.durable());
      run_.tick(1);
      writer_.after_tick(run_.ticker(), ++ticks_);
    }
  }
  // Until the thread that writes has taken each buffer, with a state as it is now.
  void warm_up() {
    tick(100);
    for (int taken = 0; taken < 4; ++taken) {
      for (const std::uint64_t before = writer_.kept(); writer_.kept() == before;) tick(1);
    }
  }
  bool has_ticked_well() const { return run_.fault() == nullptr && writer_.error().empty(); }
  std::uint32_t last_commit() { return run_.ticker().last_commit(); }

 private:
  const TemporaryDirectory directory_;
  WatchedRun run_;
  CheckpointWriter writer_;
  std::uint64_t ticks_ = 0;
};

// Leaves that keep their state, and one that commits again and again.
constexpr const char* kKeptTree = R"xml(
<root lockstep="1"><BehaviorTree ID="Main"><Sequence memory="true"><Script code="n := 0"/><Parallel>
  <ParallelRelative delta="1e-8"><Advance step="1e-9"/><Advance step="9e-9"/></ParallelRelative>
  <Repeat><Sequence memory="true"><Advance step="0.5" commit="true"/><Script code="n += 1"/></Sequence></Repeat>
</Parallel></Sequence></BehaviorTree></root>)xml";

// As with --watch-leaves. An action that writes an entry that a script reads, and a fact.
class AuditedTicks {
 public:
  explicit AuditedTicks(const Tree& tree) : run_(tree) {
    Diagnostics diagnostics;
    std::vector<NodeProblem> problems;
    file_ = read_leaf_file("t.leaves.xml", R"(<leaves lockstep="1"><fact name="on"/>
<leaf of="Advance" result="success" step="0..1" sets="on=true" out.actual="0.5|1"/></leaves>)",
                           diagnostics);
    REQUIRE(file_ != nullptr);
    models_ = make_models(tree, file_.get(), diagnostics, problems);
    REQUIRE_FALSE(diagnostics.has_errors());
    leaves_.emplace(tree, models_, &file_->sources);
    leaves_->begin(run_.ticker());
  }
  void tick(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i, ++ticks_) {
      leaves_->before_tick(run_.ticker());
      run_.tick(1);
      leaves_->after_tick(run_.ticker(), ticks_, deadline_of(ticks_, 100));
    }
  }
  const Fault* fault() const { return run_.fault(); }

 private:
  std::unique_ptr<LeafFile> file_;
  LeafModels models_;
  WatchedRun run_;
  std::optional<WatchedLeaves> leaves_;
  std::uint64_t ticks_ = 0;
};

constexpr const char* kAuditedTree = R"xml(
<root lockstep="1"><BehaviorTree ID="Main"><Sequence memory="true"><Script code="n := 0; x := 0.0"/><Parallel>
  <ParallelRelative delta="1e-1"><Advance step="1e-9"/><Advance step="9e-9"/></ParallelRelative>
  <Repeat><Sequence memory="true"><Advance step="0.5" actual="{x}"/><Script code="n += x"/></Sequence></Repeat>
</Parallel></Sequence></BehaviorTree></root>)xml";

template <class Work>
void check_costs_nothing(Work work) {
  g_allocations = g_locks = 0;
  t_counting = true;
  work();
  t_counting = false;
  CHECK(g_allocations == 0);
  CHECK(g_locks == 0);
}

}  // namespace

TEST_CASE("a tick allocates nothing and locks nothing") {
  const TickingTree tree;
  WatchedRun run(tree.tree());
  run.tick(10);
  check_costs_nothing([&] { run.tick(1000); });
  CHECK(run.status() == Status::Running);
  CHECK(run.fault() == nullptr);
}

TEST_CASE("recording a tick allocates nothing and locks nothing") {
  const TickingTree tree;
  Recorder recorder(shape_of(tree.tree()), {.path = "/dev/null", .run = {.tree_file = "cost.xml"}});
  WatchedRun run(tree.tree(), &recorder);
  run.tick(10);
  check_costs_nothing([&] { run.tick(1000); });
  CHECK(run.status() == Status::Running);
  CHECK(recorder.lost() == 0);
}

TEST_CASE("a tick whose state is kept in a checkpoint allocates nothing and locks nothing") {
  for (const char* text : {kTree, kKeptTree}) {
    const TickingTree tree(text);
    KeptTicks run(tree.tree());
    run.warm_up();
    check_costs_nothing([&] { run.tick(1000); });
    CHECK(run.has_ticked_well());
    CHECK((run.last_commit() > 0) == (text == kKeptTree));
  }
}

TEST_CASE("leaves are watched without allocating and locking") {
  const TickingTree tree(kAuditedTree);
  AuditedTicks run(tree.tree());
  run.tick(10);
  check_costs_nothing([&] { run.tick(1000); });
  INFO((run.fault() != nullptr ? run.fault()->message : ""));
  CHECK(run.fault() == nullptr);
}

TEST_CASE("an entry that is another number in each tick is recorded without allocating") {
  const TickingTree tree;
  Blackboard board(tree.tree());
  EntryChanges changes({0});
  std::string line;
  line.reserve(json_lines::most_of_tick_end(0, 0, 1));
  const auto tick = [&](double value) {
    board.entries[0].assign(value);
    json_lines::set_tick_end(line, {.entries = changes.changes(board.entries)});
    changes.keep();
  };
  tick(-1);
  check_costs_nothing([&] {
    for (int i = 1; i <= 1000; ++i) tick(-1.0 / (3.0e200 * i));
  });
  CHECK(line.starts_with("],\"entries\":[[0,\"-3.33"));
}

// Each look at it is a second later, so that each tick is published.
Nanoseconds hurried() {
  static Nanoseconds now{0};
  return now += std::chrono::seconds(1);
}

TEST_CASE(
    "the monitor's feed passes lines on without allocating or locking, also when nobody takes "
    "them") {
  const TickingTree tree;
  LineFeed feed(shape_of(tree.tree()), {.tree_file = "cost.xml", .rate_hz = 100}, hurried);
  WatchedRun run(tree.tree(), &feed);
  run.tick(10);
  check_costs_nothing([&] {
    for (int i = 0; i < 10; ++i) {
      run.tick(1000);
      feed.want_full();
    }
  });
  CHECK(run.fault() == nullptr);
}

TEST_CASE("statuses for Groot2 are passed on likewise") {
  const TickingTree tree;
  StatusFeed feed(shape_of(tree.tree()));
  WatchedRun run(tree.tree(), &feed);
  run.tick(10);
  check_costs_nothing([&] { run.tick(20'000); });
  CHECK(run.fault() == nullptr);
}

TEST_CASE("a run that may be controlled looks for orders without allocating or locking") {
  const TickingTree tree;
  Run run(tree.tree(), {});
  RunControl control;
  check_costs_nothing([&] {
    for (int i = 0; i < 1000; ++i) {
      control.take_orders(run.ticker(), run.blackboard());
      control.count_tick(run.ticker());
    }
  });
}

TEST_CASE("a feed takes snapshots and entries that change without allocating or locking") {
  const TickingTree tree;
  LeafWatch watch({.budget = std::chrono::seconds(1)});
  Run run(tree.tree(), {.watch = &watch});
  SnapshotFeed feed(shape_of(tree.tree()), hurried);
  LiveMoments moments(tree.tree());
  feed.run_started(moments.now(run.ticker()), {.period = std::chrono::milliseconds(10)});
  auto& board = const_cast<Blackboard&>(run.ticker().blackboard());
  const auto tick = [&](std::uint64_t number) {
    const Nanoseconds now = deadline_of(number, 100);
    run.set_now(now);
    std::get<std::vector<double>>(board.entries[0].to_write())[0] =
        0.3 / static_cast<double>(number);
    const Status status = run.tick(now);
    feed.after_tick(moments.after_tick(run.ticker(), number, now), {number, now, status});
  };
  for (std::uint64_t number = 1; number <= 10; ++number) tick(number);
  check_costs_nothing([&] {
    for (std::uint64_t number = 11; number <= 1000; ++number) tick(number);
  });
  CHECK(run.fault() == nullptr);
  REQUIRE(feed.take());
  CHECK(feed.newest().entries[0].changed == 1000);
  CHECK(feed.newest().entries[0].text == "0.0003;0.6");
}

TEST_CASE("a script allocates nothing for numbers, and for texts only when it runs first") {
  for (const char* const text :
       {"x > 3 && (y < 2.5 || !x)", "x += 1; y := x / 3; x < y <= 7 ? x : -y",
        "z := 'a text that is too long to be in its string: ' .. x; x > 1",
        "z == 'another text' || z .. z == 'a text'"}) {
    INFO(text);
    std::vector<Entry> board(3);
    board[0].assign(std::int64_t{5});
    board[1].assign(1.5);
    board[2].assign(std::string("a text that takes memory, since it is too long for a string"));
    const auto script = Expression::parse(text);
    REQUIRE(script.has_value());
    std::vector<Entry*> entries;
    for (const std::string& name : script->names()) {
      board[name[0] - 'x'].typing = Typing::Any;
      entries.push_back(&board[name[0] - 'x']);
    }
    Evaluator evaluator;
    Value value;
    REQUIRE(evaluator.evaluate(*script, entries, value));
    bool ran = true;
    check_costs_nothing([&] {
      for (int i = 0; i < 100; ++i) ran = ran && evaluator.evaluate(*script, entries, value);
    });
    CHECK(ran);
  }
}

TEST_CASE("the counters count") {
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  g_allocations = g_locks = 0;
  t_counting = true;
  int* volatile number = new int(1);  // which no compiler leaves out
  delete number;
  pthread_mutex_lock(&mutex);
  t_counting = false;
  pthread_mutex_unlock(&mutex);
  CHECK(g_allocations == 2);
  CHECK(g_locks == 1);
}

TEST_CASE("a copy of a value for which there is no memory throws, and that is all") {
  const Value list = std::vector<double>{0.5, 1};
  bool thrown = false;
  t_no_memory = true;
  try {
    const Value copy = list;
  } catch (const std::bad_alloc&) {
    thrown = true;
  }
  t_no_memory = false;
  CHECK(thrown);
}

TEST_CASE("an action that reports its progress late allocates nothing after its first tick") {
  const TickingTree tree(R"(
<root lockstep="1">
  <BehaviorTree ID="Main"><Advance step="1e-9" latency="0.5" quantize="1e-8"/></BehaviorTree>
</root>)");
  Run run(tree.tree(), {});
  std::uint64_t tick = 0;
  const auto tick_once = [&] {
    run.tick(deadline_of(tick++, 100));
    run.ticker().progress(0);
  };
  tick_once();
  g_allocations = 0;
  t_counting = true;
  while (tick < 500) tick_once();
  t_counting = false;
  CHECK(run.fault() == nullptr);
  CHECK(g_allocations == 0);
}

TEST_CASE("measuring the runs of a study allocates nothing and locks nothing") {
  const TickingTree tree(kMeasuredTree);
  std::vector<MeasureSpec> measures;
  // By MeasureOf.
  constexpr const char* kArguments[] = {"", "", ":b", ":b:a", ":c", ":pool", ":b", ":seconds"};
  for (const Measure* it : all_measures()) {
    const std::string text = std::string(it->name) + kArguments[static_cast<std::size_t>(it->of)];
    const auto spec = parse_measure(text);
    measures.push_back(spec ? *spec : parse_measure(text + "@0.5").value());
  }
  measures.push_back(parse_measure("progress-distance[2:5]").value());
  RunMeasures measured(shape_of(tree.tree()), measures, 100);
  REQUIRE(measured.error() == "");
  Run run(tree.tree(), {});
  RunEnd end;
  end.ticks = 1000;
  std::uint64_t tick = 0;
  Observer* const measuring = &measured;
  Observers observers(tree.tree(), {&measuring, 1});
  const auto make_run = [&] {
    observers.run_started(run.ticker(), {});
    for (const std::uint64_t last = tick + 1000; tick < last; ++tick) {
      const Nanoseconds now = deadline_of(tick, 100);
      run.set_now(now);
      observers.before_tick(run.ticker(), tick, now);
      observers.after_tick(run.ticker(), {tick, now, run.tick(now)});
    }
    observers.run_ended(run.ticker(), end);
  };
  make_run();
  g_allocations = g_locks = 0;
  t_counting = true;
  make_run();
  t_counting = false;
  CHECK(run.fault() == nullptr);
  CHECK(g_allocations == 0);
  CHECK(g_locks == 0);
}

namespace {

// From now on the kernel ends this process when it calls the system for anything but to exit.
void forbid_system_calls() {
  sock_filter filter[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                          BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit, 0, 1),
                          BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
                          BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS)};
  const sock_fprog program{sizeof filter / sizeof *filter, filter};
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
}

// Runs `work` in a child that may not call the system; true when it came through.
template <class Work>
bool survives_without_system_calls(Work work) {
  const pid_t child = fork();
  if (child == 0) {
    forbid_system_calls();
    work();
    syscall(SYS_exit, 0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// What `work` allocates in a child that has none of this process's other threads; -1: it crashed.
template <class Work>
int allocations_alone(Work work) {
  const pid_t child = fork();
  if (child == 0) {
    g_allocations = g_locks = 0;
    t_counting = true;
    work();
    _exit(g_allocations + g_locks);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

off_t size_of(const std::string& path) {
  struct stat file {};
  return ::stat(path.c_str(), &file) == 0 ? file.st_size : -1;
}

}  // namespace

TEST_CASE("a recording in an emergency is printed without allocating or locking") {
  const TickingTree tree(kMeasuredTree);
  char path[] = "/tmp/lockstep-XXXXXX";
  ::close(mkstemp(path));
  {
    Recorder recorder(shape_of(tree.tree()), {.path = path, .run = {.tree_file = "cost.xml"}});
    WatchedRun run(tree.tree(), &recorder);
    const off_t before = size_of(path);
    CHECK(allocations_alone([&] {
            run.tick(100);
            AppendFile::emergency_flush();
          }) == 0);
    CHECK(size_of(path) > before + 100 * 40);
  }
  ::unlink(path);
}

TEST_CASE("a tick calls the system for nothing") {
  const TickingTree tree;
  WatchedRun run(tree.tree());
  run.tick(10);
  CHECK(survives_without_system_calls([&run] { run.tick(1000); }));
  Recorder recorder(shape_of(tree.tree()), {.path = "/dev/null", .run = {.tree_file = "cost.xml"}});
  WatchedRun recorded(tree.tree(), &recorder);
  recorded.tick(10);
  // So few that nobody has to be woken for them.
  CHECK(survives_without_system_calls([&recorded] { recorded.tick(50); }));
  for (const char* text : {kTree, kKeptTree}) {
    const TickingTree kept_tree(text);
    KeptTicks kept(kept_tree.tree());
    kept.warm_up();
    CHECK(survives_without_system_calls([&kept] { kept.tick(1000); }));
  }
  const TickingTree audited_tree(kAuditedTree);
  AuditedTicks audited(audited_tree.tree());
  audited.tick(10);
  CHECK(survives_without_system_calls([&audited] { audited.tick(1000); }));
  CHECK_FALSE(survives_without_system_calls([] { getppid(); }));
}

}  // namespace lockstep::host::test

#endif
