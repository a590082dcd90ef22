#include "record/live/orders.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/core/any_value.h"
#include "base/core/diagnostics.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "base/json/reader.h"

namespace lockstep::host {
namespace {

using Order = RunControl::Order;
using What = Order::What;
using When = Breakpoint::When;

constexpr std::array<std::string_view, 5> kWhen{"begins", "completes", "barrier", "succeeds",
                                                "fails"};  // by When

struct Fields {
  std::string what, by;
  std::optional<std::string> entry = {}, value = {}, when = {}, answer = {};
  std::uint64_t ticks = 1;
  std::optional<std::uint64_t> node = {}, seen = {};
  std::optional<double> factor = {};
  bool on = true;
};

template <class T>
auto given(std::optional<T>& field) {
  return [&field](JsonValue value) { into(field.emplace())(value); };
}

// What an order cannot do without.
template <class T>
const T& needed(const std::optional<T>& field, std::string_view key) {
  if (!field) throw JsonError(fmt::format("'{}' is missing", key));
  return *field;
}

// A value is a text, as in --set, or a number or a truth value of JSON.
std::string text_of(JsonValue value) {
  if (bool flag = false; value.get(flag)) return flag ? "true" : "false";
  if (std::int64_t whole = 0; value.get(whole)) return std::to_string(whole);
  if (double real = 0; value.get(real)) return fmt::format("{}", real);
  return std::string(value.text());
}

bool flag_of(JsonValue value) {
  bool flag = true;
  if (!value.get(flag)) throw JsonError("'on' is not true or false");
  return flag;
}

// Who misspells a key means something by it.
void check_keys(std::string& text) {
  constexpr std::array<std::string_view, 11> kKeys{
      "do", "ticks", "factor", "entry", "value", "node", "when", "on", "answer", "by", "seen"};
  JsonReader().read(text, [&](JsonObject object) {
    object.each_field([&](std::string_view name, JsonValue value) {
      if (std::ranges::find(kKeys, name) == kKeys.end()) {
        throw JsonError(fmt::format("unknown key '{}'", printable(name)));
      }
      value.skip();
    });
  });
}

Fields read_fields(std::string& text) {
  check_keys(text);
  Fields fields;
  JsonReader().read(text, [&](JsonObject object) {
    object.read({{"do", into(fields.what)},
                 {"ticks", into(fields.ticks), kMayLack},
                 {"factor", given(fields.factor), kMayLack},
                 {"entry", given(fields.entry), kMayLack},
                 {"value", [&](JsonValue value) { fields.value = text_of(value); }, kMayLack},
                 {"node", given(fields.node), kMayLack},
                 {"seen", given(fields.seen), kMayLack},
                 {"answer", given(fields.answer), kMayLack},
                 {"by", into(fields.by), kMayLack},
                 {"when", given(fields.when), kMayLack},
                 {"on", [&](JsonValue value) { fields.on = flag_of(value); }, kMayLack}});
  });
  return fields;
}

Result<Order> step(const Fields& fields) {
  constexpr std::uint64_t kMost = 1'000'000'000;
  if (fields.ticks < 1 || fields.ticks > kMost) {
    return problem(fmt::format("'ticks' is {}, expected 1 to {}", fields.ticks, kMost));
  }
  return Order{.what = What::Step, .ticks = fields.ticks};
}

Result<Order> speed(const Fields& fields, bool is_real_time) {
  constexpr double kLeast = 0.1, kMost = 100;
  if (is_real_time) return problem("the wall clock has one speed; --clock virtual has others");
  const double factor = needed(fields.factor, "factor");
  const bool is_good = factor == 0 || (factor >= kLeast && factor <= kMost);
  if (!is_good) {
    return problem(fmt::format("'factor' is {}, expected {} to {}, or 0 for as fast as possible",
                               factor, kLeast, kMost));
  }
  return Order{.what = What::Speed, .speed = factor};
}

Result<Order> set(const Shape& shape, const Fields& fields) {
  const std::string& key = needed(fields.entry, "entry");
  const std::string& text = needed(fields.value, "value");
  const auto slot = std::ranges::find(shape.entries, key, &ShapeEntry::key);
  if (slot == shape.entries.end()) {
    return problem(fmt::format("the tree has no entry '{}'", printable(key)));
  }
  const bool is_any = slot->typing == Typing::Any;
  const ValueType type = is_any ? ValueType::String : slot->value_type;
  if (type == ValueType::Object) {
    return problem(
        fmt::format("'{}' holds objects of a plugin: they have no text", printable(key)));
  }
  auto value = value_from_outside(is_any, type, text);
  if (!value) {
    return problem(fmt::format("'{}' is not {}, which '{}' holds", printable(text),
                               expected_text(type), printable(key)));
  }
  return Order{.what = What::Set,
               .slot = static_cast<std::uint32_t>(slot - shape.entries.begin()),
               .type = type,
               .value = std::move(*value)};
}

std::optional<When> when_of(std::string_view word) {
  const auto found = std::ranges::find(kWhen, word);
  if (found == kWhen.end()) return std::nullopt;
  return static_cast<When>(found - kWhen.begin());
}

Result<NodeIndex> node_of(const Shape& shape, const Fields& fields) {
  const std::uint64_t node = needed(fields.node, "node");
  if (node < shape.nodes.size()) return static_cast<NodeIndex>(node);
  return problem(fmt::format("no node {}, expected 0 to {}", node, shape.nodes.size() - 1));
}

Result<Order> breakpoint(const Shape& shape, const Fields& fields) {
  const auto node = node_of(shape, fields);
  const auto when = when_of(needed(fields.when, "when"));
  if (!node) return tl::unexpected(node.error());
  if (!when)
    return problem("'when' is none of 'begins', 'completes', 'barrier', 'succeeds' and 'fails'");
  if (*when == When::Barrier && !compares_progress(shape.nodes[*node].synchronization)) {
    return problem(
        fmt::format("'{}' has no barriers and no delta", printable(shape.nodes[*node].path)));
  }
  return Order{.what = What::Break, .breakpoint = {*node, *when}, .is_on = fields.on};
}

// Without a node, the tree asks in one place only.
Result<Order> answer(const Shape& shape, const Fields& fields) {
  constexpr std::size_t kMostOfName = 200;
  const auto asks = [](const ShapeNode& it) { return it.question != nullptr; };
  const std::string& given = needed(fields.answer, "answer");
  const bool is_only = !fields.node && std::ranges::count_if(shape.nodes, asks) == 1;
  const auto node = is_only ? Result<NodeIndex>(static_cast<NodeIndex>(
                                  std::ranges::find_if(shape.nodes, asks) - shape.nodes.begin()))
                            : node_of(shape, fields);
  if (!node) return tl::unexpected(node.error());
  const ShapeNode& it = shape.nodes[*node];
  if (!it.question) return problem(fmt::format("'{}' asks nothing", printable(it.path)));
  const auto option = std::ranges::find(it.question->options, given);
  if (option == it.question->options.end()) {
    const std::vector<std::string_view> options(it.question->options.begin(),
                                                it.question->options.end());
    return problem(fmt::format("'{}' is no answer to '{}'", brief(given), printable(it.path)),
                   suggest(given, options, "its answers"));
  }
  Order order{.what = What::Answer, .node = *node};
  order.option = static_cast<std::uint32_t>(option - it.question->options.begin());
  order.seen = fields.seen;
  order.text = given;
  order.who = printable(fields.by.substr(0, kMostOfName));
  return order;
}

Result<Order> order_of(const Shape& shape, bool is_real_time, const Fields& fields) {
  if (fields.what == "pause") return Order{.what = What::Pause};
  if (fields.what == "resume") return Order{.what = What::Resume};
  if (fields.what == "halt") return Order{.what = What::Halt};
  if (fields.what == "step") return step(fields);
  if (fields.what == "speed") return speed(fields, is_real_time);
  if (fields.what == "set") return set(shape, fields);
  if (fields.what == "break") return breakpoint(shape, fields);
  if (fields.what == "attend") return Order{.what = What::Attend};
  if (fields.what == "answer") return answer(shape, fields);
  return problem(fmt::format("'{}' is not an order", printable(fields.what)),
                 "pause, resume, step, halt, speed, set, break, answer, attend");
}

}  // namespace

std::string_view word_of(When when) {
  return kWhen[static_cast<std::size_t>(when)];
}

Result<Order> read_order(const Shape& shape, bool is_real_time, std::string text) {
  try {
    return order_of(shape, is_real_time, read_fields(text));
  } catch (const JsonError& error) {
    return problem(error.what());
  }
}

Problem vain_attendance() {
  return {"the run was not started with --attended", "lockstep run TREE.xml --attended 5"};
}

}  // namespace lockstep::host
