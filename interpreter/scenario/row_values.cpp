#include "scenario/row_values.h"

#include <fmt/format.h>

#include "base/core/pre_order.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "scenario/scenario_words.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kBegin = "${";

}  // namespace

RowValues::RowValues(Document& document, std::uint32_t scenario, const Reporter& report)
    : document_(document), report_(report) {
  const auto elements = document.elements();
  for (const std::uint32_t child : children_in(elements, scenario)) {
    if (elements[child].tag != scenario_words::kRow) continue;
    rows_.push_back({child});
    if (document.attributes(child).empty()) {
      report_.at("bad-scenario"_code, elements[child].place, "a row without values",
                 "write <row name=\"value\"/>, and ${name} where it is used");
      are_good_ = false;
    }
  }
  for (std::uint32_t at = scenario; at < elements[scenario].end; ++at) {
    if (elements[at].tag == scenario_words::kRow) continue;
    for (const Attribute& it : document.attributes(at)) {
      if (it.value.find(kBegin) == std::string_view::npos) continue;
      written_.push_back({&it, std::string(it.value)});
    }
  }
}

void RowValues::choose(std::size_t row) {
  for (const Written& it : written_) document_.set_value(*it.attribute, replaced(it, row));
}

std::string RowValues::replaced(const Written& written, std::size_t row) {
  std::string text;
  std::string_view rest = written.value;
  for (auto at = rest.find(kBegin); at != std::string_view::npos; at = rest.find(kBegin)) {
    if (at > 0 && rest[at - 1] == '$') {  // "$${" is "${", as in a tree
      text += rest.substr(0, at - 1);
      text += kBegin;
      rest.remove_prefix(at + kBegin.size());
      continue;
    }
    const auto end = rest.find('}', at);
    if (end == std::string_view::npos) break;
    text += rest.substr(0, at);
    const std::string_view name = rest.substr(at + kBegin.size(), end - at - kBegin.size());
    const Attribute* value = nullptr;
    std::vector<std::string_view> known;
    if (!rows_.empty()) {
      value = document_.find_attribute(rows_[row].element, name);
      for (const Attribute& it : document_.attributes(rows_[row].element)) known.push_back(it.name);
    }
    if (value == nullptr) {
      report_.at_value("unknown-argument"_code, written.attribute->place,
                       fmt::format("no row of the scenario has '{}'", brief(name)),
                       rows_.empty() ? "write <row name=\"value\"/> in the scenario"
                                     : suggest(name, known, "values of this row"));
    } else {
      text += value->value;
    }
    rest.remove_prefix(end + 1);
  }
  return text.append(rest);
}

std::string RowValues::text(std::size_t row) const {
  if (rows_.empty()) return {};
  std::string text;
  for (const Attribute& it : document_.attributes(rows_[row].element)) {
    text += fmt::format("{}{}={}", text.empty() ? "" : ", ", it.name, it.value);
  }
  return text;
}

}  // namespace lockstep::host
