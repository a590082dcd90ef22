#include "observers/recording_text.h"

#include <fmt/compile.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

namespace lockstep {

void append_seconds(fmt::memory_buffer& out, Nanoseconds time) {
  const auto total = static_cast<std::uint64_t>(time.count());
  fmt::format_to(std::back_inserter(out), "{}.{:09}", total / 1'000'000'000, total % 1'000'000'000);
  std::size_t size = out.size();
  while (out[size - 1] == '0' && out[size - 2] != '.') --size;
  out.resize(size);
}

namespace {

char* put(char* to, std::string_view text) {
  return std::copy(text.begin(), text.end(), to);
}

// Of nodes that change, most have not begun, have ended, or stand where their parent does: writing
// a number takes longer than all the rest.
char* put_progress(char* to, double progress) {
  if (progress == 1.0) return put(to, "1");
  if (progress == 0.0 && !std::signbit(progress)) return put(to, "0");
  return fmt::format_to(to, FMT_COMPILE("{}"), progress);
}

}  // namespace

void append_node(fmt::memory_buffer& out, NodeIndex node, const RecordedState& state) {
  constexpr std::string_view kStatus[] = {",\"idle\",", ",\"running\",", ",\"success\",",
                                          ",\"failure\","};
  constexpr std::string_view kFlags[] = {",0,0]", ",0,1]", ",1,0]", ",1,1]"};
  const std::size_t before = out.size();
  out.resize(before + kMostOfNode);
  char* to = put(out.data() + before, "[");
  to = std::to_chars(to, to + std::numeric_limits<NodeIndex>::digits10 + 1, node).ptr;
  to = put(to, kStatus[static_cast<unsigned>(state.status)]);
  to = put_progress(to, state.progress);
  to = put(to, kFlags[2 * state.ticked + state.held]);
  out.resize(static_cast<std::size_t>(to - out.data()));
}

void append_faults(fmt::memory_buffer& out, std::span<const Fault> faults) {
  constexpr std::size_t kMostOfMessage = 4096;
  out.push_back('[');
  for (const Fault& fault : faults) {
    if (&fault != faults.data()) out.push_back(',');
    const nlohmann::json json = {fault.node, fault.message.substr(0, kMostOfMessage)};
    append_text(out, json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  }
  out.push_back(']');
}

void append_lost(fmt::memory_buffer& out, std::uint64_t ticks, std::uint64_t from) {
  fmt::format_to(std::back_inserter(out), "{{\"lost\":{{\"ticks\":{},\"from\":{}}}}}\n", ticks,
                 from);
}

}  // namespace lockstep
