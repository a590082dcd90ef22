// The types of blackboard entries, as far as a file shows them: by the ports that use them, also as
// models describe these, and by the scripts that assign them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "tree/definition.h"

namespace lockstep::host {

class EntryTypes {
 public:
  // Null: nothing is known.
  explicit EntryTypes(const Definition* definition);

  struct Found {
    std::optional<ValueType> type = {};
    bool has_port = false;    // that gives the type
    bool has_script = false;  // that uses the entry, apart from that of a Switch
    bool has_switch = false;
    bool is_open = false;     // a leaf that nothing describes uses it
    bool has_number = false;  // that a script assigns, or a truth value
  };
  // Of the entry that a parameter of the node at that place names, or of the value of its script.
  Found of(Place node, std::string_view parameter) const;
  // Of the entry that a SubTree gives its tree by this attribute.
  Found of_start_value(Place subtree, std::string_view key);

 private:
  // What the uses of an entry, or of several that one place of the file means, have in common.
  struct Seen {
    std::optional<ValueType> port = {}, script = {}, declared = {};
    bool ports_differ = false, scripts_differ = false;
    int scripts = 0, switches = 0;  // a Switch of lockstep's language has a script
    bool is_open = false, has_number = false;
  };
  static bool is_switch(const NodeType& type);
  static void add(std::optional<ValueType>& seen, bool& differ, ValueType type);
  static Found found(const Seen& seen);
  static Found common(Found one, const Found& other);
  void see_ports(const DefinitionNode& node);
  void see_switch(const Port& port);
  void see_script(const BoundScript& script);
  std::optional<ValueType> value_of(const BoundScript& script) const;
  std::string path_of(std::uint32_t subtree) const;
  Found of_name(const std::string& path, std::string_view key);

  const Definition* definition_;
  std::vector<Seen> entries_;
  std::unordered_map<std::string_view, std::uint32_t> names_;    // of entries
  std::unordered_multimap<std::uint32_t, std::uint32_t> nodes_;  // by the bytes of their places
  std::unordered_map<std::string, Found> by_name_;               // what was looked for
};

}  // namespace lockstep::host
