// A text as one zstd frame that says how long the text is.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/compression/seek_table.h"

namespace lockstep::host {

// Throws a std::runtime_error if there is no libzstd.
std::string zstd_frame(std::string_view text);
// The sizes of the frame that the bytes begin with. None: it is cut, it is none, or it does not say
// how long its text is.
std::optional<FrameSize> first_frame(std::string_view bytes);
// The text of a whole frame, so long. "" if it is damaged.
std::string frame_text(std::string_view frame, std::size_t size);

}  // namespace lockstep::host
