// The lines of a program after its first: JSON, one object each.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/json/reader.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

struct Reply {
  enum class What : std::uint8_t {
    Status,    // the answer to tick
    Done,      // the answer to create, restore, pause and halt
    Progress,  // unasked; or only what it keeps
    Pace,      // likewise
    Log,
    Error,
  };
  What what{};
  std::uint64_t leaf = 0;  // 0: the program itself
  lockstep_status status = 0;
  std::optional<double> progress;
  double pace = 0;                                       // of Pace
  bool sets_ports = false;                               // the line also has "set"
  std::string text;                                      // of Log and Error
  std::string reason;                                    // of Status
  std::optional<std::string> kept;                       // for a checkpoint; not of Log and Error
  lockstep_after_cut after_cut = LOCKSTEP_STARTS_AGAIN;  // of Done
  lockstep_log_level level = LOCKSTEP_LOG_INFO;
};

// "" or what is wrong with the line. `reply` may be used again.
std::string read_reply(JsonReader& reader, std::string& line, Reply& reply);

}  // namespace lockstep::host
