#pragma once

#include <functional>
#include <string_view>

namespace lockstep::host {

// Receives the next bytes of an exported recording; returns false to stop.
using ExportSink = std::function<bool(std::string_view bytes)>;

}  // namespace lockstep::host
