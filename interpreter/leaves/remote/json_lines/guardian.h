// The guardian of a program: a small process between lockstep and the program that a plugin is. It
// starts the program in a separate process group, says how it ended, ends it when it is asked to,
// and lets nothing of it outlive the host, whatever ends the host. It does not see what the two
// say to each other.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace lockstep::host {

// The descriptors that the guardian finds open. It gives 0 and 1 to the program.
struct GuardianDescriptors {
  static constexpr int kRequests = 0;
  static constexpr int kAnswers = 1;
  static constexpr int kControl = 3;  // a socket of packets; its end is the end of the program
  static constexpr int kParent = 4;   // readable when the host has ended
};

// To the host.
struct GuardianReport {
  enum class What : std::int32_t { Started, NotStarted, Ended };
  What what;
  std::int32_t number;  // the process, whose group has its number; errno; or as waitid has it: code
  std::int32_t status;  // and status
};

// To the guardian: TERM and CONT to the group, and KILL after this time.
struct GuardianOrder {
  std::int64_t nanoseconds;  // < 0: never
};

// Where lockstep_leaf.py is.
std::filesystem::path python_modules(const std::filesystem::path& leafhost_directory);

// The body of the guardian's process; returns its exit code. `is_guardian`: it was started by a
// host.
bool is_guardian();
int guard_program(const std::string& path);

}  // namespace lockstep::host
