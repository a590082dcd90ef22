#include "fake_host.h"

namespace sdk_test {
namespace {

FakeHost& self(const lockstep_caller* caller) {
  return *const_cast<FakeHost*>(reinterpret_cast<const FakeHost*>(caller));
}

template <class T>
T* find(const lockstep_caller* caller, std::uint32_t port) {
  auto& ports = self(caller).ports;
  return port < ports.size() ? std::get_if<T>(&ports[port]) : nullptr;
}

template <class T>
bool get(const lockstep_caller* caller, std::uint32_t port, T* value) {
  const T* found = find<T>(caller, port);
  if (found != nullptr) *value = *found;
  return found != nullptr;
}

bool set_value(const lockstep_caller* caller, std::uint32_t port, PortValue value) {
  FakeHost& host = self(caller);
  if (port >= host.ports.size() || !host.writable[port]) return false;
  host.ports[port] = std::move(value);
  return true;
}

template <class T>
bool set(const lockstep_caller* caller, std::uint32_t port, T value) {
  return set_value(caller, port, value);
}

bool get_string(const lockstep_caller* caller, std::uint32_t port, const char** text,
                std::size_t* length) {
  const auto* found = find<std::string>(caller, port);
  if (found == nullptr) return false;
  *text = found->data();
  *length = found->size();
  return true;
}

template <class List>
bool get_list(const lockstep_caller* caller, std::uint32_t port,
              const typename List::value_type** values, std::size_t* count) {
  const auto* found = find<List>(caller, port);
  if (found == nullptr) return false;
  *values = found->data();
  *count = found->size();
  return true;
}

bool get_string_list(const lockstep_caller* caller, std::uint32_t port,
                     const lockstep_text** values, std::size_t* count) {
  const auto* found = find<std::vector<std::string>>(caller, port);
  if (found == nullptr) return false;
  auto& texts = self(caller).texts;
  texts.clear();
  for (const std::string& text : *found) texts.push_back({text.data(), text.size()});
  *values = texts.data();
  *count = texts.size();
  return true;
}

bool set_string(const lockstep_caller* caller, std::uint32_t port, const char* text,
                std::size_t length) {
  return set_value(caller, port, std::string(text, length));
}

template <class List>
bool set_list(const lockstep_caller* caller, std::uint32_t port,
              const typename List::value_type* values, std::size_t count) {
  return set_value(caller, port, List(values, values + count));
}

bool set_string_list(const lockstep_caller* caller, std::uint32_t port, const lockstep_text* values,
                     std::size_t count) {
  std::vector<std::string> list;
  for (std::size_t i = 0; i < count; ++i) list.emplace_back(values[i].text, values[i].length);
  return set_value(caller, port, std::move(list));
}

void set_error(const lockstep_caller* caller, const char* message) {
  if (self(caller).error.empty()) self(caller).error = message;
}

void set_empty_port(const lockstep_caller* caller, std::uint32_t port) {
  set_error(caller, ("empty: " + std::to_string(port)).c_str());
}

double now(const lockstep_caller* caller) {
  return self(caller).time;
}
double tick_period(const lockstep_caller*) {
  return 0.125;
}

// 0, 1/4, 2/4, 3/4, 0, …
std::uint64_t random_bits(const lockstep_caller* caller) {
  return self(caller).draws++;
}
double random_double(const lockstep_caller* caller) {
  return static_cast<double>(self(caller).draws++ % 4) / 4;
}

void log(const lockstep_caller* caller, lockstep_log_level level, const char* message) {
  self(caller).add_line(std::to_string(level) + " " + message);
}

bool is_set(const lockstep_caller* caller, std::uint32_t port) {
  return self(caller).writable[port];
}

const void* constant(const lockstep_caller* caller, std::uint32_t port, lockstep_type type) {
  if (is_set(caller, port)) return nullptr;
  if (type == LOCKSTEP_BOOL) return find<bool>(caller, port);
  if (type == LOCKSTEP_INT) return find<std::int64_t>(caller, port);
  return type == LOCKSTEP_DOUBLE ? find<double>(caller, port) : nullptr;
}

const void* get_extension(const char* id) {
  static const int kAnswer = 42;
  static const lockstep_lasting kLasting = {sizeof(lockstep_lasting), constant, is_set};
  if (FakeHost::tells_what_lasts && std::string(id) == LOCKSTEP_LASTING) return &kLasting;
  return std::string(id) == "test.answer" ? &kAnswer : nullptr;
}

}  // namespace

const lockstep_host& FakeHost::table() {
  static const lockstep_host kTable = {LOCKSTEP_ABI_MAJOR,
                                       LOCKSTEP_ABI_MINOR,
                                       sizeof(lockstep_host),
                                       "fake",
                                       "0",
                                       get<bool>,
                                       get<std::int64_t>,
                                       get<double>,
                                       get_string,
                                       get_list<std::vector<double>>,
                                       set<bool>,
                                       set<std::int64_t>,
                                       set<double>,
                                       set_string,
                                       set_list<std::vector<double>>,
                                       set_error,
                                       now,
                                       tick_period,
                                       random_bits,
                                       random_double,
                                       log,
                                       get_extension,
                                       get_list<std::vector<std::int64_t>>,
                                       get_list<Flags>,
                                       get_string_list,
                                       set_list<std::vector<std::int64_t>>,
                                       set_list<Flags>,
                                       set_string_list,
                                       nullptr,
                                       nullptr,
                                       set_empty_port};
  static const lockstep_host kOlder = [] {
    lockstep_host table = kTable;
    table.struct_size = offsetof(lockstep_host, set_empty_port);
    return table;
  }();
  return knows_empty_ports ? kTable : kOlder;
}

}  // namespace sdk_test
