#include "record/write/same_entries.h"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>
#include <set>
#include <string_view>

#include "base/compression/decompressed.h"
#include "base/core/wording.h"
#include "base/json/reader.h"
#include "record/header_line.h"
#include "record/lines.h"

namespace lockstep::host {
namespace {

struct Recorded {
  std::string tree;
  std::size_t nodes = 0;
  std::set<std::string> keys;
};

// Nothing: the file does not begin with the header of a recording.
std::optional<Recorded> read_recorded(const std::string& path) {
  Recorded recorded;
  try {
    auto line = header_line(path);
    if (!line) return std::nullopt;
    JsonReader().read(*line, [&](JsonObject header) {
      header.read(
          {{lines::kHeader["tree"], into(recorded.tree)},
           {lines::kHeader["nodes"], [&](JsonValue it) { recorded.nodes = it.count_items(); }},
           {lines::kHeader["entries"],
            [&](JsonValue list) {
              list.each_item([&](JsonValue entry) {
                std::string key;
                entry.object().read({{lines::kHeaderEntry["key"], into(key)}});
                recorded.keys.insert(key);
              });
            },
            kMayLack}});
    });
    return recorded;
  } catch (const JsonError&) {
    return std::nullopt;
  } catch (const CannotDecompress&) {
    return std::nullopt;
  }
}

}  // namespace

Result<void> check_same_entries(const std::vector<std::string>& files, const Shape& shape,
                                const std::optional<std::vector<std::string>>& keys) {
  std::set<std::string> wanted;
  if (keys) {
    wanted.insert(keys->begin(), keys->end());
  } else {
    for (const ShapeEntry& it : shape.entries) wanted.insert(it.key);
  }
  for (const std::string& path : std::views::reverse(files)) {
    const auto recorded = read_recorded(path);
    if (!recorded) continue;
    const bool is_of_tree = recorded->tree == shape.id && recorded->nodes == shape.nodes.size();
    if (!is_of_tree || recorded->keys == wanted) return {};
    const std::vector<std::string_view> names(recorded->keys.begin(), recorded->keys.end());
    return problem(
        fmt::format(
            "'{}', the recording of the run before the cut, has other blackboard entries: {}", path,
            names.empty() ? "none" : listed(names)),
        "use the same --record-entries, or another --record");
  }
  return {};
}

}  // namespace lockstep::host
