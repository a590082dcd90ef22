#include "remote/json_lines/hello.h"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <map>

#include "core/value.h"
#include "core/wording.h"
#include "json/reader.h"

namespace lockstep::host {
namespace {

constexpr const char* kHint = "docs/programs.md has what the first line of a program must be";

template <class Number>
Number one_of(std::string_view what, std::string_view word,
              std::initializer_list<std::pair<std::string_view, Number>> words) {
  std::vector<std::string_view> expected;
  for (const auto& [known, number] : words) {
    if (known == word) return number;
    expected.push_back(known);
  }
  throw JsonError(fmt::format("the {} is '{}', expected {}", what, brief(word), listed(expected)));
}

lockstep_type type_of(std::string_view name) {
  if (name == "number") return LOCKSTEP_NUMBER;
  for (const ValueType type : all_value_types()) {
    if (type == ValueType::Number || type == ValueType::Object || to_string(type) != name) continue;
    return static_cast<lockstep_type>(type);  // the types of the contract have the numbers of ours
  }
  throw JsonError(
      fmt::format("the type of a port is '{}', expected bool, int, double, string, "
                  "number, or 'list of ' and one of the first four",
                  brief(name)));
}

// A scalar as it is written in a tree.
std::string scalar_text(JsonValue value) {
  std::string_view text;
  bool flag = false;
  std::int64_t whole = 0;
  double number = 0;
  if (value.get(text)) return std::string(text);
  if (value.get(flag)) return flag ? "true" : "false";
  if (value.get(whole)) return std::to_string(whole);
  if (value.get(number)) return fmt::format("{}", number);
  throw JsonError("a default is not a string, a number, true or false");
}

auto into_flag(bool& flag) {
  return [&flag](JsonValue value) {
    if (!value.get(flag)) throw JsonError("a flag is not true or false");
  };
}

}  // namespace

struct Hello::Reader {
  Hello& hello;
  Hold hold;

  OwnedDescriptors& tables() const { return hello.tables_; }
  const char* keep_or_null(std::string_view text) const {
    return text.empty() ? nullptr : tables().keep(text);
  }
  auto into_text(const char*& text) {
    return [this, &text](JsonValue value) { text = keep_or_null(value.text()); };
  }

  void read_port(JsonValue value) {
    lockstep_port& port = tables().add_port();
    std::string type, direction = "input";
    std::vector<std::string> choices;
    double least = -HUGE_VAL, most = HUGE_VAL;
    bool optional = false;
    value.object().read(
        {{"name", into_text(port.name)},
         {"type", into(type)},
         {"direction", into(direction), kMayLack},
         {"default", [&](JsonValue it) { port.default_value = tables().keep(scalar_text(it)); },
          kMayLack},
         {"unit", into_text(port.unit), kMayLack},
         {"doc", into_text(port.doc), kMayLack},
         {"choices", into(choices), kMayLack},
         {"min", into(least), kMayLack},
         {"max", into(most), kMayLack},
         {"optional", into_flag(optional), kMayLack}});
    port.type = type_of(type);
    port.direction = one_of<lockstep_direction>(
        "direction of a port", direction,
        {{"input", LOCKSTEP_INPUT}, {"output", LOCKSTEP_OUTPUT}, {"inout", LOCKSTEP_INOUT}});
    port.choices = keep_or_null(joined(choices, ";"));
    const bool is_limited = least != -HUGE_VAL || most != HUGE_VAL;
    port.min = is_limited ? least : 0;
    port.max = is_limited ? most : 0;
    port.flags = optional ? LOCKSTEP_OPTIONAL : 0;
  }

  void read_leaf(JsonValue value) {
    lockstep_leaf_type& leaf = tables().add_leaf();
    leaf.start_unreset = nullptr;
    std::string kind = "action";
    bool progress = false, pause = false, answers_pause = false, real_time = false;
    value.object().read(
        {{"id", into_text(leaf.id)},
         {"kind", into(kind), kMayLack},
         {"doc", into_text(leaf.doc), kMayLack},
         {"progress", into_flag(progress), kMayLack},
         {"pause", into_flag(pause), kMayLack},
         {"answers_pause", into_flag(answers_pause), kMayLack},
         {"real_time", into_flag(real_time), kMayLack},
         {"ports", [&](JsonValue ports) { ports.each_item([&](auto it) { read_port(it); }); },
          kMayLack},
         {"behavior",
          [&](JsonValue behavior) {
            behavior.object().each_field([&](std::string_view word, JsonValue said) {
              tables().add_behavior(word, said.text());
            });
          },
          kMayLack}});
    leaf.kind = one_of<lockstep_leaf_kind>(
        "kind of a leaf", kind, {{"action", LOCKSTEP_ACTION}, {"condition", LOCKSTEP_CONDITION}});
    leaf.flags = real_time ? LOCKSTEP_REAL_TIME : 0;
    // On the wall clock, its answer comes later.
    if (leaf.kind == LOCKSTEP_CONDITION) leaf.flags |= LOCKSTEP_MAY_RUN;
    if (!progress) leaf.progress = nullptr;
    Hold its = hold;
    if (hold == Hold::AsItSays) its = pause || answers_pause ? Hold::Message : Hold::None;
    if (its == Hold::Message && answers_pause) its = Hold::Answered;
    if (its == Hold::None) leaf.pause = leaf.resume = nullptr;
    hello.holds_.push_back(its);
  }

  void read(JsonObject object) {
    std::uint64_t protocol = 0;
    object.read(
        {{"lockstep", into(protocol)},
         {"version", into_text(hello.tables_.plugin.version), kMayLack},
         {"doc", into_text(hello.tables_.plugin.doc), kMayLack},
         {"leaves", [&](JsonValue leaves) { leaves.each_item([&](auto it) { read_leaf(it); }); }}});
    if (protocol == kProgramProtocol) return;
    throw JsonError(fmt::format("it speaks version {} of the protocol, this program {}", protocol,
                                kProgramProtocol));
  }
};

Result<std::unique_ptr<Hello>> Hello::read(std::string line, const std::string& plugin, Hold hold) {
  std::unique_ptr<Hello> hello(new Hello);
  Reader reader{*hello, hold};
  try {
    JsonReader().read(line, [&](JsonObject object) { reader.read(object); });
  } catch (const JsonError& error) {
    return problem(fmt::format("does not say what leaves it has: {}", error.what()), kHint);
  }
  hello->tables_.plugin.name = hello->tables_.keep(plugin);
  hello->line_ = std::move(line);
  return hello;
}

Hold Hello::hold_of(std::string_view id) const {
  for (std::size_t i = 0; i < holds_.size(); ++i) {
    if (plugin().leaf_types[i]->id == id) return holds_[i];
  }
  return Hold::None;
}

}  // namespace lockstep::host
