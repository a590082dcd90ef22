// A leaf that shows what reaches it: it copies each of its inputs to the output of its type, draws
// random numbers, tells its process, and logs from a thread of its own.
#include <unistd.h>

#include <cstring>
#include <string>
#include <thread>

#include "echo_ports.h"
#include "lockstep/leaf.h"
#include "support/plugin_tables.h"

namespace {

struct Echo {
  const lockstep_host* host;
  const lockstep_caller* caller;
  std::thread speaker = {};
};

void* create(const lockstep_host* host, const lockstep_caller* caller, void*) {
  return new Echo{host, caller};
}
void destroy(void* leaf) {
  auto* const it = static_cast<Echo*>(leaf);
  if (it->speaker.joinable()) it->speaker.join();
  delete it;
}

void copy_scalars(const Echo& it) {
  bool flag = false;
  std::int64_t whole = 0;
  double number = 0;
  if (it.host->get_bool(it.caller, kBoolIn, &flag)) it.host->set_bool(it.caller, kBoolOut, flag);
  if (it.host->get_int(it.caller, kIntIn, &whole)) it.host->set_int(it.caller, kIntOut, whole);
  if (it.host->get_double(it.caller, kDoubleIn, &number)) {
    it.host->set_double(it.caller, kDoubleOut, number);
  }
}

void copy_lists(const Echo& it) {
  const char* text = nullptr;
  const double* list = nullptr;
  std::size_t size = 0;
  if (it.host->get_string(it.caller, kStringIn, &text, &size)) {
    it.host->set_string(it.caller, kStringOut, text, size);
    // What has just been set is seen through every port of the entry.
    if (it.host->get_string(it.caller, kStringIn, &text, &size)) {
      it.host->set_int(it.caller, kSeen, static_cast<std::int64_t>(size));
    }
  }
  if (it.host->get_double_list(it.caller, kListIn, &list, &size)) {
    it.host->set_double_list(it.caller, kListOut, list, size);
  }
}

void copy_more(const Echo& it) {
  const std::int64_t* numbers = nullptr;
  const bool* flags = nullptr;
  const lockstep_text* texts = nullptr;
  std::size_t count = 0;
  double number = 0;
  if (it.host->get_int_list(it.caller, kIntListIn, &numbers, &count)) {
    it.host->set_int_list(it.caller, kIntListOut, numbers, count);
  }
  if (it.host->get_bool_list(it.caller, kBoolListIn, &flags, &count)) {
    it.host->set_bool_list(it.caller, kBoolListOut, flags, count);
  }
  if (it.host->get_string_list(it.caller, kStringListIn, &texts, &count)) {
    it.host->set_string_list(it.caller, kStringListOut, texts, count);
  }
  if (it.host->get_double(it.caller, kNumberIn, &number)) {
    it.host->set_double(it.caller, kNumberOut, number);
  }
}

void grow(const Echo& it) {
  std::int64_t size = 0;
  if (!it.host->get_int(it.caller, kGrow, &size) || size == 0) return;
  const std::string text(static_cast<std::size_t>(size), 'x');
  it.host->set_string(it.caller, kStringOut, text.data(), text.size());
}

lockstep_status tick(void* leaf) {
  Echo& it = *static_cast<Echo*>(leaf);
  copy_scalars(it);
  copy_lists(it);
  copy_more(it);
  grow(it);
  it.host->set_double(it.caller, kRandom, it.host->random(it.caller) + it.host->now(it.caller));
  it.host->set_int(it.caller, kProcess, getpid());
  bool speak = false;
  if (it.host->get_bool(it.caller, kSpeak, &speak) && speak && !it.speaker.joinable()) {
    it.speaker = std::thread([host = it.host, caller = it.caller] {
      host->log(caller, LOCKSTEP_LOG_WARNING, "from another thread");
    });
  }
  return LOCKSTEP_RUNNING;
}

using lockstep::tables::port;

constexpr lockstep_port limited(lockstep_port port, double min, double max) {
  port.min = min;
  port.max = max;
  return port;
}

constexpr lockstep_port kPorts[] = {
    port(LOCKSTEP_BOOL, LOCKSTEP_INPUT, "bool_in", "false"),
    port(LOCKSTEP_INT, LOCKSTEP_INPUT, "int_in", "0"),
    port(LOCKSTEP_DOUBLE, LOCKSTEP_INPUT, "double_in", "0"),
    port(LOCKSTEP_STRING, LOCKSTEP_INPUT, "string_in", ""),
    port(LOCKSTEP_DOUBLE_LIST, LOCKSTEP_INPUT, "list_in", "0"),
    port(LOCKSTEP_BOOL, LOCKSTEP_OUTPUT, "bool_out"),
    port(LOCKSTEP_INT, LOCKSTEP_OUTPUT, "int_out"),
    port(LOCKSTEP_DOUBLE, LOCKSTEP_OUTPUT, "double_out"),
    port(LOCKSTEP_STRING, LOCKSTEP_OUTPUT, "string_out"),
    port(LOCKSTEP_DOUBLE_LIST, LOCKSTEP_OUTPUT, "list_out"),
    port(LOCKSTEP_DOUBLE, LOCKSTEP_OUTPUT, "random"),
    port(LOCKSTEP_INT, LOCKSTEP_OUTPUT, "process"),
    port(LOCKSTEP_INT, LOCKSTEP_OUTPUT, "seen"),
    port(LOCKSTEP_BOOL, LOCKSTEP_INPUT, "speak", "false"),
    port(LOCKSTEP_INT, LOCKSTEP_INPUT, "grow", "0"),
    port(LOCKSTEP_INT_LIST, LOCKSTEP_INPUT, "int_list_in", "0"),
    port(LOCKSTEP_BOOL_LIST, LOCKSTEP_INPUT, "bool_list_in", "0"),
    port(LOCKSTEP_STRING_LIST, LOCKSTEP_INPUT, "string_list_in", "a"),
    limited(port(LOCKSTEP_NUMBER, LOCKSTEP_INPUT, "number_in", "0"), -1, 1000),
    port(LOCKSTEP_INT_LIST, LOCKSTEP_OUTPUT, "int_list_out"),
    port(LOCKSTEP_BOOL_LIST, LOCKSTEP_OUTPUT, "bool_list_out"),
    port(LOCKSTEP_STRING_LIST, LOCKSTEP_OUTPUT, "string_list_out"),
    port(LOCKSTEP_DOUBLE, LOCKSTEP_OUTPUT, "number_out"),
};
constexpr auto kPortList = lockstep::tables::list_of(kPorts);

constexpr lockstep_leaf_type kTypes[] = {[] {
  lockstep_leaf_type type = lockstep::tables::leaf_type("Echo", create, destroy, tick);
  lockstep::tables::set_ports(type, kPortList);
  return type;
}()};
constexpr auto kList = lockstep::tables::list_of(kTypes);

}  // namespace

extern "C" constinit const lockstep_plugin lockstep_plugin_entry =
    lockstep::tables::plugin("echo", kList);
