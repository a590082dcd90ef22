#include "run/checkpoint/run_bytes.h"

#include <algorithm>

#include "engine/tree.h"
#include "run/checkpoint/archive.h"

namespace lockstep::host {

// --- what has fields, for both directions --------------------------------------------------------

void fields(auto& it, Is<Flag> auto& flag) {
  it(flag.is_set);
}

void fields(auto& it, Is<Cell> auto& cell) {
  it(cell.integer);  // the widest: all of it
}

void fields(auto& it, Is<Fault> auto& fault) {
  it(fault.node, fault.message, fault.in_last_halt);
}

void fields(auto& it, Is<GivenAnswer> auto& given) {
  it(given.node, given.number, given.answer, given.who);
}

void fields(auto& it, Is<OutOfRange> auto& found) {
  it(found.node, found.reported);
}

void fields(auto& it, Is<WentOn> auto& found) {
  it(found.node, found.from, found.to);
}

void fields(auto& it, Is<HeldLeaves::Held> auto& held) {
  it(held.node, held.rises, held.from, held.most);
}

void fields(auto& it, Is<HeldLeaves> auto& held) {
  HeldLeaves::visit(held, it);
}

void fields(auto& it, Is<BoundParameters::Values> auto& values) {
  it(values.values, values.seen, values.space, values.known);
}

void fields(auto& it, Is<BoundParameters::State> auto& parameters) {
  it(parameters.cells, parameters.numbers, parameters.values);
}

// An object is none.
void fields([[maybe_unused]] auto& it, Is<Object> auto& /*object*/) {
  if constexpr (std::remove_reference_t<decltype(it)>::kReads) it.fail();
}

void fields(auto& /*it*/, Is<NoValue> auto& /*value*/) {}

template <std::size_t kAt = 0>
void read_alternative(ByteReader& it, std::size_t index, Value& value) {
  if constexpr (kAt < std::variant_size_v<Value>) {
    if (index == kAt) {
      it(value.emplace<kAt>());
    } else {
      read_alternative<kAt + 1>(it, index, value);
    }
  } else {
    it.fail();
  }
}

template <class It>
void fields(It& it, Is<Value> auto& value) {
  if constexpr (It::kReads) {
    std::uint8_t index = 0;
    it(index);
    read_alternative(it, index, value);
  } else if (std::holds_alternative<Object>(value)) {
    it(std::uint8_t{0});
  } else {
    it(static_cast<std::uint8_t>(value.index()));
    std::visit([&it](const auto& alternative) { it(alternative); }, value);
  }
}

// Of which type an object is follows from the tree.
template <class It>
void fields(It& it, Is<Entry> auto& entry) {
  if constexpr (It::kReads) {
    Value value;
    std::uint32_t writes = 0;
    it(value, writes, entry.type, entry.typing, entry.is_present);
    if (entry.type > ValueType::Object || entry.typing > Typing::Any) it.fail();
    entry.assign(std::move(value));
    entry.count_from(writes);
  } else {
    it(entry.value(), entry.writes(), entry.type, entry.typing, entry.is_present);
  }
}

// What time alone changes.
void passing(auto& it, Is<RunState> auto& run) {
  it(run.now, run.tick_number, run.last_tick);
}

void fields(auto& it, Is<RunState> auto& run) {
  it(run.activity, run.bytes, run.asked_by, run.in_last_halt, run.interrupted, run.faulted,
     run.fault, run.failing, run.failed_leaves, run.tolerated, run.ended, run.out_of_range,
     run.kept_values);
}

// Of a SavedRun, or of RunParts.
void lasting(auto& it, auto& run, auto& failed) {
  it(run.run, run.entries, run.named, run.parameters, run.held_leaves, run.answers, failed);
}

namespace {

bool holds_object(const Entry& entry) {
  const auto* object = std::get_if<Object>(&entry.value());
  return object != nullptr && object->get() != nullptr;
}

bool is_for_objects(const auto& entry) {
  return entry.typing != Typing::Any && entry.type == ValueType::Object;
}

// Of a node that exists.
bool are_nodes(const auto& list, std::size_t nodes) {
  return std::ranges::all_of(list, [nodes](const auto& it) {
    if constexpr (requires { it.node; }) {
      return it.node < nodes;
    } else {
      return it < nodes;
    }
  });
}

bool is_activity(Activity activity) {
  return activity <= Activity::Skipped || activity == Activity::Paused;
}

bool fits(const RunState& run, const Tree& tree) {
  const std::size_t nodes = tree.nodes.size();
  return run.activity.size() == nodes && run.last_tick.size() == nodes &&
         run.bytes.size() == RunState(tree).bytes.size() &&
         std::ranges::all_of(run.activity, is_activity) && run.asked_by <= nodes &&
         run.fault.node < nodes && are_nodes(run.failing, nodes) &&
         are_nodes(run.failed_leaves, nodes) && are_nodes(run.tolerated, nodes) &&
         are_nodes(run.ended, nodes) && are_nodes(run.out_of_range, nodes);
}

bool fits(const BoundParameters::State& parameters, const Tree& tree) {
  if (tree.bound.empty()) return parameters.cells.empty();
  if (parameters.cells.size() != tree.cells.size() ||
      parameters.numbers.size() < tree.numbers.size() ||
      parameters.values.size() != tree.bound.size()) {
    return false;
  }
  for (std::size_t i = 0; i < tree.bound.size(); ++i) {
    const std::size_t count = tree.labels[tree.bound[i].node].type->parameters.size();
    const BoundParameters::Values& it = parameters.values[i];
    if (it.values.size() != count || it.seen.size() != count || it.space.size() != count) {
      return false;
    }
  }
  return true;
}

bool fits(const HeldLeaves& held, std::size_t nodes) {
  bool good = true;
  HeldLeaves::visit(held, [&](const auto&... lists) { good = (are_nodes(lists, nodes) && ...); });
  return good;
}

bool fits(const std::vector<Entry>& entries, const Tree& tree) {
  return std::ranges::equal(entries, tree.slots, [](const Entry& entry, const Slot& slot) {
    return slot.typing != Typing::Strict ||
           (entry.typing == Typing::Strict && entry.type == slot.type);
  });
}

// A leaf that runs has begun, and what it has reported once is in the lists of the run.
void give_flags(const Tree& tree, const std::vector<std::uint32_t>& failed, SavedRun& into) {
  into.leaves.assign(tree.leaves.size(), {});
  for (std::uint32_t place = 0; place < tree.leaves.size(); ++place) {
    const Activity activity = into.run.activity[tree.leaves[place].node];
    into.leaves[place].started = status_of(activity) == Status::Running;
  }
  const auto set = [&](bool SlotState::*flag, NodeIndex node) {
    const auto leaf = std::ranges::lower_bound(tree.leaves, node, {}, &LeafNode::node);
    if (leaf == tree.leaves.end() || leaf->node != node) return;
    into.leaves[static_cast<std::size_t>(leaf - tree.leaves.begin())].*flag = true;
  };
  for (const std::uint32_t place : failed) into.leaves[place].failed = true;
  for (const OutOfRange& it : into.run.out_of_range) set(&SlotState::out_of_range, it.node);
  for (const WentOn& it : into.held_leaves.went_on()) set(&SlotState::went_on, it.node);
}

}  // namespace

std::size_t append_bytes(const RunParts& run, const LeafBytes& leaves, std::string& to) {
  ByteWriter writer(to);
  const std::size_t begin = to.size();
  passing(writer, run.run);
  const std::size_t size = to.size() - begin;
  lasting(writer, run, run.failed);
  writer(leaves);
  return size;
}

bool read_bytes(std::string_view bytes, const Tree& tree, SavedRun& into, LeafBytes& leaves) {
  ByteReader reader(bytes);
  passing(reader, into.run);
  std::vector<std::uint32_t> failed;
  lasting(reader, into, failed);
  reader(leaves);
  if ((!leaves.empty() && leaves.size() != tree.leaves.size()) || !reader.is_whole() ||
      !fits(into.run, tree) || !fits(into.parameters, tree) ||
      !fits(into.held_leaves, tree.nodes.size()) || !fits(into.entries, tree) ||
      into.named.size() != tree.boards.size() || !are_nodes(failed, tree.leaves.size()) ||
      !are_nodes(into.answers, tree.nodes.size())) {
    return false;
  }
  give_flags(tree, failed, into);
  for (std::size_t slot = 0; slot < tree.slots.size(); ++slot) {
    into.entries[slot].object = tree.slots[slot].object;
  }
  return true;
}

std::vector<Activity> activities_in(std::string_view bytes) {
  ByteReader reader(bytes);
  RunState run;
  passing(reader, run);
  reader(run.activity);  // the first of its fields
  const bool is_good = reader.is_good() && std::ranges::all_of(run.activity, is_activity);
  return is_good ? std::move(run.activity) : std::vector<Activity>();
}

std::optional<std::string> entry_for_objects(const Tree& tree) {
  const auto found = std::ranges::find_if(tree.slots, is_for_objects<Slot>);
  return found == tree.slots.end() ? std::nullopt : std::optional(found->name);
}

std::optional<std::string> entry_with_object(const RunParts& run, const Tree& tree) {
  const auto lost = [](const Entry& it) { return holds_object(it) || is_for_objects(it); };
  for (std::size_t slot = 0; slot < run.entries.size(); ++slot) {
    if (lost(run.entries[slot])) return tree.slots[slot].name;
  }
  for (const auto& board : run.named) {
    for (const auto& [key, entry] : board) {
      if (lost(entry)) return key;
    }
  }
  return std::nullopt;
}

}  // namespace lockstep::host
