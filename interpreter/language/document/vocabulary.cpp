#include "language/document/vocabulary.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/suggest.h"
#include "base/core/wording.h"

namespace lockstep::host {

bool check_vocabulary(const Document& document, std::uint32_t element,
                      std::span<const std::string_view> known, std::size_t required,
                      const Reporter& report) {
  const Element& it = document.elements()[element];
  const std::string_view tag = it.tag;
  for (const auto& [name, value, place] : document.attributes(element)) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    report.at("unknown-attribute"_code, place,
              fmt::format("unknown attribute '{}' of '{}'", brief(name), tag),
              suggest(name, known, fmt::format("attributes of '{}'", tag)));
  }
  if (it.end > element + 1)
    report.at("unexpected-element"_code, document.elements()[element + 1].place,
              fmt::format("'{}' cannot contain elements", tag));
  bool complete = true;
  for (const auto name : known.first(required)) {
    if (document.find_attribute(element, name)) continue;
    complete = false;
    report.at("missing-attribute"_code, it.place,
              fmt::format("'{}' needs the attribute '{}'", tag, name));
  }
  return complete;
}

}  // namespace lockstep::host
