// The first line of a program, in which it says what leaves it has, as the descriptors of a plugin.
// docs/programs.md has every field.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/core/problem.h"
#include "leaves/remote/json_lines/hold.h"
#include "leaves/remote/owned_descriptors.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

constexpr std::uint64_t kProgramProtocol = 1;

// The table of a plugin with everything that it points to.
class Hello {
 public:
  // `plugin` is the name of the plugin. A leaf has only the functions that it needs.
  static Result<std::unique_ptr<Hello>> read(std::string line, const std::string& plugin,
                                             Hold hold);
  Hello(const Hello&) = delete;
  Hello& operator=(const Hello&) = delete;

  const lockstep_plugin& plugin() const { return tables_.plugin; }
  const std::string& line() const { return line_; }
  // Null: there is none.
  const lockstep_leaf_type* type_named(std::string_view id) const;
  // How a leaf type of the table is held, by its id.
  Hold hold_of(std::string_view id) const;

 private:
  struct Reader;
  Hello() = default;

  std::string line_;
  OwnedDescriptors tables_;
  std::vector<Hold> holds_;  // of each leaf
};

}  // namespace lockstep::host
