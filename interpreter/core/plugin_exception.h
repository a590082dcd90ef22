// What a plugin has thrown, in words for a fault. To ask an exception what it is, and to destroy
// it, is to call its plugin once more: that belongs inside the marked call.
#pragma once

#include <exception>
#include <string>
#include <string_view>

#include "core/shortened.h"

namespace lockstep {

// Within a catch block: "threw an exception: out of reach". Its words are shortened.
std::string describe_exception();

// An exception that has been described; describe_exception() says the same of it.
class PluginException : public std::exception {
 public:
  explicit PluginException(std::string_view description)
      : description_(Shortened::as_it_is(description)) {}
  const char* what() const noexcept override { return description_.c_str(); }

 private:
  Shortened description_;
};

// Calls a plugin. Returns what it threw, "" when it came back.
template <class Call>
std::string thrown_by(Call call) {
  try {
    call();
    return {};
  } catch (...) {
    return describe_exception();
  }
}

// Calls a plugin, and throws nothing but a PluginException.
template <class Call>
auto rethrowing(Call call) {
  try {
    return call();
  } catch (...) {
    throw PluginException(describe_exception());
  }
}

}  // namespace lockstep
