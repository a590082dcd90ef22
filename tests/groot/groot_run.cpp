#include "groot/groot_run.h"

#include <catch2/catch.hpp>

#include "web/client.h"

namespace lockstep::host::test {
namespace {

std::vector<std::string> arguments(const std::string& tree, std::vector<std::string> more) {
  std::vector<std::string> all{"run",     tree,      "--groot2",        "0",
                               "--clock", "virtual", "--monitor",       "--monitor-control",
                               "--view",  "none",    "--monitor-paused"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

// What stands in a line behind `begin`.
std::string rest_of_line(Process& process, const std::string& begin) {
  REQUIRE(process.wait_for(begin));
  const auto at = [&] { return process.so_far().err.find(begin) + begin.size(); };
  while (process.so_far().err.find('\n', at()) == std::string::npos) REQUIRE(process.read_on());
  const std::string& said = process.so_far().err;
  return said.substr(at(), said.find('\n', at()) - at());
}

}  // namespace

std::vector<nlohmann::json> ask_groot(unsigned port, std::vector<std::string> requests) {
  requests.insert(requests.begin(),
                  {LOCKSTEP_SOURCE_DIR "/tests/groot/client.py", std::to_string(port)});
  const Outcome outcome = run({.arguments = std::move(requests), .program = "/usr/bin/python3"});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  std::vector<nlohmann::json> answers;
  for (const std::string& line : lines(outcome.out)) answers.push_back(parse_json(line));
  return answers;
}

GrootRun::GrootRun(const std::string& tree, std::vector<std::string> more)
    : process_({.arguments = arguments(directory_.file("tree.xml", tree), std::move(more))}) {
  const std::string address = rest_of_line(process_, "groot2: ");
  port_ = static_cast<unsigned>(std::stoi(address.substr(address.rfind(':') + 1)));
  const std::string link = rest_of_line(process_, "monitor: http://127.0.0.1:");
  monitor_port_ = static_cast<unsigned>(std::stoi(link));
  token_ = link.substr(link.find("#token=") + 7);
}

void GrootRun::wait_for(const std::string& request, const nlohmann::json& value) const {
  constexpr int kTries = 50;
  nlohmann::json said = ask(request)["value"];
  for (int tries = 1; said != value && tries < kTries; ++tries) said = ask(request)["value"];
  CHECK(said == value);
}

void GrootRun::order(const nlohmann::json& body) const {
  REQUIRE(
      post(monitor_port_, "/control", body.dump(), "X-Lockstep-Token: " + token_ + "\r\n").status ==
      204);
}

void GrootRun::step(int ticks) {
  Client events(monitor_port_);
  events.send(get_text(monitor_port_, "/events", "X-Lockstep-Token: " + token_ + "\r\n"));
  order({{"do", "step"}, {"ticks", ticks}});
  ticked_ += ticks;
  REQUIRE(events.wait_for("{\"tick\":" + std::to_string(ticked_ - 1) + ","));
}

Outcome GrootRun::resume() {
  order({{"do", "resume"}});
  return process_.finish();
}

}  // namespace lockstep::host::test
