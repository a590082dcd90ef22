// Short tags for actions, services and topics, from a table: LOCKSTEP_ROS_NODES, docs/ros2.md.
#pragma once

#include <lockstep/leaf.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace ros2 {

struct NamedLeaf {
  std::string id, kind, type, name;
  std::map<std::string, std::string> names;     // an attribute, and the field or port that it means
  std::map<std::string, std::string> defaults;  // of ports and fields
  std::set<std::string> ignored;                // attributes
  // Made of these: the ports that each element has, and the leaf type.
  std::vector<lockstep_port> own;
  std::vector<const lockstep_port*> ports;
  std::string more_ports;
  lockstep_leaf_type leaf{};

  // What the tag calls a port of the base.
  const char* name_of(const char* port) const;
  // Null: it has none.
  const char* default_of(const std::string& port) const;
};

// The port that tells which row an element is of. Its only value is the tag.
constexpr const char* kTagPort = "tag";
// Null: `tag` is "".
const NamedLeaf* named_leaf(const std::string& tag);

// Reads the tables. Returns "" or what is wrong in them. `bases` are by the words of a row, each of
// which is also the port of the name.
std::string read_named_leaves(const std::map<std::string, const lockstep_leaf_type*>& bases,
                              std::vector<const lockstep_leaf_type*>& types);

}  // namespace ros2
