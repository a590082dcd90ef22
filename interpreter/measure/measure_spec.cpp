#include "measure/measure_spec.h"

#include <vector>

#include "core/suggest.h"
#include "core/value.h"

namespace lockstep {
namespace {

struct Name {
  std::string_view text;
  MeasureKind kind;
  std::string_view axis;
};

constexpr Name kNames[] = {
    {"progress-distance", MeasureKind::ProgressDistance, "progress distance"},
    {"step-length", MeasureKind::StepLength, "step length"},
    {"duration", MeasureKind::Duration, "duration (s)"},
    {"predictability", MeasureKind::Predictability, "predictability distance (ticks)"},
};

std::string quoted(std::string_view text) {
  return std::string("'").append(text).append("'");
}

// `text` is NODE@P[=T]. A path may hold '@' and '=', so P is what follows the last '@'.
std::optional<MeasureSpec> parse_predictability(std::string_view text, std::string& error) {
  const auto at = text.rfind('@');
  if (at == std::string_view::npos || at == 0) {
    error = "expected 'predictability:NODE@P' or 'predictability:NODE@P=T'";
    return std::nullopt;
  }
  const auto equals = text.find('=', at);
  const bool has_expected = equals != std::string_view::npos;
  const auto progress_text =
      text.substr(at + 1, has_expected ? equals - at - 1 : std::string_view::npos);
  const auto progress = parse_double(progress_text);
  if (!progress || *progress < 0 || *progress > 1) {
    error =
        "the progress after '@' is " + quoted(progress_text) + ", expected a number from 0 to 1";
    return std::nullopt;
  }
  MeasureSpec measure{.kind = MeasureKind::Predictability,
                      .node = std::string(text.substr(0, at)),
                      .progress = *progress,
                      .expected = {}};
  if (!has_expected) return measure;
  measure.expected = parse_double(text.substr(equals + 1));
  if (measure.expected && *measure.expected >= 0) return measure;
  error = "the instant after '=' is " + quoted(text.substr(equals + 1)) +
          ", expected a number of ticks from 0";
  return std::nullopt;
}

// A node is named by its path or by its last part.
std::string suggest_path(std::span<const std::string> paths, std::string_view node) {
  const std::vector<std::string_view> whole(paths.begin(), paths.end());
  std::vector<std::string_view> names;
  for (const std::string_view path : whole) names.push_back(path.substr(path.rfind('/') + 1));
  const std::string near = did_you_mean(node, names);
  return near.empty() ? suggest(node, whole, "there are") : near;
}

}  // namespace

std::optional<MeasureSpec> parse_measure(std::string_view text, std::string& error) {
  const auto colon = text.find(':');
  const auto name = text.substr(0, colon);
  const bool has_rest = colon != std::string_view::npos;
  for (const Name& known : kNames) {
    if (name != known.text) continue;
    if (known.kind == MeasureKind::Predictability) {
      return parse_predictability(has_rest ? text.substr(colon + 1) : "", error);
    }
    if (!has_rest)
      return MeasureSpec{.kind = known.kind, .node = {}, .progress = 0, .expected = {}};
    error = "expected nothing after " + quoted(name);
    return std::nullopt;
  }
  error = "unknown measure " + quoted(name) +
          ", expected progress-distance, step-length, duration or predictability:NODE@P[=T]";
  return std::nullopt;
}

std::string to_text(const MeasureSpec& measure) {
  std::string text(kNames[static_cast<unsigned>(measure.kind)].text);
  if (measure.kind != MeasureKind::Predictability) return text;
  text.append(":").append(measure.node).append("@").append(to_text(Value(measure.progress)));
  if (measure.expected) text.append("=").append(to_text(Value(*measure.expected)));
  return text;
}

std::string_view axis_label(MeasureKind kind) {
  return kNames[static_cast<unsigned>(kind)].axis;
}

std::optional<std::size_t> find_path(std::span<const std::string> paths, std::string_view node,
                                     std::string& error) {
  std::optional<std::size_t> found;
  const std::string tail = std::string("/").append(node);
  for (std::size_t index = 0; index < paths.size(); ++index) {
    if (paths[index] == node) return index;
    if (!paths[index].ends_with(tail)) continue;
    if (found) {
      error = quoted(node) + " is " + quoted(paths[*found]) + " as well as " + quoted(paths[index]);
      return std::nullopt;
    }
    found = index;
  }
  if (!found) error = "no node " + quoted(node) + ", " + suggest_path(paths, node);
  return found;
}

std::string last_segment(std::string_view path) {
  return std::string(path.substr(path.rfind('/') + 1));
}

}  // namespace lockstep
