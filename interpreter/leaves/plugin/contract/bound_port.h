// Where the ports of a leaf read and write. A getter that finds a value of its type needs only the
// port's pointer in a table; all the rest of a port lies elsewhere.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/node_type.h"
#include "engine/blackboard.h"
#include "lockstep/leaf.h"

struct lockstep_caller;

namespace lockstep::host {

// The values that a port has handed out or made, until it does so again. Few ports need it.
struct PortMemory {
  std::vector<lockstep_text> texts = {};
  Object packed = {}, unpacked = {};  // an object of another process, and what it was made into
  // The value of the entry, in the port's type: in trees that say so, the entry may have another.
  Value converted = {};
  std::string given = {};  // for lockstep_place's `given`
  Value seen = {};         // at the last call of lockstep_changes
};

struct BoundPort {
  const Parameter* parameter = nullptr;  // null: it was opened by a key
  const Value* read = nullptr;           // null: no value
  Entry* write = nullptr;                // null: an input, or not bound to an entry
  const Value* fallback = nullptr;       // the default, while the entry has no value
  std::string_view entry = {};
  std::unique_ptr<PortMemory> memory = {};
  ValueType type = ValueType::String;
  bool is_strict = true;        // the entry holds values of its type only
  bool is_generic = false;      // takes values of any type; `type` is String
  bool has_limits = false;      // `parameter` does not take every value of its type
  bool is_checked = false;      // `read` is a constant within the limits
  bool is_loose_there = false;  // in the process of the engine, the entry may hold other values

  std::string_view name() const { return parameter != nullptr ? parameter->name : entry; }
  const ObjectType* object() const { return parameter != nullptr ? parameter->object : nullptr; }
  // The value that it has now, of any type. Null: none.
  const Value* value() const {
    const bool is_empty = read == nullptr || std::holds_alternative<NoValue>(*read);
    return is_empty ? fallback : read;
  }
  // The tree binds it to no entry: what the leaf sets is discarded.
  bool is_unbound() const {
    return parameter != nullptr && parameter->direction != Direction::Input && write == nullptr;
  }
  // Each value that is read has to be compared with the limits.
  bool must_be_checked() const { return has_limits && !is_checked; }
  // The value that a getter may hand out without a further look if it has the getter's type. Never
  // null.
  const Value* ordinary() const;
  PortMemory& remembered();
};

bool has_limits(const Parameter& port);

// The ports of some callers. The callers point into it.
class PortTable {
 public:
  void reserve(std::size_t ports);
  BoundPort& add(BoundPort&& port);
  // One that another leaf of the run has, too; it must outlive the table.
  void share(BoundPort& port);
  // Values of entries are not handed out without a further look. Before the first is added.
  void hide_entries() { hides_entries_ = true; }
  std::size_t size() const { return ports_.size(); }
  // Those from `first` on, or so many of them. Not before all ports are added.
  void give_to(lockstep_caller& caller, std::size_t first = 0);
  void give_to(lockstep_caller& caller, std::size_t first, std::size_t count);
  void shrink();  // to the memory that it needs
  BoundPort& operator[](std::size_t port) { return *ports_[port]; }

 private:
  std::vector<std::vector<BoundPort>> own_;  // in blocks, so that none of them moves
  std::vector<BoundPort*> ports_;
  std::vector<const Value*> ordinary_;  // of each
  bool hides_entries_ = false;
};

// Binds the ports of leaves. Ports with the same constant are one, and leaves of a type with the
// same constants have the same ports.
class PortBinder {
 public:
  PortBinder(const Tree& tree, Blackboard& blackboard, PortTable& ports)
      : tree_(tree), blackboard_(blackboard), ports_(ports) {}
  // Adds the ports of a node, unless they are there. Returns the first.
  std::size_t bind(const LeafNode& node);

 private:
  void bind(const PortBinding& binding, const Parameter& parameter);

  const Tree& tree_;
  Blackboard& blackboard_;
  PortTable& ports_;
  // The port that was bound last, at a place that its constant and parameter give, or its type.
  struct KnownPort {
    std::uint32_t constant;
    BoundPort* port = nullptr;
  };
  struct KnownLeaf {
    const LeafNode* leaf = nullptr;
    std::size_t first;
  };
  bool has_same_constants(const LeafNode& node, const LeafNode& other) const;

  std::array<KnownPort, 256> known_ports_{};
  std::array<KnownLeaf, 64> known_leaves_{};
};

}  // namespace lockstep::host
