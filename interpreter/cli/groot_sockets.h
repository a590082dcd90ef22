// Where `run --groot2` is reached.
#pragma once

#include <string>
#include <string_view>

#include "core/problem.h"
#include "groot/sockets.h"

namespace lockstep {

// Where Groot2 looks for a run.
constexpr std::string_view kGrootAddress = "127.0.0.1:1667";

// The value of --groot2, a port and implicitly the one after it. Says where it is, and warns when
// other machines can reach it. Refused if this lockstep knows no Groot2.
Result<GrootSockets> listen_for_groot(const std::string& address);

}  // namespace lockstep
