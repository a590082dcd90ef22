// The table of a leaf type that was made for one element: its own ports, and one for each field.
#pragma once

#include <lockstep/leaf.h>

#include <deque>
#include <string>
#include <vector>

#include "field_values.hpp"
#include "named_leaves.hpp"
#include "result.hpp"

namespace ros2 {

class PortList {
 public:
  // Those that every element has come first.
  template <std::size_t Count>
  explicit PortList(const lockstep_port (&own)[Count], const NamedLeaf* named = nullptr)
      : named_(named) {
    for (const lockstep_port& port : own) list_.push_back(&port);
    if (named != nullptr) list_ = named->ports;
  }
  PortList(const PortList&) = delete;
  PortList& operator=(const PortList&) = delete;

  // "goal.order" for each field, and what a table calls it. The fields outlive this.
  FieldPorts add(const std::string& prefix, const std::vector<Field>& fields,
                 lockstep_direction direction);
  void give_to(lockstep_leaf_type& type) const;

 private:
  void add_one(const std::string& name, const Field& field, lockstep_direction direction,
               FieldPorts& added);

  const NamedLeaf* named_;
  std::deque<lockstep_port> ports_;
  std::deque<std::string> names_;
  std::vector<const lockstep_port*> list_;
};

constexpr lockstep_port input(const char* name, lockstep_type type, const char* default_value,
                              const char* doc, std::uint64_t flags = 0,
                              const char* choices = nullptr, const char* unit = nullptr) {
  return {sizeof(lockstep_port),
          type,
          LOCKSTEP_INPUT,
          name,
          default_value,
          unit,
          doc,
          choices,
          0,
          0,
          nullptr,
          flags};
}

// Whether the tree gives the port anything, a constant or an entry.
bool is_given(const lockstep_host& host, const lockstep_caller* caller, std::uint32_t port);

// Keeps the texts of a refusal for the thread, and returns null.
const lockstep_leaf_type* refuse(lockstep_refusal* why, const char* port, const Problem& problem);

// The text of a fixed port; "" when it is left out.
std::string fixed_text(const lockstep_fixed* fixed, std::uint32_t count, const char* port);

}  // namespace ros2
