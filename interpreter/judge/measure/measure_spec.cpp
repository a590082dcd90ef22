#include "judge/measure/measure_spec.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "base/core/suggest.h"

namespace lockstep::host {
namespace {

std::string quoted(std::string_view text) {
  return std::string("'").append(text).append("'");
}

std::string usage(const Measure& measure) {
  return std::string(measure.name).append(measure.argument);
}

// ":NAME", or nothing, as the row has it.
std::string parse_name(std::string_view argument, MeasureSpec& spec) {
  const std::string_view expected = spec.measure->argument;
  if (expected.empty()) {
    return argument.empty() ? "" : "expected nothing after " + quoted(spec.measure->name);
  }
  if (argument.empty() && expected.starts_with('[')) return {};
  if (argument.size() < 2 || argument.front() != ':') {
    return "expected " + quoted(usage(*spec.measure));
  }
  spec.argument = argument;
  spec.name = argument.substr(1);
  return {};
}

std::string unknown_measure(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Measure* measure : all_measures()) names.push_back(measure->name);
  const std::string near = did_you_mean(name, names);
  return "unknown measure " + quoted(name) + ", " +
         (near.empty() ? "there are: " + measure_usages() : near);
}

// A node is named by its path or by an end of it.
std::string suggested(std::span<const std::string> paths, std::string_view name) {
  const std::vector<std::string_view> whole(paths.begin(), paths.end());
  std::vector<std::string_view> names;
  for (const std::string_view path : whole) names.push_back(path.substr(path.rfind('/') + 1));
  const std::string near = did_you_mean(name, names);
  return near.empty() ? suggest_path(name, whole, "there are") : near;
}

}  // namespace

Result<MeasureSpec> parse_measure(std::string_view text) {
  const std::string_view name = text.substr(0, text.find_first_of(":["));
  const auto measures = all_measures();
  const auto found = std::ranges::find(measures, name, &Measure::name);
  if (found == measures.end()) return problem(unknown_measure(name));
  MeasureSpec spec{.measure = *found};
  const auto parse = spec.measure->parse != nullptr ? spec.measure->parse : parse_name;
  std::string wrong = parse(text.substr(name.size()), spec);
  if (!wrong.empty()) return problem(std::move(wrong));
  return spec;
}

std::string to_text(const MeasureSpec& spec) {
  return std::string(spec.measure->name).append(spec.argument);
}

std::string axis_label(const MeasureSpec& spec) {
  const Measure& measure = *spec.measure;
  if (measure.label != nullptr) return measure.label(spec);
  std::string label(measure.axis);
  if (!measure.unit.empty()) label.append(" (").append(measure.unit).append(")");
  return label;
}

std::string_view to_string(MeasureOf of) {
  constexpr std::string_view kNames[] = {"the run",
                                         "each parallel",
                                         "a child of a synchronized node",
                                         "two children of a synchronized node",
                                         "a UseResources",
                                         "a pool of resources",
                                         "a node",
                                         "the run"};
  return kNames[static_cast<unsigned>(of)];
}

std::string measure_usages() {
  std::string text;
  for (const Measure* measure : all_measures()) {
    text.append(text.empty() ? "" : ", ").append(usage(*measure));
  }
  return text;
}

Result<std::size_t> find_path(std::span<const std::string> paths, std::string_view name,
                              std::string_view what) {
  std::optional<std::size_t> found;
  const std::string tail = std::string("/").append(name);
  for (std::size_t index = 0; index < paths.size(); ++index) {
    if (paths[index] == name) return index;
    if (!paths[index].ends_with(tail)) continue;
    if (found) {
      return problem(quoted(name) + " is " + quoted(paths[*found]) + " as well as " +
                     quoted(paths[index]));
    }
    found = index;
  }
  if (found) return *found;
  std::string error = "no " + std::string(what) + " " + quoted(name);
  const std::string hint = suggested(paths, name);
  if (!hint.empty()) error += ", " + hint;
  return problem(std::move(error));
}

}  // namespace lockstep::host
