#include "observers/recording_text.h"

#include <iterator>
#include <nlohmann/json.hpp>

namespace lockstep {

void append_seconds(fmt::memory_buffer& out, Nanoseconds time) {
  const auto total = static_cast<std::uint64_t>(time.count());
  fmt::format_to(std::back_inserter(out), "{}.{:09}", total / 1'000'000'000, total % 1'000'000'000);
  std::size_t size = out.size();
  while (out[size - 1] == '0' && out[size - 2] != '.') --size;
  out.resize(size);
}

void append_node(fmt::memory_buffer& out, NodeIndex node, const RecordedState& state) {
  fmt::format_to(std::back_inserter(out), "[{},\"{}\",{},{:d},{:d}]", node, to_string(state.status),
                 state.progress, state.ticked, state.held);
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
