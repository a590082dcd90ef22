#include "verify/property_watch.h"

#include <algorithm>

#include "engine/tree.h"
#include "run/shape_of.h"

namespace lockstep::host {
namespace {

constexpr std::byte kDecided{1};

AskedOfRun asked_by(std::span<const Property> properties) {
  AskedOfRun asked{.within = true};
  for (const Property& it : properties) {
    for (std::size_t place = 0; place < it.nodes().size(); ++place) {
      if (it.needs_progress(place)) asked.progress.push_back(it.nodes()[place]);
    }
  }
  return asked;
}

}  // namespace

PropertyWatch::PropertyWatch(const Tree& tree, std::span<const Property> properties)
    : first_fact_(tree.slots.size()), moments_(tree, asked_by(properties)) {
  for (const Property& it : properties) {
    parts_.push_back({&it, state_size_, std::vector<SeenNode>(it.nodes().size()),
                      std::make_unique<bool[]>(it.comparisons().size())});
    state_size_ += 1 + it.comparisons().size() + it.state_size();
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

void PropertyWatch::compare(Part& part, std::byte* compared, const Moment& moment,
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
    const Value& value = moment.entries[comparisons[i].entry].value();
    if (!std::holds_alternative<NoValue>(value)) {
      compared[i] = static_cast<std::byte>(comparisons[i].holds_for(value, room_));
    }
    part.compared[i] = compared[i] != std::byte{0};
  }
}

void PropertyWatch::after_tick(std::byte* state, Ticker& ticker, std::span<const FactState> facts,
                               End end) {
  violated_.clear();
  const Moment& moment = moments_.after_tick(ticker, 0, {});
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    std::byte* const decided = state + part.first_byte;
    if (*decided == kDecided) continue;
    const std::size_t count = part.property->comparisons().size();
    std::byte* const own = decided + 1 + count;
    compare(part, decided + 1, moment, facts);
    PropertyVerdict verdict = step(part, own, moment, end != End::OfRound);
    if (verdict == PropertyVerdict::Open && end == End::OfRun) verdict = part.property->at_end(own);
    if (verdict == PropertyVerdict::Open) continue;
    if (verdict == PropertyVerdict::Violated) violated_.push_back(i);
    std::fill(decided, own + part.property->state_size(), std::byte{0});
    *decided = kDecided;
  }
}

PropertyVerdict PropertyWatch::step(Part& part, std::byte* own, const Moment& moment,
                                    bool ends_tick) {
  const Property& property = *part.property;
  const auto nodes = property.nodes();
  for (std::size_t place = 0; place < nodes.size(); ++place) {
    if (property.needs_progress(place)) part.seen[place].progress = moment.progress[nodes[place]];
  }
  const std::span<const bool> compared(part.compared.get(), property.comparisons().size());
  auto verdict = PropertyVerdict::Open;
  steps_.each(moment, nodes, part.seen, [&](TickPart of_tick) {
    if (verdict != PropertyVerdict::Open) return;
    verdict =
        property.step(own, {.nodes = part.seen, .comparisons = compared},
                      {.is_first = of_tick.is_first, .is_last = of_tick.is_last && ends_tick});
  });
  return verdict;
}

bool PropertyWatch::knows_rounds() const {
  return std::ranges::all_of(parts_, [](const Part& part) {
    if (!part.property->comparisons().empty()) return false;
    for (std::size_t place = 0; place < part.seen.size(); ++place) {
      if (part.property->needs_progress(place)) return false;
    }
    return true;
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
  const auto add = [&](NodeIndex node) {
    while (!found[node]) {
      found[node] = true;
      node = tree.labels[node].parent;
    }
  };
  for (const Property& property : properties) std::ranges::for_each(property.nodes(), add);
  for (const BoundReading& it : tree.readings) add(it.node);
  return found;
}

}  // namespace lockstep::host
