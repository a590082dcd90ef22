// The functions of utils/demangle_util.h. Included by it.
#pragma once

#include <cxxabi.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "behaviortree_cpp/utils/demangle_util.h"

namespace BT {

LOCKSTEP_BTCPP_INLINE std::string demangle(const char* name) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> text(
      abi::__cxa_demangle(name, nullptr, nullptr, &status), std::free);
  return status == 0 && text ? text.get() : name;
}
LOCKSTEP_BTCPP_INLINE std::string demangle(const std::type_index& index) {
  return index == typeid(std::string) ? "std::string" : demangle(index.name());
}
LOCKSTEP_BTCPP_INLINE std::string demangle(const std::type_info& info) {
  return demangle(std::type_index(info));
}

namespace lockstep_detail {

// Reads the name of a type up to the end, or to what ends an item of a list.
class ShortName {
 public:
  explicit ShortName(std::string_view name) : rest_(name) {}

  std::string read() {
    std::string name;
    while (!rest_.empty() &&
           std::string_view(",>)").find(rest_.front()) == std::string_view::npos) {
      if (take("__cxx11::")) continue;
      const char next = rest_.front();
      name += next;
      rest_.remove_prefix(1);
      if (next == '<') add_list(name, ">");
      if (next == '(') add_list(name, ")");
    }
    return trimmed(name);
  }

 private:
  bool take(std::string_view text) {
    if (rest_.substr(0, text.size()) != text) return false;
    rest_.remove_prefix(text.size());
    return true;
  }
  static std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    if (first == std::string::npos) return {};
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
  }

  // Adds the arguments of a template without those that the standard library adds to the first.
  void add_list(std::string& name, const char* end) {
    std::string all, first;
    do {
      const std::string item = read();
      if (first.empty()) first = item;
      if (*end == '>' && is_default(item, first)) continue;
      all += (all.empty() ? "" : ", ") + item;
    } while (take(","));
    name += all;
    if (take(end)) name += end;
    constexpr std::string_view kText = "std::basic_string<char>";
    const std::size_t size = name.size() - std::min(name.size(), kText.size());
    if (name.substr(size) == kText) name.replace(size, kText.size(), "std::string");
  }
  static bool is_default(const std::string& argument, const std::string& first) {
    const auto is = [&](const char* name) { return argument == name + ("<" + first + ">"); };
    return argument.substr(0, 15) == "std::allocator<" || is("std::char_traits") ||
           is("std::less") || is("std::hash") || is("std::equal_to") || is("std::default_delete");
  }

  std::string_view rest_;
};

// For a person: "std::map<std::string, double>".
LOCKSTEP_BTCPP_INLINE std::string readable(const std::type_index& type) {
  return ShortName(demangle(type)).read();
}

}  // namespace lockstep_detail
}  // namespace BT
