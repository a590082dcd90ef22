#include "engine/readings.h"

#include <algorithm>

#include "engine/node_context.h"
#include "engine/resources.h"

namespace lockstep::host {
namespace {

// The member that owned the resource in the last tick and still runs.
std::optional<NodeIndex> owner(NodeContext& context, const BoundReading& it) {
  const ResourceSet wanted = ResourceSet{1} << it.resource;
  for (const Member& member : context.tree().members_of(it.node)) {
    const auto& use = context.state<ResourceUse>(member.node);
    if (resources::owned_in_last_tick(use, wanted) &&
        context.status(member.node) == Status::Running)
      return member.node;
  }
  return std::nullopt;
}

}  // namespace

Readings::Readings(const Tree& tree) : tree_(tree), values_(tree.readings.size()) {
  std::size_t longest = 0;
  for (const BoundReading& it : tree.readings) {
    if (it.what != Reading::What::Owner) continue;
    for (const Member& member : tree.members_of(it.node)) {
      longest = std::max(longest, tree.path(member.node).size());
    }
  }
  path_.reserve(longest);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const ValueType type = row_of(tree.readings[i].what).type;
    values_[i] = Entry(Typing::Strict, type);
    if (type != ValueType::String) continue;
    std::string text;
    text.reserve(longest);
    values_[i].assign(Value(std::move(text)));
  }
}

void Readings::set_text(std::size_t number, std::string_view text) {
  std::get<std::string>(value(number)).assign(text);
}

void Readings::read(NodeContext& context) {
  context.share_progress();  // a node that is asked here is not asked again in this tick
  for (std::size_t i = 0; i < values_.size() && !context.faulted(); ++i) {
    const BoundReading& it = tree_.readings[i];
    switch (it.what) {
      case Reading::What::Progress:
        value(i) = context.progress(it.node);
        break;
      case Reading::What::Held:
        value(i) = context.held(it.node);
        break;
      case Reading::What::Status:
        set_text(i, to_string(context.status(it.node)));
        break;
      case Reading::What::Owner:
        if (const auto node = owner(context, it)) {
          tree_.path(*node, path_);
          set_text(i, path_);
        } else {
          set_text(i, kNoOwner);
        }
        break;
    }
  }
}

}  // namespace lockstep::host
