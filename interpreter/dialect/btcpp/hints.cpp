#include "dialect/btcpp/hints.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/core/audience.h"
#include "base/core/language.h"
#include "base/core/suggest.h"
#include "base/core/value.h"
#include "base/core/wording.h"
#include "dialect/btcpp/rules.h"
#include "dialect/btcpp/version_3.h"
#include "dialect/btcpp/words.h"

namespace lockstep::host::btcpp {
namespace {

const NodePair* pair_of(std::string_view tag) {
  for (const auto& pairs : {node_pairs(), similar_nodes()}) {
    const auto found = std::ranges::find(pairs, tag, &NodePair::theirs);
    if (found != pairs.end()) return &*found;
  }
  return nullptr;
}

const AttributePair* word_of(const NodePair& pair, std::string_view name) {
  for (const auto& attributes : {pair.attributes, pair.words}) {
    const auto found = std::ranges::find(attributes, name, &AttributePair::theirs);
    if (found != attributes.end()) return &*found;
  }
  return nullptr;
}

// As it is written in an attribute.
std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : brief(text)) {
    if (c == '&') safe += "&amp;";
    if (c == '<') safe += "&lt;";
    if (c != '&' && c != '<') safe += c;
  }
  return safe;
}

// "…" if it is unknown.
std::string translated(Conversions conversion, std::string_view text) {
  if (conversion == Conversions::None) return escaped(text);
  const bool is_key = text.size() > 2 && text.front() == '{' && text.back() == '}';
  if (conversion == Conversions::WithoutBraces) {
    return is_key ? escaped(text.substr(1, text.size() - 2)) : "…";
  }
  const auto number = parse_double(text);
  const bool is_time = conversion == Conversions::Milliseconds;
  if (!number || (!is_time && *number < 1)) return "…";
  return to_text(Value(is_time ? *number / 1000 : *number));
}

// ` attempts="5"`, or "" where it is left out.
std::string translated(const AttributePair& from, std::string_view text) {
  if (from.ours.empty() || (from.conversion == Conversions::Rounds && text == "-1")) return {};
  return fmt::format(" {}=\"{}\"", from.ours, translated(from.conversion, text));
}

// The words of the command line are not those of a program that embeds lockstep.
std::string remark_of(const NodePair& pair) {
  if (pair.theirs != "SetBlackboard") return std::string(pair.remark);
  return worded(std::string(pair.remark),
                std::string("give the entry a start value, or one as an attribute of the SubTree"));
}

std::string hint_for_node(std::string_view tag, std::span<const Attribute> attributes) {
  const std::string_view since = node_since_4(tag);
  const NodePair* pair = pair_of(since.empty() ? tag : since);
  if (pair == nullptr || !needs_hint(*pair, tag)) return {};
  if (pair->ours.empty()) return remark_of(*pair);
  std::string start = instead_of(*pair);
  for (const Attribute& it : attributes) {
    if (const auto* from = word_of(*pair, it.name)) start += translated(*from, it.value);
  }
  return join_hints(fmt::format("write <{}>", start), pair->remark);
}

// An attribute of one node, or of any.
struct Found {
  AttributePair attribute;
  std::string_view remark;
};

std::optional<Found> find_word(std::string_view tag, std::string_view name) {
  const NodePair* pair = pair_of(tag);
  if (const auto* own = pair == nullptr ? nullptr : word_of(*pair, name)) {
    return Found{*own, pair->remark};
  }
  if (const auto hook = hook_named(name, kRules)) {
    return Found{{name, attribute_of(*hook, kLockstepRules)}, {}};
  }
  if (name == kRules.on_resume) return Found{{name, kLockstepRules.on_resume}, {}};
  if (name == kRules.commit) return Found{{name, kLockstepRules.commit}, {}};
  const bool is_mark = std::ranges::find(kMarks, name) != std::end(kMarks);
  return is_mark ? std::optional(Found{{name, ""}, "a mark of an editor"}) : std::nullopt;
}

std::string hint_for_attribute(std::string_view tag, const Attribute& attribute) {
  const auto found = find_word(tag, attribute.name);
  if (!found) return {};
  const std::string ours = translated(found->attribute, attribute.value);
  return join_hints(ours.empty() ? std::string("leave it out") : "write" + ours, found->remark);
}

std::string_view our_name(std::string_view tag, std::string_view attribute) {
  const auto found = find_word(tag, attribute);
  return found ? found->attribute.ours : std::string_view();
}

std::string hint_of_nav(std::string_view tag) {
  const NodePair* pair = pair_of(tag);
  if (pair == nullptr || pair->remark != kOfNav) return {};
  return worded(
      std::string(
          "the plugin nav has it: give --plugin nav, or name it with <plugin name=\"nav\"/>"),
      std::string(kOfNav));
}

}  // namespace

constinit const ForeignHints kHints{.for_node = hint_for_node,
                                    .for_attribute = hint_for_attribute,
                                    .our_name = our_name,
                                    .of_plugin = hint_of_nav};

bool needs_hint(const NodePair& pair, std::string_view tag) {
  return tag != pair.ours || !pair.attributes.empty() || !pair.words.empty();
}

std::string instead_of(const NodePair& pair) {
  const FixedAttribute& fixed = pair.in_ours;
  const bool is_said = !fixed.name.empty() && !fixed.is_default && !fixed.is_detail;
  return is_said ? fmt::format("{} {}=\"{}\"", pair.ours, fixed.name, fixed.value)
                 : std::string(pair.ours);
}

}  // namespace lockstep::host::btcpp
