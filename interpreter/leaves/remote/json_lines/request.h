// The lines that lockstep writes to a program: JSON, in which "do" and "leaf" come first, so that a
// shell script can tell them apart. docs/programs.md has each.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/core/value.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

class Request {
 public:
  void clear();
  // {"do":"tick","leaf":3
  Request& begin(std::string_view what, std::uint32_t leaf);
  Request& field(std::string_view name, double number);
  Request& field(std::string_view name, std::uint64_t number);
  Request& field(std::string_view name, std::string_view text);
  Request& flag(std::string_view name, bool is_set);
  // "ports": those whose values are not the ones of `sent`, which is brought up to date; all, where
  // it is empty.
  Request& ports(const lockstep_caller& caller, std::vector<Value>& sent);
  // "unbound": the outputs and inouts that the tree binds to no entry, if there are any.
  Request& unbound(const lockstep_caller& caller);
  // "fixed": the constants that may have decided which ports the leaf has, if there are any.
  Request& fixed(const lockstep_caller& caller);
  void end();

  std::string_view text() const { return text_; }
  // Why one of the lines cannot be sent: it is longer than a line may be. "": all can.
  const std::string& too_long() const { return too_long_; }

 private:
  void name(std::string_view name);
  void port(const lockstep_caller& caller, std::uint32_t port, const Value& value);

  std::string text_;  // keeps its capacity
  std::size_t line_ = 0;
  std::string too_long_;
  std::string_view longest_port_;  // of the line
  std::size_t longest_ = 0;        // its size
};

}  // namespace lockstep::host
