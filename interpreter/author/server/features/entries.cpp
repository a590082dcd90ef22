#include "author/server/features/entries.h"

#include <algorithm>

#include "base/core/parameter_value.h"

namespace lockstep::host {
namespace {

bool says_type(const Parameter& parameter) {
  return !parameter.is_generic && !parameter.is_key && !parameter.names_entry;
}

bool fits(const Parameter& has, const Parameter& wanted) {
  if (has.type == ValueType::Object || wanted.type == ValueType::Object)
    return has.type == wanted.type && has.object == wanted.object;
  const auto is_number = [](ValueType type) {
    return type == ValueType::Number || type == ValueType::Int || type == ValueType::Double;
  };
  if (is_number(wanted.type)) return is_number(has.type);
  return has.type == wanted.type;
}

}  // namespace

const Parameter* EntryFacts::typed() const {
  // A writer knows best.
  for (const bool writes : {true, false}) {
    for (const NamePlace* it : places) {
      if (it->parameter != nullptr && says_type(*it->parameter) && it->is_declaration == writes)
        return it->parameter;
    }
  }
  return nullptr;
}

std::string EntryFacts::type_text() const {
  const Parameter* const it = typed();
  return it == nullptr ? "entry" : std::string(type_name(it->type, it->object));
}

bool EntryFacts::may_be(const Parameter* wanted) const {
  const Parameter* const has = typed();
  return wanted == nullptr || has == nullptr || !says_type(*wanted) || fits(*has, *wanted);
}

std::vector<EntryFacts> entries_of(const Names& names, const TolerantElement* tree) {
  std::vector<EntryFacts> all;
  for (const NamePlace& it : names.places()) {
    if (it.kind != NameKind::Entry || it.scope != tree) continue;
    const auto known = std::ranges::find(all, it.name, &EntryFacts::name);
    EntryFacts& facts = known == all.end() ? all.emplace_back(EntryFacts{it.name, {}}) : *known;
    facts.places.push_back(&it);
  }
  return all;
}

}  // namespace lockstep::host
