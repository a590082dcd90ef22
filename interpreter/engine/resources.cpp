#include "engine/resources.h"

#include <algorithm>

#include "core/wording.h"

namespace lockstep::resources {
namespace {

// Whether the barriers and the outer pools of a member let ticks through.
bool is_open(Ticker& ticker, NodeIndex gate) {
  const bool is_barrier = !is_pool(ticker.tree(), ticker.membership(gate).group);
  if (is_barrier) return !is_held_at_barrier(ticker, gate);
  const auto& outer = ticker.state<ResourceUse>(gate);
  return has_asked(ticker, outer) && outer.grant == Grant::Owned;
}

void answer(Ticker& ticker, const Member& member, ResourceSet wanted, Grant grant) {
  auto& use = ticker.state<ResourceUse>(member.node);
  use.asked = ticker.tick_number();
  use.grant = grant;
  use.owned = grant == Grant::Owned ? wanted : 0;
  use.limit = grant == Grant::Closed ? 0.0 : static_cast<double>(wanted);
  if (grant == Grant::Denied) use.limit = -use.limit;
  if (grant == Grant::Owned) use.priority = 0;
  ticker.state<ResourcePool>(member.group).owned |= use.owned;
}

}  // namespace

std::optional<RuleBreak> check_list(const ParameterValues& given, unsigned parameter) {
  const auto* list = std::get_if<std::string>(&given.values[parameter]);
  if (list == nullptr) return std::nullopt;
  const auto place = static_cast<int>(parameter);
  std::string_view rest = *list;
  std::string_view name = take_resource(rest);
  if (name.empty()) {
    return RuleBreak{place, "'resources' names nothing",
                     "write such as resources=\"left;gripper\""};
  }
  for (; !name.empty(); name = take_resource(rest)) {
    std::string_view behind = rest;
    for (auto it = take_resource(behind); !it.empty(); it = take_resource(behind)) {
      if (it != name) continue;
      return RuleBreak{place, "the resource '" + brief(name) + "' is named twice", ""};
    }
  }
  return std::nullopt;
}

void ask(Ticker& ticker, NodeIndex node) {
  const Member& member = ticker.membership(node);
  const auto wanted = static_cast<ResourceSet>(ticker.parameter(node, kResources).integer);
  const auto gates = ticker.tree().gates_of(member);
  if (!std::ranges::all_of(gates, [&](NodeIndex gate) { return is_open(ticker, gate); })) {
    return answer(ticker, member, wanted, Grant::Closed);
  }
  const ResourceSet owned = ticker.state<ResourcePool>(member.group).owned;
  answer(ticker, member, wanted, (owned & wanted) == 0 ? Grant::Owned : Grant::Denied);
}

bool keeps(Ticker& ticker, NodeIndex node) {
  const bool may_keep = ticker.parameter(node, kKeep).boolean;
  return may_keep && ticker.status(node + 1) == Status::Running;
}

void keep(Ticker& ticker, NodeIndex node) {
  answer(ticker, ticker.membership(node), ticker.state<ResourceUse>(node).owned, Grant::Owned);
}

void give_back(Ticker& ticker, NodeIndex node) {
  auto& use = ticker.state<ResourceUse>(node);
  ticker.state<ResourcePool>(ticker.membership(node).group).owned &= ~use.owned;
  use.owned = 0;
  use.limit = 0.0;
}

}  // namespace lockstep::resources
