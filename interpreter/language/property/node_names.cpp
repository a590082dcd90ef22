#include "language/property/node_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "language/property/property_token.h"

namespace lockstep::host {
namespace {

// Whether `end` is all of the path, or its last segments.
bool ends_with(std::string_view path, std::string_view end) {
  if (!path.ends_with(end)) return false;
  return path.size() == end.size() || path[path.size() - end.size() - 1] == '/';
}

std::string_view last_segments(std::string_view path, std::size_t count) {
  std::size_t begin = path.size();
  for (; count > 0; --count) {
    if (begin == 0) return path;
    begin = path.rfind('/', begin - 1);
    if (begin == std::string_view::npos) return path;
  }
  return path.substr(begin + 1);
}

std::size_t segments_of(std::string_view name) {
  return 1 + static_cast<std::size_t>(std::ranges::count(name, '/'));
}

// The shortest end of a path that no other has, or all of it.
std::string_view shortest_end(std::string_view path, std::span<const std::string> paths) {
  for (std::size_t count = 1; count < segments_of(path); ++count) {
    const std::string_view end = last_segments(path, count);
    const auto has_end = [end](const std::string& it) { return ends_with(it, end); };
    if (std::ranges::count_if(paths, has_end) == 1) return end;
  }
  return path;
}

}  // namespace

std::string_view quoted_name(std::string_view text, std::span<const std::string> paths) {
  std::string_view longest;
  for (const std::string& path : paths) {
    for (std::size_t count = 1; count <= segments_of(path); ++count) {
      const std::string_view end = last_segments(path, count);
      if (end.size() > longest.size() && text.starts_with(end) && needs_quotes(end)) longest = end;
    }
  }
  return longest;
}

PathEnds::PathEnds(std::span<const std::string> paths) : nodes_(paths.size()) {
  std::iota(nodes_.begin(), nodes_.end(), std::uint32_t{0});
  std::ranges::sort(nodes_, {}, [&](std::uint32_t node) {
    return std::pair(last_segments(paths[node], 1), node);
  });
}

std::optional<std::uint32_t> PathEnds::find(std::string_view name,
                                            std::span<const std::string> paths, std::uint32_t first,
                                            std::uint32_t end) const {
  const auto key = [&](std::uint32_t node) {
    return std::pair(last_segments(paths[node], 1), node);
  };
  const std::string_view last = last_segments(name, 1);
  std::optional<std::uint32_t> found;
  bool is_one = true;
  for (auto it = std::ranges::lower_bound(nodes_, std::pair(last, first), {}, key);
       it != nodes_.end() && *it < end && last_segments(paths[*it], 1) == last; ++it) {
    if (paths[*it] == name) return *it;
    if (!ends_with(paths[*it], name)) continue;
    is_one = is_one && !found;
    found = *it;
  }
  return is_one ? found : std::nullopt;
}

Result<std::uint32_t> find_node(std::string_view name, std::span<const std::string> paths) {
  constexpr std::size_t kMostListed = 11;  // one more than a message lists
  std::vector<std::uint32_t> found;
  for (std::uint32_t node = 0; node < paths.size(); ++node) {
    if (paths[node] == name) return node;
    if (ends_with(paths[node], name)) found.push_back(node);
  }
  if (found.size() == 1) return found.front();
  if (!found.empty()) {
    std::vector<std::string_view> ends;
    for (const std::uint32_t node : found) {
      ends.push_back(ends.size() < kMostListed ? shortest_end(paths[node], paths) : paths[node]);
    }
    return problem(fmt::format("'{}' is the end of {} paths", brief(name), found.size()),
                   "write more of the one that is meant: " + listed(ends));
  }
  std::vector<std::string_view> ends;
  std::string_view meant;
  for (const std::string& path : paths) {
    ends.push_back(last_segments(path, segments_of(name)));
    if (meant.empty()) meant = end_that_reads(path, name);
  }
  if (meant.empty()) meant = nearest(name, ends);
  std::string hint;
  if (meant.empty()) {
    hint = fmt::format("a node is named by its path or the end of it, as '{}'",
                       paths.empty() ? "" : brief(shortest_end(paths.back(), paths)));
  } else if (needs_quotes(meant)) {
    hint = fmt::format("write '{}', with the quotes", brief(meant));
  } else {
    hint = fmt::format("did you mean '{}'?", brief(meant));
  }
  return problem(fmt::format("no node '{}'", brief(name)), std::move(hint));
}

}  // namespace lockstep::host
