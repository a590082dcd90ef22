// Fields of a message as values of ports, and as numbers.
#pragma once

#include <lockstep/leaf.h>

#include <optional>
#include <string>
#include <vector>

#include "fields.hpp"

namespace ros2 {

// One port of a leaf, and the field of a message that it has the value of.
struct PortOf {
  const lockstep_host* host;
  const lockstep_caller* caller;
  std::uint32_t port;
};

// A port of a leaf type, by its index, and its field.
struct FieldPort {
  std::uint32_t port;
  const Field* field;
};
using FieldPorts = std::vector<FieldPort>;

// Gives the sequences of messages, of which the ports are columns, as many messages as the longest
// column has. Returns "" or what is wrong.
std::string size_rows(const lockstep_host& host, const lockstep_caller* caller,
                      const FieldPorts& ports, void* message);
// Sets the field if the port has a value. Returns "" or what is wrong.
std::string read_port(const PortOf& from, const Field& field, void* message);
// Sets the entry that the port is bound to, if any.
void write_port(const PortOf& to, const Field& field, const void* message);
// The part of a message that is an Object: a new one with one reference, or null.
void* object_in(const Field& field, const void* message);

// "header.frame_id: map, pose.position.x: 1": what is not 0 or empty.
std::string text_of(const Members& members, const void* message);

// Nothing: it is no number. A bool is 0 or 1.
std::optional<double> number_in(const Field& field, const void* message);
// Of a Bool, Int or Double: a whole number is rounded, and what is out of its range is not.
void set_number(const Field& field, void* message, double value);
// The number of items of a list, or bytes of a string.
std::optional<double> size_in(const Field& field, const void* message);

}  // namespace ros2
