// Describes an exception from a plugin for the message of a fault. Calling what() of an exception
// and destroying it are calls of the plugin, so both happen inside the marked call.
#pragma once

#include <exception>
#include <string>
#include <string_view>

#include "base/core/shortened.h"

namespace lockstep::host {

// Within a catch block: "threw an exception: out of reach". Its words are shortened.
std::string describe_exception();

// Before the first plugin is loaded. The exceptions of a plugin that brings its own C++ runtime are
// caught by functions of ours that belong to another unwinder: this one must have begun, or the
// process aborts.
void ready_to_catch();

// An exception that was already described; describe_exception() returns that description.
class PluginException : public std::exception {
 public:
  explicit PluginException(std::string_view description)
      : description_(Shortened::as_it_is(description)) {}
  const char* what() const noexcept override { return description_.c_str(); }

 private:
  Shortened description_;
};

// Calls a plugin. Returns the description of what it threw, or "" if it returned.
template <class Call>
std::string thrown_by(Call call) {
  try {
    call();
    return {};
  } catch (...) {
    return describe_exception();
  }
}

// Calls a plugin, and throws only PluginException.
template <class Call>
auto rethrowing(Call call) {
  try {
    return call();
  } catch (...) {
    throw PluginException(describe_exception());
  }
}

}  // namespace lockstep::host
