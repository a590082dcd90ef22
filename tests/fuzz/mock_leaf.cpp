#include "mock_leaf.h"

#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "require.h"
#include "support/plugin_tables.h"

namespace lockstep::host::fuzz {
namespace {

enum Port : std::uint32_t { kScript, kOut };

std::string g_events;
std::uint64_t g_tick = 1;
int g_living = 0;

// Where the leaf is between create and destroy, as leaf.h has it.
enum class Phase : std::uint8_t { Idle, Running, Paused };

struct Mock {
  const lockstep_host* host;
  const lockstep_caller* caller;
  std::string script;
  int number;
  std::size_t ticks = 0;
  std::uint64_t last_tick = 0;
  double progress = 0;
  Phase phase = Phase::Idle;
  bool out = false;     // it had an error: only halt may follow
  bool silent = false;  // it has no start, and so on: its phases are those of its ticks

  char letter() const { return script.empty() ? 'S' : script[ticks % script.size()]; }

  void told(char event) {
    g_events += event;
    g_events += std::to_string(number);
  }
  void fail() {
    host->set_error(caller, "error of the script");
    out = true;
  }
  void throw_here() {
    out = true;
    throw std::runtime_error("thrown by the script");
  }
};

Mock& mock(void* self) {
  return *static_cast<Mock*>(self);
}

template <bool kSilent>
void* create(const lockstep_host* host, const lockstep_caller* caller, void*) {
  auto it = std::make_unique<Mock>(Mock{host, caller, {}, g_living});
  const char* text = nullptr;
  std::size_t length = 0;
  if (host->get_string(caller, kScript, &text, &length)) it->script.assign(text, length);
  it->silent = kSilent;
  it->told('c');
  ++g_living;
  if (it->letter() == 'c') host->set_error(caller, "error of the script");
  return it.release();
}

void destroy(void* self) {
  const std::unique_ptr<Mock> it(&mock(self));
  it->told('d');
  require(it->phase == Phase::Idle || it->silent, "destroy of a leaf that runs");
  --g_living;
}

void start(void* self) {
  Mock& it = mock(self);
  it.told('s');
  require(it.phase == Phase::Idle, "start of a leaf that runs");
  it.progress = 0;
  it.out = false;
  if (it.letter() == 'x') return it.fail(), void(++it.ticks);
  if (it.letter() == 't') {
    ++it.ticks;
    throw std::runtime_error("thrown by the script");
  }
  it.phase = Phase::Running;
}

lockstep_status perform(Mock& it, char letter) {
  if (letter >= '0' && letter <= '9') it.progress = (letter - '0') / 9.0;
  switch (letter) {
    case 'S':
      return LOCKSTEP_SUCCESS;
    case 'F':
      return LOCKSTEP_FAILURE;
    case '?':
      return 1 + static_cast<int>(it.host->random_bits(it.caller) % 3);
    case 'N':
      it.progress = std::numeric_limits<double>::quiet_NaN();
      return LOCKSTEP_RUNNING;
    case 'P':
      it.progress = -1;
      return LOCKSTEP_RUNNING;
    case 'Q':
      it.progress = 2;
      return LOCKSTEP_RUNNING;
    case 'X':
      it.fail();
      return LOCKSTEP_SUCCESS;
    case 'T':
      it.throw_here();
      return 0;
    case 'B':
      it.out = true;
      return 7;
    default:
      return LOCKSTEP_RUNNING;
  }
}

lockstep_status tick(void* self) {
  Mock& it = mock(self);
  it.told('t');
  require(std::exchange(it.last_tick, g_tick) != g_tick, "two ticks of a leaf in one of the tree");
  require(it.silent || (it.phase == Phase::Running && !it.out), "tick of a leaf that does not run");
  const char letter = it.letter();
  ++it.ticks;
  const lockstep_status status = perform(it, letter);
  it.host->set_double(it.caller, kOut, static_cast<double>(it.ticks));
  const bool completed = status == LOCKSTEP_SUCCESS || status == LOCKSTEP_FAILURE;
  if (completed && !it.out) it.phase = Phase::Idle;
  return status;
}

// A condition that returns running is at fault.
lockstep_status tick_condition(void* self) {
  const lockstep_status status = tick(self);
  if (status == LOCKSTEP_RUNNING) mock(self).out = true;
  return status;
}

void halt(void* self) {
  Mock& it = mock(self);
  it.told('h');
  require(it.phase != Phase::Idle, "halt of a leaf that does not run");
  it.phase = Phase::Idle;
  it.out = false;
  if (it.letter() == 'h') it.host->set_error(it.caller, "error of the script");
}

void pause(void* self) {
  Mock& it = mock(self);
  it.told('p');
  require(it.phase == Phase::Running && !it.out, "pause of a leaf that does not run");
  it.phase = Phase::Paused;
  if (it.letter() == 'p') it.fail();
}

void resume(void* self) {
  Mock& it = mock(self);
  it.told('r');
  require(it.phase == Phase::Paused && !it.out, "resume of a leaf that is not paused");
  it.phase = Phase::Running;
  if (it.letter() == 'u') it.fail();
}

double progress(void* self) {
  Mock& it = mock(self);
  require(it.phase != Phase::Idle && !it.out, "progress of a leaf that does not run");
  if (it.letter() == 'g') it.fail();
  if (it.progress != it.progress) it.out = true;
  return it.progress;
}

constexpr lockstep_port kPorts[] = {
    tables::port(LOCKSTEP_STRING, LOCKSTEP_INPUT, "script", "S"),
    tables::port(LOCKSTEP_DOUBLE, LOCKSTEP_OUTPUT, "out"),
};
constexpr auto kPortList = tables::list_of(kPorts);

template <bool kIsBare, auto kTick>
constexpr lockstep_leaf_type leaf_type(const char* id) {
  lockstep_leaf_type type = tables::leaf_type(id, create<kIsBare>, destroy, kTick);
  tables::set_ports(type, kPortList);
  return type;
}

constexpr lockstep_leaf_type with_all_functions(lockstep_leaf_type type) {
  type.start = start;
  type.halt = halt;
  type.pause = pause;
  type.resume = resume;
  type.progress = progress;
  return type;
}

constexpr lockstep_leaf_type kTypes[] = {
    with_all_functions(leaf_type<false, tick>("Mock")),
    [] {
      lockstep_leaf_type type =
          with_all_functions(leaf_type<false, tick_condition>("MockCondition"));
      type.kind = LOCKSTEP_CONDITION;
      return type;
    }(),
    leaf_type<true, tick>("MockBare"),
};
constexpr auto kLeaves = tables::list_of(kTypes);

}  // namespace

const lockstep_plugin kMockPlugin = tables::plugin("mock", kLeaves);

std::string take_events() {
  return std::exchange(g_events, {});
}

void begin_tick() {
  ++g_tick;
}

int living_leaves() {
  return g_living;
}

}  // namespace lockstep::host::fuzz
