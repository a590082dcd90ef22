#include "document/vocabulary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/suggest.h"
#include "document/reporter.h"

namespace lockstep {
namespace {

std::string attributes_hint(std::string_view tag, std::string_view word,
                            std::span<const std::string_view> known) {
  if (auto near = did_you_mean(word, known); !near.empty()) return near;
  return fmt::format("'{}' has '{}'", tag, fmt::join(known, "', '"));
}

}  // namespace

bool check_vocabulary(const Document& document, std::uint32_t element,
                      std::span<const std::string_view> known, std::size_t required,
                      Diagnostics& diagnostics) {
  const Reporter report(document, diagnostics);
  const auto [tag, end, first, count] = document.elements()[element];
  for (const auto& [name, value] : document.attributes(element)) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      report.at_attribute(element, name, fmt::format("unknown attribute '{}' of '{}'", name, tag),
                          attributes_hint(tag, name, known));
  }
  if (end > element + 1)
    report.at_element(element + 1, fmt::format("'{}' takes no elements inside", tag));
  bool complete = true;
  for (const auto name : known.first(required)) {
    if (document.find_attribute(element, name)) continue;
    complete = false;
    report.at_element(element, fmt::format("'{}' needs the attribute '{}'", tag, name));
  }
  return complete;
}

}  // namespace lockstep
