// All leaves of this plugin share this: the host, their element, ports, lines for the log.
#pragma once

#include <lockstep/ext/reason.h>
#include <lockstep/leaf.h>

#include <string>
#include <vector>

#include "middleware.hpp"
#include "ports.hpp"

namespace ros2 {

// The data of the type that the leaf's element has.
template <class Element>
const Element& element_of(const lockstep_host& host, const lockstep_caller* caller) {
  const auto* const place = static_cast<const lockstep_place*>(host.get_extension(LOCKSTEP_PLACE));
  return *static_cast<const Element*>(place->data(caller));
}

class LeafBase {
 public:
  LeafBase(const lockstep_host& host, const lockstep_caller* caller)
      : host_(host), caller_(caller) {}
  LeafBase(const LeafBase&) = delete;
  LeafBase& operator=(const LeafBase&) = delete;

  void start() {}
  void halt() {}
  void pause() {}
  void resume() {}
  double progress() { return 0; }
  void fail(const char* message) { host_.set_error(caller_, message); }

 protected:
  ~LeafBase() = default;

  double now() const { return host_.now(caller_); }
  double number(std::uint32_t port) const {
    double value = 0;
    host_.get_double(caller_, port, &value);
    return value;
  }
  // Those that the tree gives something to.
  FieldPorts given(const FieldPorts& all) const {
    FieldPorts given;
    for (const auto& it : all) {
      if (is_given(host_, caller_, it.port)) given.push_back(it);
    }
    return given;
  }
  // False after an error. Objects first: the fields of a message change it.
  bool read(const FieldPorts& ports, Message& message) {
    return read_each(ports, message, true) &&
           is_good(size_rows(host_, caller_, ports, message.get())) &&
           read_each(ports, message, false);
  }
  void write(const FieldPorts& ports, const Message& message) {
    for (const auto& [port, field] : ports) {
      write_port({&host_, caller_, port}, *field, message.get());
    }
  }
  void set_text(std::uint32_t port, const std::string& text) {
    host_.set_string(caller_, port, text.data(), text.size());
  }
  // The reason of the result of this tick.
  void say(const std::string& text) {
    if (reason_ != nullptr) reason_->say(caller_, text.c_str());
  }
  // The leaf waits. `make` gives the words for what it waits for: called when `what` is another one
  // than in the last tick.
  template <class Make>
  lockstep_status waits(int what, Make make) {
    if (what != waits_for_) waiting_ = make();
    waits_for_ = what;
    say(waiting_);
    return LOCKSTEP_RUNNING;
  }
  // The leaf fails. `why` goes into the entry of `error`, and to people where the tree has none;
  // with `faults` it ends the run. `words` are those of the server, for people.
  lockstep_status failed(std::uint32_t error, const std::string& of, const std::string& why,
                         bool faults = false, const std::string& words = {}) {
    const std::string line = of + ": " + why + words;
    say(line);
    const bool is_kept = host_.set_string(caller_, error, why.data(), why.size());
    if (faults) {
      fail(line.c_str());
    } else if (!is_kept) {
      host_.log(caller_, LOCKSTEP_LOG_INFO, line.c_str());
    }
    return LOCKSTEP_FAILURE;
  }
  // Lines of the leaf's own client, and of ROS itself.
  template <class Client>
  void log_lines(Client& client) {
    std::string line;
    while (client.lines().next(line) || Middleware::get().next_log_line(line)) {
      host_.log(caller_, LOCKSTEP_LOG_WARNING, line.c_str());
    }
  }

  const lockstep_host& host_;
  const lockstep_caller* caller_;

 private:
  const lockstep_reason* const reason_ =
      static_cast<const lockstep_reason*>(host_.get_extension(LOCKSTEP_REASON));
  std::string waiting_;
  int waits_for_ = -1;

  bool is_good(const std::string& wrong) {
    if (!wrong.empty()) fail(wrong.c_str());
    return wrong.empty();
  }
  bool read_each(const FieldPorts& ports, Message& message, bool objects) {
    for (const auto& [port, field] : ports) {
      if ((field->kind == Field::Kind::Object) != objects) continue;
      if (!is_good(read_port({&host_, caller_, port}, *field, message.get()))) return false;
    }
    return true;
  }
};

// The outcome of a leaf that has failed: it fails, or ends the run.
constexpr lockstep_port kOnFailurePort =
    input("on_failure", LOCKSTEP_STRING, "failure",
          "What the leaf does when it does not succeed: it fails, or ends the run with a fault.",
          LOCKSTEP_FIXED, "failure;fault");

}  // namespace ros2
