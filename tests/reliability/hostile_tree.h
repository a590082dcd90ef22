// Trees around the leaf of hostile.cpp, and the program that runs them.
#pragma once

#include <string>
#include <vector>

#include "support/program.h"

namespace lockstep::host::test {

// What the leaf does wrong, and in which of its functions.
struct Misdeed {
  std::string how;
  std::string where = "tick";
};

// A tree that comes to that function: a Fallback of the leaf, in what that needs, and of
// AlwaysSuccess. The leaf is 'Main/plan/…/arm'.
std::string hostile_tree(const Misdeed& misdeed);

enum class Where { InProcess, Isolated };

// Runs that tree with the options, until it ends.
Outcome run_hostile(const Misdeed& misdeed, Where where, std::vector<std::string> options = {},
                    std::map<std::string, std::string> environment = {});

// For --hang-limit: short for a plugin that hangs, else longer than a busy machine takes.
inline std::string hang_limit(const std::string& how) {
  return contains(how, "hang") ? "0.3" : "30";
}

// The processes that have this text in their command line, by their ids.
std::vector<pid_t> processes_with(const std::string& text);

// A copy of the plugin, by whose path its processes are told from those of other tests.
class OwnPlugin {
 public:
  OwnPlugin();
  std::string directory() const { return directory_.path(""); }
  std::vector<pid_t> processes() const { return processes_with(directory_.path("hostile.so")); }
  bool has_processes() const { return !processes().empty(); }

 private:
  TemporaryDirectory directory_;
};

}  // namespace lockstep::host::test
