// A plugin whose leaf misbehaves as its ports say: `how`, in the function `where`, at its n-th call
// (`at`, from 1), or in each call with the probability `chance`. Everything else that it does is
// right. It logs its calls when `loud`.
#include <cfenv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <unwind.h>

#include "lockstep/leaf.h"
#include "support/plugin_tables.h"

namespace {

enum Port : std::uint32_t { kHow, kWhere, kAt, kTicks, kNumber, kChance };

[[noreturn]] void for_ever() {
  while (true) usleep(1000);
}

// Deeper until the stack ends; what it returns keeps the compiler from making a loop of it.
volatile bool g_deeper = true;
int overflow(int depth) {
  volatile char block[4096];
  block[0] = static_cast<char>(depth);
  return g_deeper ? overflow(depth + 1) + block[0] : 0;
}

void divide_by_zero() {
  volatile int zero = 0;
  volatile int result = 1 / zero;
  static_cast<void>(result);
  std::raise(SIGFPE);  // where the machine divides by zero without a word
}

// Makes an exception trap that has happened already.
void trap_afterwards() {
  volatile long double zero = 0;  // of the old unit, whose flag is what traps
  volatile long double result = 1 / zero;
  static_cast<void>(result);
  feenableexcept(FE_DIVBYZERO);
}

void throw_no_memory() {
  throw std::bad_alloc();
}
void take_all_memory() noexcept {
  throw_no_memory();
}

void throw_foreign() {
  static _Unwind_Exception exception;
  std::memcpy(&exception.exception_class, "ROBOTFOR", 8);
  exception.exception_cleanup = nullptr;
  _Unwind_RaiseException(&exception);
}

// An exception that misbehaves when it is asked what it is, or when it goes.
struct HostileException final : std::exception {
  std::string how;

  explicit HostileException(std::string its_how) : how(std::move(its_how)) {}
  HostileException(const HostileException&) = default;
  ~HostileException() override {
    if (how == "throw hanging end") for_ever();
  }
  const char* what() const noexcept override {
    static const std::string long_text(60'000'000, 'x');
    if (how == "throw null") return nullptr;
    if (how == "throw long") return long_text.c_str();
    if (how == "throw hanging what") for_ever();
    if (how == "throw crashing what") *reinterpret_cast<volatile int*>(8) = 1;  // NOLINT
    return "";
  }
};

void end(const std::string& where);
struct ThreadEnd {
  bool is_used = false;
  ~ThreadEnd() { end("thread"); }
};
thread_local ThreadEnd t_end;

struct Leaf {
  const lockstep_host* host;
  const lockstep_caller* caller;
  std::int64_t ticks = 0;
  std::int64_t calls = 0;  // of the function `where`
  bool nonsense = false;   // the function has to return it

  std::string text(Port port) const {
    const char* value = "";
    std::size_t length = 0;
    host->get_string(caller, port, &value, &length);
    return {value, length};
  }
  std::int64_t number(Port port) const {
    std::int64_t value = 0;
    host->get_int(caller, port, &value);
    return value;
  }

  void misbehave_in(const char* function);
  void misbehave(const std::string& how);
  void call_from_another_thread() const;
};

void Leaf::misbehave_in(const char* function) {
  if (text(kWhere) != function) return;
  ++calls;
  double chance = 0;
  host->get_double(caller, kChance, &chance);
  if (chance > 0 ? host->random(caller) < chance : calls == number(kAt)) misbehave(text(kHow));
}

void Leaf::misbehave(const std::string& how) {
  if (how == "throw exception") throw std::runtime_error("out of reach");
  if (how == "throw null" || how == "throw empty" || how == "throw long" ||
      how == "throw hanging what" || how == "throw crashing what" || how == "throw hanging end") {
    throw HostileException(how);
  }
  if (how == "throw int") throw 7;  // NOLINT
  if (how == "throw foreign") throw_foreign();
  if (how == "exit thread") pthread_exit(nullptr);
  if (how == "set error") host->set_error(caller, "lost the arm");
  if (how == "set long error") host->set_error(caller, std::string(60'000'000, 'x').c_str());
  if (how == "hang") for_ever();
  if (how == "hang deaf") {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, nullptr);
    for_ever();
  }
  if (how == "late") usleep(300'000);
  if (how == "exit") std::exit(3);
  if (how == "_exit") _exit(3);
  if (how == "abort") std::abort();
  if (how == "terminate") std::terminate();
  if (how == "terminate without memory") take_all_memory();
  if (how == "segv") *reinterpret_cast<volatile int*>(8) = 1;  // NOLINT
  if (how == "wild jump") {
    void (*volatile wild)() = reinterpret_cast<void (*)()>(16);  // NOLINT
    wild();
  }
  if (how == "segv in a thread") std::thread([] { std::raise(SIGSEGV); }).join();
  if (how == "fpe") divide_by_zero();
  if (how == "overflow") overflow(0);
  if (how == "kill") std::raise(SIGKILL);
  if (how == "print") {
    std::puts("printed by a leaf");
    static_cast<void>(!write(STDOUT_FILENO, "written by a leaf\n", 18));
  }
  if (how == "leak") {
    constexpr std::size_t kSize = 128u << 20;
    std::memset(std::malloc(kSize), 1, kSize);  // NOLINT: it is meant to be lost
  }
  if (how == "block signals") {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, nullptr);
  }
  if (how == "round up") std::fesetround(FE_UPWARD);
  if (how == "trap") trap_afterwards();
  if (how == "tell rounding") {
    host->log(caller, LOCKSTEP_LOG_INFO,
              std::fegetround() == FE_TONEAREST ? "rounds to nearest" : "rounds otherwise");
  }
  if (how == "leave a thread") std::thread(for_ever).detach();
  if (how == "log in a thread") {
    std::thread([this] {
      while (true) host->log(caller, LOCKSTEP_LOG_INFO, "still here");
    }).detach();
  }
  if (how == "fork") static_cast<void>(fork());
  if (how == "vfork" && vfork() == 0) _exit(0);  // NOLINT: as system() does
  if (how == "clone") syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0);
  if (how == "stop") std::raise(SIGSTOP);
  if (how == "stop with the host") {
    usleep(50'000);  // it sleeps by then
    kill(getppid(), SIGSTOP);
    std::raise(SIGSTOP);
  }
  if (how == "foreign call") call_from_another_thread();
  if (how == "nonsense") nonsense = true;
}

// What only log may do.
void Leaf::call_from_another_thread() const {
  std::thread([this] {
    double value = 0;
    const bool got = host->get_double(caller, kNumber, &value);
    const bool set = host->set_double(caller, kNumber, 42);
    host->set_error(caller, "from another thread");
    host->log(caller, LOCKSTEP_LOG_INFO,
              got || set ? "a foreign thread was served" : "a foreign thread was refused");
  }).join();
}

Leaf& leaf_of(void* leaf) {
  return *static_cast<Leaf*>(leaf);
}

void* create(const lockstep_host* host, const lockstep_caller* caller, void*) {
  auto leaf = std::make_unique<Leaf>(Leaf{host, caller});
  leaf->misbehave_in("create");
  return leaf->nonsense ? nullptr : leaf.release();
}
void destroy(void* leaf) {
  const std::unique_ptr<Leaf> owned(static_cast<Leaf*>(leaf));
  owned->misbehave_in("destroy");
}
void start(void* leaf) {
  leaf_of(leaf).ticks = 0;
  leaf_of(leaf).misbehave_in("start");
}
lockstep_status tick(void* leaf) {
  Leaf& it = leaf_of(leaf);
  t_end.is_used = true;
  it.misbehave_in("tick");
  if (std::exchange(it.nonsense, false)) return 7;
  return ++it.ticks < it.number(kTicks) ? LOCKSTEP_RUNNING : LOCKSTEP_SUCCESS;
}
void halt(void* leaf) {
  leaf_of(leaf).misbehave_in("halt");
}
void pause(void* leaf) {
  leaf_of(leaf).misbehave_in("pause");
}
void resume(void* leaf) {
  leaf_of(leaf).misbehave_in("resume");
}
double progress(void* leaf) {
  Leaf& it = leaf_of(leaf);
  it.misbehave_in("progress");
  const std::string how = it.text(kWhere) == "progress" ? it.text(kHow) : "";
  if (how == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (how == "infinite") return std::numeric_limits<double>::infinity();
  if (how == "-3") return -3;
  if (how == "7") return 7;
  return static_cast<double>(it.ticks) / static_cast<double>(it.number(kTicks));
}

// What a shared object can do before anybody has asked it for anything.
__attribute__((constructor)) void load() {
  const char* const variable = std::getenv("HOSTILE_LOAD");
  const std::string how = variable == nullptr ? "" : variable;
  if (how == "segv") std::raise(SIGSEGV);
  if (how == "round up") std::fesetround(FE_UPWARD);
  if (how == "trap") trap_afterwards();
  if (how == "exit") std::exit(0);
  if (how == "_exit") _exit(0);
  if (how == "hang") for_ever();
  if (how == "fork") static_cast<void>(fork());
}

// What it can do when all is over: HOSTILE_END is where and how, "static hang".
void end(const std::string& where) {
  const char* const variable = std::getenv("HOSTILE_END");
  const std::string how = variable == nullptr ? "" : variable;
  if (how == where + " hang") for_ever();
  if (how == where + " exit") std::exit(0);
  if (how == where + " _exit") std::_Exit(0);
  if (how == where + " segv") std::raise(SIGSEGV);
  if (how == where + " overflow") overflow(0);
  if (how == where + " print") static_cast<void>(!write(STDERR_FILENO, "ended\n", 6));
}
const struct StaticEnd {
  ~StaticEnd() { end("static"); }
} g_static_end;
__attribute__((destructor)) void unload() {
  end("shared object");
}

bool g_never_deinit = false;
bool init(const lockstep_host*, const lockstep_caller*) {
  const char* how = std::getenv("HOSTILE_INIT");
  if (how != nullptr && std::strcmp(how, "segv") == 0) std::raise(SIGSEGV);
  if (how != nullptr && std::strcmp(how, "hang") == 0) for_ever();
  if (how != nullptr && std::strcmp(how, "fork") == 0) static_cast<void>(fork());
  std::atexit([] { end("atexit"); });
  g_never_deinit = std::getenv("HOSTILE_DEINIT") != nullptr;
  return true;
}
void deinit() {
  if (g_never_deinit) for_ever();
}

using lockstep::tables::port;

constexpr lockstep_port kPorts[] = {
    port(LOCKSTEP_STRING, LOCKSTEP_INPUT, "how", ""),
    port(LOCKSTEP_STRING, LOCKSTEP_INPUT, "where", "tick"),
    port(LOCKSTEP_INT, LOCKSTEP_INPUT, "at", "1"),
    port(LOCKSTEP_INT, LOCKSTEP_INPUT, "ticks", "5"),
    port(LOCKSTEP_DOUBLE, LOCKSTEP_INOUT, "number", "1"),
    port(LOCKSTEP_DOUBLE, LOCKSTEP_INPUT, "chance", "0"),
};
constexpr auto kPortList = lockstep::tables::list_of(kPorts);

constexpr lockstep_leaf_type kMisbehave[] = {[] {
  lockstep_leaf_type type = lockstep::tables::leaf_type("Misbehave", create, destroy, tick);
  type.doc = "Does what no leaf should";
  type.start = start;
  type.halt = halt;
  type.pause = pause;
  type.resume = resume;
  type.progress = progress;
  lockstep::tables::set_ports(type, kPortList);
  return type;
}()};
constexpr auto kLeaves = lockstep::tables::list_of(kMisbehave);

constexpr lockstep_plugin kPlugin = [] {
  lockstep_plugin plugin = lockstep::tables::plugin("hostile", kLeaves);
  plugin.version = "1.0";
  plugin.doc = "For tests";
  plugin.init = init;
  plugin.deinit = deinit;
  return plugin;
}();

}  // namespace

extern "C" LOCKSTEP_EXPORT constinit const lockstep_plugin lockstep_plugin_entry = kPlugin;
