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
  void clear() { text_.clear(); }
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
  void end() { text_ += "}\n"; }

  std::string_view text() const { return text_; }

 private:
  void name(std::string_view name);
  std::string text_;  // keeps its capacity
};

}  // namespace lockstep::host
