#include "named_leaves.hpp"

#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>

namespace ros2 {
namespace {

std::map<std::string, std::unique_ptr<NamedLeaf>>& all() {
  static auto& leaves = *new std::map<std::string, std::unique_ptr<NamedLeaf>>;
  return leaves;
}

std::string trimmed(const std::string& text) {
  const char* const blanks = " \t\r";
  const auto first = text.find_first_not_of(blanks);
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// "  path = result.path" names a field, "  is_recovery = nothing" an attribute that is not used, "
// hold : cancel" gives a port a default.
bool read_detail(const std::string& line, NamedLeaf& leaf) {
  const auto at = line.find_first_of("=:");
  if (at == std::string::npos) return false;
  const std::string name = trimmed(line.substr(0, at)), rest = trimmed(line.substr(at + 1));
  if (name.empty() || rest.empty()) return false;
  if (line[at] == '=' && rest == "nothing") return leaf.ignored.insert(name).second;
  return (line[at] == '=' ? leaf.names : leaf.defaults).emplace(name, rest).second;
}

// "Spin action nav2_msgs/action/Spin spin"; without a name, the tree gives it.
std::unique_ptr<NamedLeaf> read_head(const std::string& line) {
  auto leaf = std::make_unique<NamedLeaf>();
  std::istringstream words(line);
  words >> leaf->id >> leaf->kind >> leaf->type >> leaf->name;
  const bool is_kind = leaf->kind == "action" || leaf->kind == "service" || leaf->kind == "topic";
  return is_kind && !leaf->type.empty() ? std::move(leaf) : nullptr;
}

std::string read_file(const std::string& path) {
  std::ifstream file(path);
  if (!file) return "LOCKSTEP_ROS_NODES: the file '" + path + "' cannot be read";
  NamedLeaf* last = nullptr;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::string text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    const std::string place = path + ":" + std::to_string(number) + ": ";
    if (line.front() == ' ' || line.front() == '\t') {
      if (last != nullptr && read_detail(text, *last)) continue;
      return place + "expected NAME = FIELD or PORT : DEFAULT, each name once";
    }
    auto leaf = read_head(text);
    if (leaf == nullptr) return place + "expected TAG action|service|topic TYPE [NAME]";
    const std::string id = leaf->id;
    const auto [at, is_new] = all().emplace(id, std::move(leaf));
    if (!is_new) return place + "'" + id + "' is there twice";
    last = at->second.get();
  }
  return {};
}

// `name_port` is the base's port of the action's or service's name.
void make_leaf(const lockstep_leaf_type& base, const char* name_port, NamedLeaf& leaf) {
  leaf.defaults.emplace("type", leaf.type);
  if (!leaf.name.empty()) leaf.defaults.emplace(name_port, leaf.name);
  for (std::uint32_t i = 0; i < base.port_count; ++i) {
    lockstep_port& port = leaf.own.emplace_back(*base.ports[i]);
    if (const char* const given = leaf.default_of(port.name)) port.default_value = given;
    port.name = leaf.name_of(port.name);
  }
  lockstep_port tag{};
  tag.struct_size = sizeof tag;
  tag.type = LOCKSTEP_STRING;
  tag.direction = LOCKSTEP_INPUT;
  tag.name = kTagPort;
  tag.default_value = tag.choices = leaf.id.c_str();
  tag.flags = LOCKSTEP_FIXED;
  leaf.own.push_back(tag);
  for (const std::string& name : leaf.ignored) {
    lockstep_port& port = leaf.own.emplace_back(tag);
    port.name = name.c_str();
    port.doc = "Not used here.";
    port.default_value = port.choices = nullptr;
    port.flags = LOCKSTEP_OPTIONAL;
  }
  for (const lockstep_port& port : leaf.own) leaf.ports.push_back(&port);
  leaf.more_ports = base.more_ports;
  for (const auto& [name, field] : leaf.names) leaf.more_ports += ";" + name;
  leaf.leaf = base;
  leaf.leaf.id = leaf.id.c_str();
  leaf.leaf.more_ports = leaf.more_ports.c_str();
  leaf.leaf.ports = leaf.ports.data();
  leaf.leaf.port_count = static_cast<std::uint32_t>(leaf.ports.size());
}

}  // namespace

const char* NamedLeaf::name_of(const char* port) const {
  for (const auto& [called, means] : names) {
    if (means == port) return called.c_str();
  }
  return port;
}

const char* NamedLeaf::default_of(const std::string& port) const {
  const auto given = defaults.find(port);
  return given == defaults.end() ? nullptr : given->second.c_str();
}

const NamedLeaf* named_leaf(const std::string& tag) {
  const auto found = all().find(tag);
  return found == all().end() ? nullptr : found->second.get();
}

std::string read_named_leaves(const std::map<std::string, const lockstep_leaf_type*>& bases,
                              std::vector<const lockstep_leaf_type*>& types) {
  const char* const given = std::getenv("LOCKSTEP_ROS_NODES");
  std::istringstream paths(given == nullptr ? "" : given);
  for (std::string path; std::getline(paths, path, ':');) {
    if (path.empty()) continue;
    if (std::string wrong = read_file(path); !wrong.empty()) return wrong;
  }
  for (const auto& [id, leaf] : all()) {
    make_leaf(*bases.at(leaf->kind), leaf->kind.c_str(), *leaf);
    types.push_back(&leaf->leaf);
  }
  return {};
}

}  // namespace ros2
