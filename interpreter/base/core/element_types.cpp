#include "base/core/element_types.h"

#include <fmt/format.h>

#include <algorithm>

namespace lockstep::host {

std::vector<FixedText> fixed_texts(const ElementTexts& texts) {
  std::vector<FixedText> fixed;
  for (const auto& [parameter, text] : texts) fixed.push_back({parameter, text});
  return fixed;
}

std::string to_text(const ElementTexts& texts) {
  std::string all;
  for (const auto& [parameter, text] : texts) {
    all += fmt::format("{}{}=\"{}\"", all.empty() ? "" : " ", parameter, text);
  }
  return all;
}

std::vector<ElementTexts> sample_elements(const NodeType& type) {
  std::vector<ElementTexts> all(1);
  for (const Parameter& parameter : type.parameters) {
    if (!parameter.constant) continue;
    const bool varies = all.size() == 1 && parameter.choices.size() > 1;
    const ElementTexts before = all.front();
    if (varies) all.assign(parameter.choices.size(), before);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::string text =
          varies ? std::string(parameter.choices[i]) : to_text(sample_value(parameter));
      all[i].emplace_back(parameter.name, text);
    }
  }
  return all;
}

bool declares_samples(const NodeType& type) {
  return std::ranges::all_of(type.parameters, [](const Parameter& it) {
    return !it.constant || it.default_text || !it.choices.empty();
  });
}

}  // namespace lockstep::host
