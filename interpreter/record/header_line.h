// The first line of a recording, for who must know what a file is without reading it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lockstep::host {

inline constexpr std::string_view kHeaderBegin = "{\"lockstep_recording\":";

// Of a file that begins as recordings do, as far as it goes: a crash may have left only a part of
// it, or nothing. None: it is another file. Throws CannotDecompress.
std::optional<std::string> header_line(const std::string& path);

}  // namespace lockstep::host
