#include "package_index.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <sstream>

namespace ros2 {
namespace {

constexpr const char* kKinds[][2] = {{"action", "action"}, {"srv", "service"}, {"msg", "message"}};

std::string word_of(const std::string& kind) {
  for (const auto& [short_word, long_word] : kKinds) {
    if (kind == short_word) return long_word;
  }
  return kind;
}

// The first directory that has the package; "" when none has.
std::string prefix_of(const std::string& package, std::string& resource) {
  const char* const path = std::getenv("AMENT_PREFIX_PATH");
  std::istringstream prefixes(path == nullptr ? "" : path);
  for (std::string prefix; std::getline(prefixes, prefix, ':');) {
    if (prefix.empty()) continue;
    resource = prefix + "/share/ament_index/resource_index/rosidl_interfaces/" + package;
    if (std::ifstream(resource)) return prefix;
  }
  return {};
}

// The names of a kind that the package lists.
std::vector<std::string> names_in(const std::string& resource, const std::string& kind) {
  std::vector<std::string> names;
  std::ifstream file(resource);
  for (std::string line; std::getline(file, line);) {
    const auto dot = line.rfind('.');
    if (line.rfind(kind + "/", 0) != 0 || dot == std::string::npos) continue;
    const std::string name = line.substr(kind.size() + 1, dot - kind.size() - 1);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

std::size_t distance(const std::string& one, const std::string& other) {
  std::vector<std::size_t> row(other.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < one.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < other.size(); ++j) {
      const std::size_t changed = diagonal + (one[i] == other[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

// `what`: "message"; `name`: that of the symbol.
Result<const void*> symbol_of(const TypeName& type, const std::string& prefix,
                              const std::string& what, const std::string& name) {
  const std::string library = prefix + "/lib/lib" + type.package + "__rosidl_typesupport_c.so";
  void* const handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    const char* const why = dlerror();
    return Problem{
        "the types of '" + type.package + "' cannot be loaded: " + (why == nullptr ? library : why),
        "LD_LIBRARY_PATH must have its libraries: source setup.bash"};
  }
  const std::string symbol = "rosidl_typesupport_c__get_" + what + "_type_support_handle__" +
                             type.package + "__" + type.kind + "__" + name;
  using Function = const void* (*)();
  const auto function = reinterpret_cast<Function>(dlsym(handle, symbol.c_str()));
  const void* const support = function == nullptr ? nullptr : function();
  if (support != nullptr) return support;
  return Problem{"'" + library + "' has no type support of " + type.text(),
                 "build the package again"};
}

}  // namespace

std::string suggestion(const std::string& wrong, const std::vector<std::string>& known) {
  std::string nearest;
  std::size_t best = wrong.size() / 3 + 2;
  for (const std::string& it : known) {
    const bool begins_so = wrong.size() > 2 && it.rfind(wrong, 0) == 0;
    const std::size_t far = begins_so ? 1 : distance(wrong, it);
    if (far < best) {
      best = far;
      nearest = it;
    }
  }
  if (!nearest.empty()) return "did you mean '" + nearest + "'?";
  std::string list = known.empty() ? "there are none" : "there are: ";
  for (std::size_t i = 0; i < known.size() && i < 12; ++i) list += (i == 0 ? "" : ", ") + known[i];
  return list + (known.size() > 12 ? ", …" : "");
}

Result<TypeName> parse_type_name(const std::string& text, const std::string& kind) {
  const auto first = text.find('/'), last = text.rfind('/');
  const auto is_word = [](const std::string& word) {
    return !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
      return std::isalnum(c) != 0 || c == '_';
    });
  };
  if (first != std::string::npos) {
    TypeName type{text.substr(0, first),
                  first == last ? kind : text.substr(first + 1, last - first - 1),
                  text.substr(last + 1)};
    if (type.kind == kind && is_word(type.package) && is_word(type.name)) return type;
  }
  return Problem{"'" + text + "' is not the name of a type of " + word_of(kind) + "s",
                 "write package/" + kind + "/Name"};
}

std::string interface_file(const TypeName& type) {
  std::string resource;
  const std::string prefix = prefix_of(type.package, resource);
  if (prefix.empty()) return {};
  return prefix + "/share/" + type.text() + ".idl";
}

Result<const void*> type_support(const TypeName& type) {
  if (std::getenv("AMENT_PREFIX_PATH") == nullptr) {
    return Problem{"no ROS 2 is set up: AMENT_PREFIX_PATH is not set",
                   "source the setup.bash of your ROS 2 and of your workspace first"};
  }
  std::string resource;
  const std::string prefix = prefix_of(type.package, resource);
  if (prefix.empty()) {
    return Problem{"there is no package '" + type.package + "' with interfaces",
                   "AMENT_PREFIX_PATH says where packages are searched: source the setup.bash of "
                   "the workspace that has it"};
  }
  const auto names = names_in(resource, type.kind);
  if (std::find(names.begin(), names.end(), type.name) == names.end()) {
    return Problem{
        "package '" + type.package + "' has no " + word_of(type.kind) + " '" + type.name + "'",
        suggestion(type.name, names)};
  }
  return symbol_of(type, prefix, word_of(type.kind), type.name);
}

Result<const void*> goal_support(const TypeName& action) {
  std::string resource;
  return symbol_of(action, prefix_of(action.package, resource), "message", action.name + "_Goal");
}

}  // namespace ros2
