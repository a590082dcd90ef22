#include "language/property/formula_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "language/property/node_names.h"
#include "language/property/property_words.h"

namespace lockstep::host {
namespace {

using Kind = PropertyToken::Kind;

constexpr unsigned bit(Status status) {
  return 1u << index_of(status);
}

constexpr std::string_view kTermHint = "such as arm.running, arm.progress < 0.5 or {key} == 'text'";

// Its place in the list, at the end if it was not there.
template <class Items, class Item>
std::size_t place_of(Items& items, const Item& item) {
  const auto found = std::ranges::find(items, item);
  const auto place = static_cast<std::size_t>(found - items.begin());
  if (found == items.end()) items.push_back(item);
  return place;
}

bool is_one_of(std::string_view type, std::initializer_list<std::string_view> types) {
  return std::ranges::find(types, type) != types.end();
}

// {fact:charged}, an entry only for those who know the leaf models.
bool is_fact(std::string_view key) {
  return key.starts_with("fact:");
}

std::string hint_about_entry(std::string_view wrong, const std::vector<std::string_view>& keys) {
  if (is_fact(wrong) && std::ranges::none_of(keys, is_fact)) {
    return "facts exist only in --property and --property-file of `lockstep verify`, with a leaf "
           "model that has them";
  }
  return keys.empty() ? "there are no entries" : suggest(wrong, keys, "entries");
}

}  // namespace

const PropertyToken& FormulaParser::token() {
  if (has_token_) return token_;
  auto next = next_property_token(text_, offset_);
  if (!next) throw PropertyError(std::move(next.error()));
  token_ = *next;
  has_token_ = true;
  return token_;
}

PropertyToken FormulaParser::take() {
  const PropertyToken taken = token();
  has_token_ = false;
  return taken;
}

bool FormulaParser::take_word(std::string_view word) {
  if (token().kind != Kind::Word || token().text != word) return false;
  take();
  return true;
}

void FormulaParser::expected(std::string_view what, std::string hint) {
  const PropertyToken& it = token();
  const std::size_t length = std::max<std::size_t>(it.text.size(), 1);
  const std::string found = it.kind == Kind::End
                                ? "the end"
                                : fmt::format("'{}'", brief(text_.substr(it.offset, length)));
  throw PropertyError{fmt::format("expected {} instead of {}", what, found), std::move(hint),
                      it.offset};
}

void FormulaParser::add(What what, std::size_t place, unsigned statuses) {
  code_.push_back({what, static_cast<std::uint8_t>(statuses), static_cast<std::uint32_t>(place)});
}

FormulaCode FormulaParser::formula() {
  code_.clear();
  alternative(0);
  return std::move(code_);
}

void FormulaParser::alternative(std::size_t depth) {
  conjunction(depth);
  while (take_word("or")) {
    conjunction(depth);
    add(What::Or, 0);
  }
}

void FormulaParser::conjunction(std::size_t depth) {
  negation(depth);
  while (take_word("and")) {
    negation(depth);
    add(What::And, 0);
  }
}

void FormulaParser::negation(std::size_t depth) {
  bool is_negated = false;
  while (take_word("not")) is_negated = !is_negated;
  primary(depth);
  if (is_negated) add(What::Not, 0);
}

void FormulaParser::primary(std::size_t depth) {
  switch (token().kind) {
    case Kind::Open:
      if (depth == Formula::kDeepest) {
        throw PropertyError{
            fmt::format("parentheses nested deeper than {} levels", depth), {}, token().offset};
      }
      take();
      alternative(depth + 1);
      if (token().kind != Kind::Close) expected("')', 'and' or 'or'");
      take();
      return;
    case Kind::Word:
    case Kind::Quoted:
      return node_term();
    case Kind::Key:
      return entry_term();
    default:
      expected("what holds in a tick", std::string(kTermHint));
  }
}

void FormulaParser::node_term() {
  const PropertyToken name = take();
  std::string_view path = name.text, field;
  std::size_t field_offset = 0;
  if (name.kind == Kind::Quoted) {
    if (token().kind != Kind::Field) expected("a field, as .running, behind the name of a node");
    field = token().text;
    field_offset = token().offset;
    take();
  } else {
    const auto point = path.rfind('.');
    if (point == std::string_view::npos) {
      if (std::ranges::find(kPropertyWords, path) != kPropertyWords.end()) {
        token_ = name;
        has_token_ = true;
        expected("what holds in a tick", std::string(kTermHint));
      }
      check_quotes(name);
      if (std::ranges::find(kPropertyFields, path) != kPropertyFields.end()) {
        throw PropertyError{fmt::format("'{}' is not about a node", brief(path)),
                            fmt::format("write it behind the node: arm.{}", path), name.offset};
      }
      throw PropertyError{
          fmt::format("'{}' is not about a tick", brief(path)),
          fmt::format("add what of the node is meant: '{}.running'; also {}", brief(path),
                      joined(std::span(kPropertyFields).subspan(1), ", ")),
          name.offset};
    }
    field = path.substr(point + 1);
    field_offset = name.offset + point + 1;
    path = path.substr(0, point);
  }
  const auto end = static_cast<std::uint32_t>(names_.paths.size());
  const auto known = names_.ends.find(path, names_.paths, 0, end);
  const auto node = known ? Result<std::uint32_t>(*known) : find_node(path, names_.paths);
  if (!node && name.kind == Kind::Word) check_quotes(name);
  if (!node) throw PropertyError{node.error().message, node.error().hint, name.offset};
  field_of(static_cast<std::uint32_t>(place_of(formula_.nodes, *node)), field, field_offset);
}

// Also where a part of the path that stands without quotes is a word.
void FormulaParser::check_quotes(const PropertyToken& name) const {
  const std::string_view meant = quoted_name(text_.substr(name.offset), names_.paths);
  if (meant.empty()) return;
  throw PropertyError{fmt::format("the path '{}' needs quotes", brief(meant)),
                      fmt::format("write '{}'.running", brief(meant)), name.offset};
}

void FormulaParser::field_of(std::uint32_t place, std::string_view field, std::size_t offset) {
  for (const StatusRow& row : kStatuses) {
    if (row.name == field) return add(What::Status, place, bit(row.status));
  }
  if (field == "done") {
    return add(What::Status, place, bit(Status::Success) | bit(Status::Failure));
  }
  if (field == "ticked") return add(What::Ticked, place);
  if (field == "held") return add(What::Held, place);
  if (field == "progress") return progress_of(place);
  throw PropertyError{fmt::format("a node has no '{}'", brief(field)),
                      suggest(field, kPropertyFields, "what a node has"), offset};
}

void FormulaParser::progress_of(std::uint32_t place) {
  if (token().kind != Kind::Relation) {
    expected("a relation: < <= == != >= >", "progress is compared with a number from 0 to 1");
  }
  const Relation relation = take().relation;
  if (token().kind != Kind::Number) expected("a number from 0 to 1");
  const PropertyToken number = take();
  if (!(number.number >= 0 && number.number <= 1)) {
    throw PropertyError{fmt::format("progress is never {}", brief(number.text)),
                        "it is from 0 to 1", number.offset};
  }
  formula_.progress.push_back({place, relation, number.number});
  add(What::Progress, formula_.progress.size() - 1);
}

void FormulaParser::entry_term() {
  const PropertyToken key = take();
  const auto& entries = names_.entries;
  const auto found = std::ranges::find(entries, key.text, &PropertyNames::Entry::key);
  if (found == entries.end()) {
    std::vector<std::string_view> keys;
    for (const auto& entry : entries) keys.push_back(entry.key);
    throw PropertyError{fmt::format("no entry '{}'", brief(key.text)),
                        hint_about_entry(key.text, keys), key.offset};
  }
  // Two SubTrees of one name, in different nodes.
  const auto count =
      std::count_if(found, entries.end(), [&](const auto& it) { return it.key == key.text; });
  if (count > 1) {
    throw PropertyError{fmt::format("'{}' is the key of {} entries", brief(key.text), count),
                        "give the SubTrees different names", key.offset};
  }
  EntryComparison comparison;
  comparison.entry = static_cast<std::uint32_t>(found - entries.begin());
  if (token().kind != Kind::Relation) expected("a relation: == != < <= >= >");
  comparison.relation = take().relation;
  entry_constant(comparison, key);
  add(What::Entry, place_of(formula_.comparisons, comparison));
}

void FormulaParser::entry_constant(EntryComparison& comparison, const PropertyToken& key) {
  const auto& entry = names_.entries[comparison.entry];
  const PropertyToken& constant = token();
  const bool is_flag =
      constant.kind == Kind::Word && (constant.text == "true" || constant.text == "false");
  if (constant.kind != Kind::Number && constant.kind != Kind::Quoted && !is_flag) {
    expected("a number, true, false or a text in quotes");
  }
  const bool is_number = constant.kind == Kind::Number;
  const auto refuse = [&](std::string_view what) {
    throw PropertyError{fmt::format("'{}' is of the type {}", brief(key.text), entry.type),
                        std::string(what), constant.offset};
  };
  if (entry.is_strict) {
    if (entry.type == "bool" && !is_flag) refuse("compare it with true or false");
    if (is_one_of(entry.type, {"int", "double", "int or double"}) && !is_number) {
      refuse("compare it with a number");
    }
    if (entry.type == "string" && is_number) refuse("write the text in quotes: '3'");
  }
  const bool is_equality =
      comparison.relation == Relation::Equal || comparison.relation == Relation::NotEqual;
  if (!is_number && !is_equality) {
    throw PropertyError{"only numbers are less or greater",
                        "compare texts with == or !=", constant.offset};
  }
  if (is_number) {
    comparison.number = constant.number;
  } else {
    comparison.text = constant.text;
  }
  take();
}

}  // namespace lockstep::host
