// The first line of a program, in which it says what leaves it has, as the descriptors of a plugin.
// docs/programs.md has every field.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "core/problem.h"
#include "lockstep/leaf.h"
#include "remote/json_lines/hold.h"

namespace lockstep {

constexpr std::uint64_t kProgramProtocol = 1;

// The table of a plugin with everything that it points to.
class Hello {
 public:
  // `functions` has what every leaf has; those that it does not need are left out.
  static Result<std::unique_ptr<Hello>> read(std::string line, const std::string& plugin, Hold hold,
                                             const lockstep_plugin& plugin_functions,
                                             const lockstep_leaf_type& functions);
  Hello(const Hello&) = delete;
  Hello& operator=(const Hello&) = delete;

  const lockstep_plugin& plugin() const { return plugin_; }
  const std::string& line() const { return line_; }
  // Of a leaf type of the table, by its id.
  Hold hold_of(std::string_view id) const;

 private:
  struct Reader;
  Hello() = default;

  std::string line_;
  std::deque<std::string> texts_;  // elements do not move when one is added
  std::deque<lockstep_port> ports_;
  std::deque<std::vector<const lockstep_port*>> port_lists_;
  std::deque<lockstep_leaf_type> leaves_;
  std::vector<const lockstep_leaf_type*> leaf_list_;
  std::vector<Hold> holds_;  // of leaves_
  lockstep_plugin plugin_{};
};

}  // namespace lockstep
