#include "language/document/arguments.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/audience.h"
#include "base/core/identifier.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "language/document/vocabulary.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kMaxUnknown = 10;  // reported of one value: each place is counted out
constexpr std::string_view kAttributes[] = {"name", "default", "doc"};

std::optional<std::string> value_of(const Attribute* attribute) {
  if (!attribute) return std::nullopt;
  return std::string(attribute->value);
}

}  // namespace

void ArgumentTable::declare(Document& document, std::uint32_t element) {
  if (!check_vocabulary(document, element, kAttributes, 1, report_)) return;
  const bool sound = substitute(document, element);
  const Attribute& named = *document.find_attribute(element, "name");
  const std::string name(named.value);
  if (!is_identifier(name))
    return report_.at_value("bad-name"_code, named.place,
                            fmt::format("'{}' is not an identifier", brief(name)),
                            "letters, digits and '_', not a digit first");
  const auto [entry, is_new] =
      by_name_.try_emplace(name, Where{declared_.size(), named.place, sound});
  if (!is_new) {
    const auto place_of = [&](Place place) {
      return to_text(report_.sources().locate_value(place));
    };
    const std::string first = place_of(entry->second.place);
    if (first == place_of(named.place)) return;  // the file is read again, by another name
    return report_.at_value("duplicate-name"_code, named.place,
                            fmt::format("argument '{}' is declared twice", brief(name)),
                            fmt::format("the first is at {}", first));
  }

  auto default_value = value_of(document.find_attribute(element, "default"));
  const auto given = given_.find(name);
  if (given == given_.end() && !default_value) {
    entry->second.has_value = false;
    report_.at("missing-argument"_code, document.elements()[element].place,
               fmt::format("argument '{}' has no default and is not given", brief(name)),
               worded(fmt::format("give it with --arg {}=value", brief(name)),
                      std::string("the project needs a value for it")));
  }
  if (given != given_.end()) entry->second.has_value = true;
  auto value = given != given_.end() ? given->second : default_value.value_or("");
  declared_.push_back({name, std::move(default_value),
                       value_of(document.find_attribute(element, "doc")).value_or(""),
                       std::move(value)});
}

bool ArgumentTable::substitute(Document& document, std::uint32_t element) {
  if (is_full_) return false;
  bool sound = true;
  for (const auto& attribute : document.attributes(element)) {
    if (attribute.value.find("${") == std::string_view::npos) continue;
    auto value = expand(attribute);
    sound = sound && value.has_value();
    if (value) document.set_value(attribute, std::move(*value));
  }
  return sound;
}

std::optional<std::string> ArgumentTable::expand(const Attribute& attribute) {
  const auto text = attribute.value;
  std::string out;
  bool sound = true;
  std::size_t unknown = 0;
  std::size_t done = 0;
  for (auto at = text.find("${"); at != std::string_view::npos; at = text.find("${", done)) {
    const bool literal = at > done && text[at - 1] == '$';
    if (is_text(text, at)) {
      out += text.substr(done, at + 2 - done);
      done = at + 2;
      continue;
    }
    out += text.substr(done, at - done - (literal ? 1 : 0));
    done = at + 2;
    if (literal) {
      out += "${";
      continue;
    }
    const auto close = text.find('}', done);
    if (close == std::string_view::npos) {
      report_.in_value("bad-argument"_code, attribute.place, at, "'${' is not closed",
                       "write ${name}, or $${ for the characters themselves");
      return std::nullopt;
    }
    const auto name = text.substr(done, close - done);
    done = close + 1;
    const auto* where = find(name);
    if (!where && !report_.counted_only(Severity::Error))
      report_.in_value("unknown-argument"_code, attribute.place, at,
                       fmt::format("unknown argument '{}'", brief(name)), list_declared(name));
    if (!where && ++unknown == kMaxUnknown) return std::nullopt;
    sound = sound && where && where->has_value;
    if (!sound) continue;
    const auto& value = declared_[where->index].value;
    if (!fits(out.size() + value.size(), attribute)) return std::nullopt;
    out += value;
  }
  if (!sound) return std::nullopt;
  out += text.substr(done);
  expanded_ += out.size();
  return out;
}

bool ArgumentTable::is_text(std::string_view text, std::size_t at) const {
  if (!rules_->unknown_arguments_are_text) return false;
  const auto close = text.find('}', at);
  return close == std::string_view::npos || find(text.substr(at + 2, close - at - 2)) == nullptr;
}

bool ArgumentTable::fits(std::size_t bytes, const Attribute& attribute) {
  const auto fail = [&](std::string message) {
    report_.at_value("too-large"_code, attribute.place, std::move(message));
    return false;
  };
  if (bytes > kMaxValueMiB << 20u)
    return fail(fmt::format("the value of '{}' is larger than {} MiB with its arguments",
                            brief(attribute.name), kMaxValueMiB));
  is_full_ = expanded_ + bytes > kMaxExpandedMiB << 20u;
  if (is_full_)
    return fail(
        fmt::format("values with arguments are larger than {} MiB together", kMaxExpandedMiB));
  return true;
}

const ArgumentTable::Where* ArgumentTable::find(std::string_view name) const {
  const auto entry = by_name_.find(name);
  return entry == by_name_.end() ? nullptr : &entry->second;
}

std::string ArgumentTable::list_declared(std::string_view near) const {
  if (declared_.empty()) return "no <arg> is declared";
  std::vector<std::string_view> names;
  for (const auto& argument : declared_) names.push_back(argument.name);
  return suggest(near, names, "declared");
}

void ArgumentTable::check_given() const {
  for (const auto& [name, value] : given_)
    if (!find(name))
      report_.nowhere("unknown-argument"_code,
                      fmt::format("unknown argument '{}'{}", brief(name), worded(" in --arg", "")),
                      list_declared(name));
}

}  // namespace lockstep::host
