// A host for a single leaf or run, without a tree: it keeps what the leaf does, so that a test can
// look at it. Used by the tests of lockstep/leaf.hpp only.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "lockstep/leaf.h"

namespace sdk_test {

using Flags = std::basic_string<bool>;  // std::vector<bool> has no array of them
using PortValue =
    std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>,
                 std::vector<std::int64_t>, Flags, std::vector<std::string>>;

struct FakeHost {
  std::vector<PortValue> ports;  // by index; monostate: no value
  std::vector<bool> writable;    // by index; beyond the end: not bound
  std::string error;             // the first message, as the contract has it
  std::vector<std::string> lines;
  std::uint64_t draws = 0;
  double time = 0;
  std::vector<lockstep_text> texts;  // of the list that was read last

  const lockstep_caller* caller() const { return reinterpret_cast<const lockstep_caller*>(this); }
  static const lockstep_host& table();
  // It has LOCKSTEP_LASTING: what is not writable is a constant then.
  static inline bool tells_what_lasts = false;
  // It has set_empty_port.
  static inline bool knows_empty_ports = false;

  std::string take_error() { return std::exchange(error, std::string()); }

  void add_line(std::string line) {
    const std::lock_guard<std::mutex> lock(mutex_);
    lines.push_back(std::move(line));
  }

 private:
  std::mutex mutex_;
};

// One leaf object, driven through its C table as a host would.
class FakeLeaf {
 public:
  explicit FakeLeaf(const lockstep_leaf_type& type, std::vector<PortValue> ports = {},
                    void* run_context = nullptr, bool are_writable = true)
      : type_(type) {
    host.ports = std::move(ports);
    host.writable.assign(host.ports.size(), are_writable);
    self_ = type.create(&FakeHost::table(), host.caller(), run_context);
  }
  ~FakeLeaf() { destroy(); }
  FakeLeaf(const FakeLeaf&) = delete;
  FakeLeaf& operator=(const FakeLeaf&) = delete;

  void destroy() {
    if (self_ != nullptr) type_.destroy(std::exchange(self_, nullptr));
  }
  bool exists() const { return self_ != nullptr; }
  void start() { type_.start(self_); }
  lockstep_status tick() { return type_.tick(self_); }
  void halt() { type_.halt(self_); }
  void pause() { type_.pause(self_); }
  void resume() { type_.resume(self_); }
  double progress() { return type_.progress(self_); }

  FakeHost host;

 private:
  const lockstep_leaf_type& type_;
  void* self_ = nullptr;
};

}  // namespace sdk_test
