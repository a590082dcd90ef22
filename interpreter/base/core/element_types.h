// Node types whose parameters depend on the element that uses them: base/core/node_type.h.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

#include "base/core/node_type.h"
#include "base/core/parameter_value.h"
#include "base/core/problem.h"

namespace lockstep::host {

// The text that an element gives to a constant parameter, or the default.
struct FixedText {
  std::string_view parameter, text;
};

struct ElementRefusal {
  std::string parameter = {};  // whose text is to blame; "": the element as a whole
  Problem why;
};

// The same, for who keeps it.
using ElementTexts = std::vector<std::pair<std::string, std::string>>;
std::vector<FixedText> fixed_texts(const ElementTexts& texts);
// kind="round" count="2"
std::string to_text(const ElementTexts& texts);

class ElementTypes {
 public:
  virtual ~ElementTypes() = default;
  // The type of an element with these constants, which lives as long as this. Any thread may ask.
  virtual tl::expected<const NodeType*, ElementRefusal> type_of(
      std::span<const FixedText> fixed) const = 0;
  // Asks the plugin once more. What differs from type_of(fixed), after "it", the element; "":
  // nothing.
  virtual std::string asked_again(std::span<const FixedText> fixed) const = 0;
};

// The texts that decide the type of an element. `given` returns what the element gives to a
// parameter, as an optional. Nothing: one is missing, is no constant, or none that the parameter
// takes.
template <class Given>
std::optional<std::vector<FixedText>> fixed_texts(const NodeType& type, Given given) {
  std::vector<FixedText> fixed;
  for (const Parameter& parameter : type.parameters) {
    if (!parameter.constant) continue;
    const std::optional<std::string_view> text = given(parameter.name);
    if (text && text->starts_with('{') && text->ends_with('}')) return std::nullopt;
    if (text && !takes_text(parameter, *text)) return std::nullopt;
    const auto& known = text ? text : parameter.default_text;
    if (known) fixed.push_back({parameter.name, *known});
    if (!known && parameter.required) return std::nullopt;
  }
  return fixed;
}

// Elements of the type that are to be tried out, each with its constants: one for each choice of
// the first parameter that has choices.
std::vector<ElementTexts> sample_elements(const NodeType& type);
// Whether the type declares each constant of these elements, as a choice or a default. Then some of
// them exist. Otherwise they are guessed.
bool declares_samples(const NodeType& type);

// Whether a list of patterns like "goal.*;result.*" has one for the name.
constexpr bool matches_any(std::string_view patterns, std::string_view name) {
  while (!patterns.empty()) {
    const auto end = patterns.find(';');
    std::string_view pattern = patterns.substr(0, end);
    patterns.remove_prefix(end == patterns.npos ? patterns.size() : end + 1);
    if (!pattern.ends_with('*')) {
      if (pattern == name) return true;
      continue;
    }
    pattern.remove_suffix(1);
    if (name.starts_with(pattern) && name.size() > pattern.size()) return true;
  }
  return false;
}

}  // namespace lockstep::host
