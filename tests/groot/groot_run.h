// A run that Groot2 can see, and what a client of its protocol learns from it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "support/json.h"
#include "support/program.h"

namespace lockstep::host::test {

// What the client, tests/groot/client.py, prints of each answer.
std::vector<nlohmann::json> ask_groot(unsigned port, std::vector<std::string> requests);

// A run of this tree on the virtual clock that begins paused; `more` come behind its options.
class GrootRun {
 public:
  explicit GrootRun(const std::string& tree, std::vector<std::string> more = {});

  unsigned port() const { return port_; }
  std::vector<nlohmann::json> ask_all(std::vector<std::string> requests) const {
    return ask_groot(port_, std::move(requests));
  }
  // The value of one answer.
  nlohmann::json ask(const std::string& request) const { return ask_all({request})[0]; }
  // Asks again until the value of the answer is this.
  void wait_for(const std::string& request, const nlohmann::json& value) const;
  // So many ticks; returns when they are over.
  void step(int ticks);
  // What the page of the monitor orders.
  void order(const nlohmann::json& body) const;
  // To its end.
  Outcome resume();
  Process& process() { return process_; }

 private:
  TemporaryDirectory directory_;
  Process process_;
  unsigned port_ = 0, monitor_port_ = 0;
  int ticked_ = 0;
  std::string token_;
};

}  // namespace lockstep::host::test
