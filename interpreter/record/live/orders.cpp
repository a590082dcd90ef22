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
  std::string what, entry, value, when, answer, by;
  std::uint64_t ticks = 1;
  std::optional<std::uint64_t> node = {}, seen = {};
  double factor = -1;
  bool on = true;
};

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
                 {"factor", into(fields.factor), kMayLack},
                 {"entry", into(fields.entry), kMayLack},
                 {"value", [&](JsonValue value) { fields.value = text_of(value); }, kMayLack},
                 {"node", [&](JsonValue value) { fields.node = value.whole(); }, kMayLack},
                 {"seen", [&](JsonValue value) { fields.seen = value.whole(); }, kMayLack},
                 {"answer", into(fields.answer), kMayLack},
                 {"by", into(fields.by), kMayLack},
                 {"when", into(fields.when), kMayLack},
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
  const bool is_good = fields.factor == 0 || (fields.factor >= kLeast && fields.factor <= kMost);
  if (!is_good) {
    return problem(fmt::format("'factor' is {}, expected {} to {}, or 0 for as fast as possible",
                               fields.factor, kLeast, kMost));
  }
  return Order{.what = What::Speed, .speed = fields.factor};
}

Result<Order> set(const Shape& shape, const Fields& fields) {
  const auto slot = std::ranges::find(shape.entries, fields.entry, &ShapeEntry::key);
  if (slot == shape.entries.end()) {
    return problem(fmt::format("the tree has no entry '{}'", printable(fields.entry)));
  }
  const bool is_any = slot->typing == Typing::Any;
  const ValueType type = is_any ? ValueType::String : slot->value_type;
  if (type == ValueType::Object) {
    return problem(
        fmt::format("'{}' holds objects of a plugin: they have no text", printable(fields.entry)));
  }
  auto value =
      is_any ? std::optional(value_of_any_type(fields.value)) : parse_value(type, fields.value);
  if (!value) {
    return problem(fmt::format("'{}' is not {}, which '{}' holds", printable(fields.value),
                               expected_text(type), printable(fields.entry)));
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
  if (!fields.node) return problem("'node' is missing");
  if (*fields.node < shape.nodes.size()) return static_cast<NodeIndex>(*fields.node);
  return problem(fmt::format("no node {}, expected 0 to {}", *fields.node, shape.nodes.size() - 1));
}

Result<Order> breakpoint(const Shape& shape, const Fields& fields) {
  const auto when = when_of(fields.when);
  const auto node = node_of(shape, fields);
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
  auto node = node_of(shape, fields);
  if (!fields.node && std::ranges::count_if(shape.nodes, asks) == 1) {
    node = static_cast<NodeIndex>(std::ranges::find_if(shape.nodes, asks) - shape.nodes.begin());
  }
  if (!node) return tl::unexpected(node.error());
  const ShapeNode& it = shape.nodes[*node];
  if (!it.question) return problem(fmt::format("'{}' asks nothing", printable(it.path)));
  const auto option = std::ranges::find(it.question->options, fields.answer);
  if (option == it.question->options.end()) {
    const std::vector<std::string_view> options(it.question->options.begin(),
                                                it.question->options.end());
    return problem(
        fmt::format("'{}' is no answer to '{}'", brief(fields.answer), printable(it.path)),
        suggest(fields.answer, options, "its answers"));
  }
  Order order{.what = What::Answer, .node = *node};
  order.option = static_cast<std::uint32_t>(option - it.question->options.begin());
  order.seen = fields.seen;
  order.text = fields.answer;
  order.who = printable(fields.by.substr(0, kMostOfName));
  return order;
}

}  // namespace

std::string_view word_of(When when) {
  return kWhen[static_cast<std::size_t>(when)];
}

Result<Order> read_order(const Shape& shape, bool is_real_time, std::string text) {
  Fields fields;
  try {
    fields = read_fields(text);
  } catch (const JsonError& error) {
    return problem(error.what());
  }
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

}  // namespace lockstep::host
