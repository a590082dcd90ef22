#include "leaves/remote/json_lines/hello.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "base/core/wording.h"
#include "base/json/reader.h"
#include "leaves/remote/json_lines/port_fact.h"

namespace lockstep::host {
namespace {

constexpr const char* kHint =
    "`lockstep docs programs` has what the first line of a program must be";

}  // namespace

struct Hello::Reader {
  Hello& hello;
  Hold hold;

  OwnedDescriptors& tables() const { return hello.tables_; }
  auto into_text(const char*& text) {
    return [this, &text](JsonValue value) { text = keep_or_null(tables(), value.text()); };
  }

  void read_leaf(JsonValue value) {
    lockstep_leaf_type& leaf = tables().add_leaf();
    leaf.start_unreset = nullptr;
    std::string kind = "action";
    std::vector<std::string> more_ports;
    bool progress = false, set_pace = false, restore = false, pause = false, answers_pause = false,
         real_time = false;
    bool has_ticks = false;  // more than one
    value.object().read(
        {{"id", into_text(leaf.id)},
         {"kind", into(kind), kMayLack},
         {"doc", into_text(leaf.doc), kMayLack},
         {"progress", into_flag(progress), kMayLack},
         {"set_pace", into_flag(set_pace), kMayLack},
         {"restore", into_flag(restore), kMayLack},
         {"pause", into_flag(pause), kMayLack},
         {"answers_pause", into_flag(answers_pause), kMayLack},
         {"real_time", into_flag(real_time), kMayLack},
         {"ports",
          [&](JsonValue ports) { ports.each_item([&](auto it) { read_port_fact(it, tables()); }); },
          kMayLack},
         {"more_ports", into(more_ports), kMayLack},
         {"behavior",
          [&](JsonValue behavior) {
            behavior.object().each_field([&](std::string_view word, JsonValue said) {
              const std::string_view text = said.text();
              has_ticks |= word == "ticks" && text != "1" && text != "1..1";
              tables().add_behavior(word, text);
            });
          },
          kMayLack}});
    if (!more_ports.empty()) tables().set_more_ports(joined(more_ports, ";"));
    leaf.kind = number_of("kind of a leaf", kind,
                          {{"action", LOCKSTEP_ACTION}, {"condition", LOCKSTEP_CONDITION}});
    leaf.flags = real_time ? LOCKSTEP_REAL_TIME : 0;
    if (leaf.kind == LOCKSTEP_CONDITION) {
      leaf.flags |= LOCKSTEP_MAY_RUN;  // on the wall clock, its answer may be late
      if (has_ticks) {
        throw JsonError(
            fmt::format("the behavior of '{}' has more than one tick, but a condition "
                        "never runs: leave 'ticks' out",
                        leaf.id));
      }
    }
    if (!progress) leaf.progress = nullptr;
    if (!set_pace) leaf.set_pace = nullptr;
    if (!restore) {
      leaf.save = nullptr;
      leaf.restore = nullptr;
    }
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
    return problem(fmt::format("does not list its leaves: {}", error.what()), kHint);
  }
  hello->tables_.plugin.name = hello->tables_.keep(plugin);
  hello->line_ = std::move(line);
  return hello;
}

const lockstep_leaf_type* Hello::type_named(std::string_view id) const {
  const std::span types(plugin().leaf_types, plugin().leaf_type_count);
  const auto it = std::ranges::find_if(types, [&](auto* type) { return type->id == id; });
  return it == types.end() ? nullptr : *it;
}

Hold Hello::hold_of(std::string_view id) const {
  for (std::size_t i = 0; i < holds_.size(); ++i) {
    if (plugin().leaf_types[i]->id == id) return holds_[i];
  }
  return Hold::None;
}

}  // namespace lockstep::host
