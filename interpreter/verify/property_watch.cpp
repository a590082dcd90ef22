#include "verify/property_watch.h"

#include <algorithm>

#include "engine/blackboard.h"
#include "engine/synchronized.h"
#include "judge/measure/live_properties.h"
#include "judge/measure/synchronized_measure.h"

namespace lockstep::host {
namespace {

constexpr std::byte kDecided{1};

}  // namespace

PropertyWatch::PropertyWatch(const Tree& tree, std::span<const Property> properties)
    : first_fact_(tree.slots.size()) {
  for (const Property& it : properties) {
    parts_.push_back({&it, state_size_, std::vector<SeenNode>(it.nodes().size()),
                      std::make_unique<bool[]>(it.comparisons().size())});
    state_size_ += 1 + it.comparisons().size() + it.state_size();
  }
  for (const NodeIndex keeper : synchronized_nodes(tree)) {
    if (!compares_progress(synchronization(tree.nodes[keeper]))) continue;
    const auto children = children_of(tree, keeper);
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      const auto nodes = parts_[part].property->nodes();
      for (std::size_t place = 0; place < nodes.size(); ++place) {
        const auto child = std::ranges::find(children, nodes[place]);
        if (child == children.end() || !parts_[part].property->needs_progress(place)) continue;
        used_.push_back({part, place, keeper, static_cast<std::size_t>(child - children.begin())});
      }
    }
  }
}

void PropertyWatch::begin(std::byte* state) const {
  for (const Part& part : parts_) {
    std::byte* at = state + part.first_byte;
    *at++ = std::byte{0};
    for (const EntryComparison& it : part.property->comparisons()) {
      *at++ = static_cast<std::byte>(it.holds_without_value());
    }
    part.property->begin(at);
  }
}

void PropertyWatch::before_tick(Ticker& ticker) {
  for (Part& part : parts_) {
    const auto nodes = part.property->nodes();
    for (std::size_t place = 0; place < nodes.size(); ++place) {
      if (part.property->needs_progress(place)) {
        part.seen[place].progress = ticker.progress(nodes[place]);
      }
    }
  }
}

void PropertyWatch::compare(Part& part, std::byte* compared, Ticker& ticker,
                            std::span<const FactState> facts) {
  const auto comparisons = part.property->comparisons();
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    if (comparisons[i].entry >= first_fact_) {
      const FactState fact = facts[comparisons[i].entry - first_fact_];
      part.compared[i] = fact == FactState::Unknown
                             ? comparisons[i].holds_without_value()
                             : comparisons[i].holds_for(Value(fact == FactState::True), room_);
      continue;
    }
    const Value& value = ticker.blackboard().entries[comparisons[i].entry].value();
    if (!std::holds_alternative<NoValue>(value)) {
      compared[i] = static_cast<std::byte>(comparisons[i].holds_for(value, room_));
    }
    part.compared[i] = compared[i] != std::byte{0};
  }
}

void PropertyWatch::after_tick(std::byte* state, Ticker& ticker, std::span<const FactState> facts,
                               End end) {
  violated_.clear();
  for (const Used& it : used_) {
    if (!asked_children(ticker, it.keeper)) continue;
    const double used = child_progress(ticker, it.keeper)[it.child];
    parts_[it.part].seen[it.place].progress = is_left_out(used) ? 0 : used;
  }
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    std::byte* const decided = state + part.first_byte;
    if (*decided == kDecided) continue;
    const std::size_t count = part.property->comparisons().size();
    std::byte* const own = decided + 1 + count;
    compare(part, decided + 1, ticker, facts);
    PropertyVerdict verdict = step(part, own, ticker, end);
    if (verdict == PropertyVerdict::Open && end == End::OfRun) verdict = part.property->at_end(own);
    if (verdict == PropertyVerdict::Open) continue;
    if (verdict == PropertyVerdict::Violated) violated_.push_back(i);
    std::fill(decided, own + part.property->state_size(), std::byte{0});
    *decided = kDecided;
  }
}

PropertyVerdict PropertyWatch::step(Part& part, std::byte* own, Ticker& ticker, End end) {
  const Property& property = *part.property;
  const std::span<const bool> compared(part.compared.get(), property.comparisons().size());
  auto verdict = PropertyVerdict::Open;
  const auto see = [&](auto state_of, TickPart of_tick) {
    if (verdict != PropertyVerdict::Open) return;
    const auto nodes = property.nodes();
    for (std::size_t place = 0; place < nodes.size(); ++place) {
      see_node(part.seen[place], state_of(nodes[place]), of_tick.is_first);
    }
    verdict = property.step(own, {.nodes = part.seen, .comparisons = compared}, of_tick);
  };
  const MomentsView moments = ticker.moments();
  const bool ends = end != End::OfRound;
  moments.each_part(moment_, [&](std::span<const NodeState> states, bool is_first, bool is_last) {
    see([&](NodeIndex node) { return states[node]; },
        {.is_first = is_first, .is_last = is_last && ends});
  });
  if (moments.empty()) {
    see([&](NodeIndex node) { return ticker.node_state(node); }, {.is_last = ends});
  }
  return verdict;
}

bool PropertyWatch::knows_rounds() const {
  return used_.empty() && std::ranges::all_of(parts_, [](const Part& part) {
           return part.property->comparisons().empty();
         });
}

bool PropertyWatch::owes(const std::byte* state, std::size_t property) const {
  const Part& part = parts_[property];
  const std::byte* const decided = state + part.first_byte;
  if (*decided == kDecided) return false;
  const std::byte* const own = decided + 1 + part.property->comparisons().size();
  return !part.property->is_of_last_tick() &&
         part.property->at_end(own) == PropertyVerdict::Violated;
}

PropertyNames names_with_facts(const Tree& tree, std::span<const FactRow> facts) {
  PropertyNames names = property_names(shape_of(tree));
  for (const FactRow& it : facts) {
    names.entries.push_back({.key = "fact:" + it.name, .type = "bool", .is_strict = true});
  }
  return names;
}

bool names_fact(const Property& property, const Tree& tree) {
  return std::ranges::any_of(property.comparisons(), [&](const EntryComparison& it) {
    return it.entry >= tree.slots.size();
  });
}

std::vector<bool> nodes_of(std::span<const Property> properties, const Tree& tree) {
  std::vector<bool> found(tree.nodes.size());
  for (const Property& property : properties) {
    for (NodeIndex node : property.nodes()) {
      while (!found[node]) {
        found[node] = true;
        node = tree.labels[node].parent;
      }
    }
  }
  return found;
}

}  // namespace lockstep::host
