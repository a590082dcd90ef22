#include "definition/btcpp/scripts.h"

#include <fmt/format.h>

#include "definition/btcpp/words.h"

namespace lockstep::btcpp {

std::optional<std::shared_ptr<const Expression>> parse_script(const Attribute& attribute,
                                                              const Reporter& report,
                                                              EmptyScript empty) {
  if (empty == EmptyScript::DoesNothing && attribute.value.empty()) return nullptr;
  auto code = Expression::parse(attribute.value);
  if (code) {
    for (const auto& remark : code->remarks()) {
      report.in_value(attribute.place, remark.offset, remark.message, remark.hint,
                      Severity::Warning);
    }
    return std::make_shared<const Expression>(*std::move(code));
  }
  auto& error = code.error();
  report.in_value(attribute.place, error.offset, std::move(error.message), std::move(error.hint));
  return std::nullopt;
}

void check_hooks(const NodeElement& element, const Reporter& report, CheckedNode& node,
                 CheckedTrees& trees) {
  const auto first = static_cast<std::uint32_t>(trees.scripts.size());
  for (const Attribute& attribute : element.attributes) {
    const auto hook = hook_of(attribute.name);
    if (!hook) continue;
    auto code = parse_script(attribute, report, EmptyScript::IsRefused);
    if (!code) continue;
    trees.scripts.push_back({.hook = *hook, .place = attribute.place, .code = *std::move(code)});
  }
  if (trees.scripts.size() == first) return;
  trees.scripts.back().is_last = true;
  node.scripts = first;
}

}  // namespace lockstep::btcpp
