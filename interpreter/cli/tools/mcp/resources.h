// What a client of `lockstep mcp` can read: pages of the documents, example trees, and the
// recording of the last simulation.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/json/json.h"

namespace lockstep::host {

// As `resources/list` has them.
Json list_resources();

struct Resource {
  std::string_view type;  // its media type
  std::string text;
};
// `recording`: its file. Nothing: there is no such resource.
std::optional<Resource> read_resource(std::string_view uri, const std::string& recording);

}  // namespace lockstep::host
