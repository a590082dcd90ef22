#include "document/vocabulary.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/suggest.h"
#include "core/wording.h"
#include "document/reporter.h"

namespace lockstep {
bool check_vocabulary(const Document& document, std::uint32_t element,
                      std::span<const std::string_view> known, std::size_t required,
                      Diagnostics& diagnostics) {
  const Reporter report(document, diagnostics);
  const auto [tag, end, first, count] = document.elements()[element];
  for (const auto& [name, value] : document.attributes(element)) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    report.at_attribute(element, name,
                        fmt::format("unknown attribute '{}' of '{}'", brief(name), tag),
                        suggest(name, known, fmt::format("attributes of '{}'", tag)));
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
