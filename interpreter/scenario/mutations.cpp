#include "scenario/mutations.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "base/core/pre_order.h"
#include "base/core/value.h"
#include "base/core/wording.h"
#include "language/document/document.h"

namespace lockstep::host {
namespace {

// Nodes that are the opposite of each other, with the same attributes.
constexpr std::pair<std::string_view, std::string_view> kOpposites[] = {
    {"Sequence", "Fallback"}, {"ForceSuccess", "ForceFailure"}, {"AlwaysSuccess", "AlwaysFailure"}};
// Numbers that decide how often, how many and where.
constexpr std::array<std::string_view, 6> kCounts{"times",         "attempts",      "num_cycles",
                                                  "success_count", "failure_count", "num_attempts"};

std::optional<std::string_view> opposite(std::string_view tag) {
  for (const auto& [one, other] : kOpposites) {
    if (tag == one) return other;
    if (tag == other) return one;
  }
  return std::nullopt;
}

// Where an element begins and ends in the text.
struct TextRange {
  std::size_t begin, end;
};

class Mutator {
 public:
  Mutator(const Document& document, std::string text)
      : document_(document), elements_(document.elements()), text_(std::move(text)) {}

  std::vector<Mutation> all() {
    for (const std::uint32_t child : children_in(elements_, 0)) {
      if (elements_[child].tag != "BehaviorTree") continue;
      for (std::uint32_t at = child + 1; at < elements_[child].end; ++at) mutate(at, child);
    }
    return std::move(all_);
  }

 private:
  std::size_t offset_of(std::string_view part) const {
    return static_cast<std::size_t>(part.data() - document_.source()->text().data());
  }

  std::string name_of(std::uint32_t at) const {
    const Attribute* const name = document_.find_attribute(at, "name");
    const std::string tag = brief(elements_[at].tag);
    return name == nullptr ? tag : fmt::format("{} '{}'", tag, brief(name->value));
  }

  void add(std::uint32_t at, std::string what, std::string text) {
    all_.push_back({std::move(what), to_text(document_.source()->locate(elements_[at].place)),
                    std::move(text)});
  }

  // From its '<' to behind its last '>'.
  TextRange extent_of(std::uint32_t at) const {
    const std::string_view text = text_;
    const std::size_t begin = offset_of(elements_[at].tag) - 1;
    std::size_t from = end_of_tag(at);
    if (text[from - 2] == '/') return {begin, from};
    if (elements_[at].end > at + 1) {
      for (const std::uint32_t child : children_in(elements_, at)) from = extent_of(child).end;
    }
    return {begin, text.find('>', text.find("</", from)) + 1};
  }

  // Behind the '>' of its first tag; values may have one in them.
  std::size_t end_of_tag(std::uint32_t at) const {
    char quote = '\0';
    for (std::size_t i = offset_of(elements_[at].tag); i < text_.size(); ++i) {
      const char c = text_[i];
      if (quote != '\0') {
        if (c == quote) quote = '\0';
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '>') {
        return i + 1;
      }
    }
    return text_.size();
  }

  void mutate(std::uint32_t at, std::uint32_t tree) {
    if (const auto other = opposite(elements_[at].tag)) swap(at, *other);
    for (const Attribute& it : document_.attributes(at)) {
      if (std::ranges::find(kCounts, it.name) != kCounts.end()) change_count(at, it);
      if (it.name == "barriers") change_barriers(at, it);
      if (it.name == "delta") change_delta(at, it);
    }
    const bool is_leaf = elements_[at].end == at + 1 && elements_[at].tag != "SubTree";
    if (is_leaf) invert(at);
    swap_with_next(at, tree);
  }

  // It keeps its name, so that paths stay the same.
  void swap(std::uint32_t at, std::string_view other) {
    const std::string_view tag = elements_[at].tag;
    const TextRange extent = extent_of(at);
    std::string text = text_;
    const std::size_t begin = offset_of(tag);
    if (text[end_of_tag(at) - 2] != '/') {
      text.replace(text.rfind(tag, extent.end - 1), tag.size(), other);
    }
    const bool has_name = document_.find_attribute(at, "name") != nullptr;
    text.replace(begin, tag.size(),
                 has_name ? std::string(other) : fmt::format("{} name=\"{}\"", other, tag));
    add(at, fmt::format("{} is a {}", name_of(at), other), std::move(text));
  }

  void replace_value(std::uint32_t at, const Attribute& it, const std::string& value) {
    const std::string_view text = text_;
    const std::size_t name = offset_of(it.name);
    const std::size_t begin = text.find_first_of("\"'", name) + 1;
    std::string changed = text_;
    changed.replace(begin, text.find(text[begin - 1], begin) - begin, value);
    add(at,
        fmt::format("{} has {}=\"{}\" instead of \"{}\"", name_of(at), it.name, value,
                    brief(it.value)),
        std::move(changed));
  }

  void change_count(std::uint32_t at, const Attribute& it) {
    const auto number = parse_int(it.value);
    if (number) replace_value(at, it, fmt::format("{}", *number > 1 ? *number - 1 : *number + 1));
  }

  // One is left out, and one is later.
  void change_barriers(std::uint32_t at, const Attribute& it) {
    const auto list = parse_value(ValueType::DoubleList, it.value);
    if (!list) return;
    const auto& barriers = std::get<std::vector<double>>(*list);
    for (std::size_t i = 0; i < barriers.size(); ++i) {
      std::vector<double> without = barriers, later = barriers;
      without.erase(without.begin() + static_cast<std::ptrdiff_t>(i));
      replace_value(at, it, to_text(Value(without)));
      const double next = i + 1 < barriers.size() ? barriers[i + 1] : 1;
      later[i] = (barriers[i] + next) / 2;
      if (later[i] > barriers[i] && later[i] < 1) replace_value(at, it, to_text(Value(later)));
    }
  }

  void change_delta(std::uint32_t at, const Attribute& it) {
    const auto delta = parse_double(it.value);
    if (delta) replace_value(at, it, fmt::format("{}", *delta < 0.5 ? 1 : 0));
  }

  void invert(std::uint32_t at) {
    const TextRange extent = extent_of(at);
    std::string text = text_;
    text.insert(extent.end, "</Inverter>");
    text.insert(extent.begin, "<Inverter>");
    add(at, fmt::format("{} is inverted", name_of(at)), std::move(text));
    std::string without = text_;
    const Attribute* const name = document_.find_attribute(at, "name");
    without.replace(extent.begin, extent.end - extent.begin,
                    fmt::format("<AlwaysSuccess name=\"{}\"/>",
                                name == nullptr ? elements_[at].tag : name->value));
    add(at, fmt::format("{} is left out", name_of(at)), std::move(without));
  }

  // Not in a parallel, whose children move in the same tick.
  void swap_with_next(std::uint32_t at, std::uint32_t tree) {
    const std::uint32_t next = elements_[at].end;
    if (next >= elements_[tree].end || parent_of(at, tree).starts_with("Parallel")) return;
    const TextRange one = extent_of(at), two = extent_of(next);
    // The next element is its sibling only if nothing is closed between them.
    const std::string between = text_.substr(one.end, two.begin - one.end);
    if (between.find("</") != std::string::npos) return;
    const std::string text = text_.substr(0, one.begin) +
                             text_.substr(two.begin, two.end - two.begin) + between +
                             text_.substr(one.begin, one.end - one.begin) + text_.substr(two.end);
    add(at, fmt::format("{} and {} change places", name_of(at), name_of(next)), text);
  }

  std::string_view parent_of(std::uint32_t at, std::uint32_t tree) const {
    std::uint32_t parent = tree;
    for (std::uint32_t it = tree; it < at; ++it) {
      if (elements_[it].end > at) parent = it;
    }
    return elements_[parent].tag;
  }

  const Document& document_;
  const std::span<const Element> elements_;
  const std::string text_;
  std::vector<Mutation> all_;
};

}  // namespace

std::vector<Mutation> mutations_of(const std::string& path, const std::string& text) {
  Diagnostics diagnostics;
  const auto document = Document::parse(path, text, diagnostics);
  if (document == nullptr || document->elements()[0].tag != "root") return {};
  return Mutator(*document, std::string(document->source()->text())).all();
}

}  // namespace lockstep::host
