#include "groot/hooks.h"

#include <fmt/format.h>

#include <vector>

#include "base/core/diagnostics.h"
#include "base/json/json.h"
#include "base/json/reader.h"

namespace lockstep::host {
namespace {

constexpr const char* kGoesOn = "SKIPPED";

auto into_flag(bool& flag) {
  return [&flag](JsonValue value) {
    if (!value.get(flag)) throw JsonError("expected true or false");
  };
}

auto into_number(std::int64_t& number) {
  return [&number](JsonValue value) { number = static_cast<std::int64_t>(value.whole()); };
}

// Visits the object, or each object of the list. The problem with the text, or "".
template <class Visit>
std::string read_objects(const std::string& text, Visit visit) {
  std::string whole = fmt::format("{{\"hooks\":{}}}", text);
  try {
    JsonReader().read(whole, [&](JsonObject outer) {
      outer.read({{"hooks", [&](JsonValue value) {
                     if (!value.is_list()) return visit(value.object());
                     value.each_item([&](JsonValue item) { visit(item.object()); });
                   }}});
    });
  } catch (const JsonError& error) {
    return error.what();
  }
  return {};
}

Breakpoint breakpoint_of(std::uint64_t uid, std::int64_t position) {
  return {.node = static_cast<NodeIndex>(uid - 1),
          .when = position == 0 ? Breakpoint::When::Begins : Breakpoint::When::Completes};
}

}  // namespace

std::string GrootHooks::check(const Hook& hook) const {
  if (hook.key.uid < 1 || hook.key.uid > nodes_) {
    return fmt::format("no node has the uid {}", hook.key.uid);
  }
  if (hook.key.position != 0 && hook.key.position != 1) return "'position' is neither 0 nor 1";
  if (hook.mode != 0) return "lockstep puts no other status in place of a node's: use a breakpoint";
  return {};
}

std::string GrootHooks::insert(const std::string& one_or_list) {
  std::vector<Hook> hooks;
  std::string problem = read_objects(one_or_list, [&](JsonObject object) {
    Hook hook;
    object.read({{"uid", into(hook.key.uid)},
                 {"position", into_number(hook.key.position)},
                 {"enabled", into_flag(hook.is_enabled)},
                 {"once", into_flag(hook.is_once)},
                 {"mode", into_number(hook.mode)},
                 {"desired_status", into(hook.status)}});
    hooks.push_back(std::move(hook));
  });
  for (const Hook& hook : hooks) {
    if (problem.empty()) problem = check(hook);
  }
  if (problem.empty() && hooks_.size() + hooks.size() > kMost) {
    problem = fmt::format("no more than {} breakpoints", kMost);
  }
  if (!problem.empty()) return problem;
  for (const Hook& hook : hooks) put(hook);
  return {};
}

// In place of one at the same place.
void GrootHooks::put(const Hook& hook) {
  const auto old = hooks_.find(hook.key);
  if (old != hooks_.end() && !hook.is_enabled) go_on_from(old->second);
  set(hook, hook.is_enabled && !is_absent_);
  hooks_.insert_or_assign(hook.key, hook);
}

Result<GrootHooks::Hooks::iterator> GrootHooks::find(const Key& key) {
  const auto found = hooks_.find(key);
  if (found != hooks_.end()) return found;
  return problem(fmt::format("node {} has no such breakpoint", key.uid));
}

std::string GrootHooks::remove(const std::string& which) {
  Key key;
  const std::string problem = read_objects(which, [&](JsonObject object) {
    object.read({{"uid", into(key.uid)}, {"position", into_number(key.position)}});
  });
  if (!problem.empty()) return problem;
  const auto hook = find(key);
  if (!hook) return hook.error().message;
  erase(*hook);
  return {};
}

std::string GrootHooks::unlock(const std::string& which) {
  Key key;
  std::string status;
  bool is_over = false;
  const std::string problem = read_objects(which, [&](JsonObject object) {
    object.read({{"uid", into(key.uid)},
                 {"position", into_number(key.position)},
                 {"desired_status", into(status)},
                 {"remove_when_done", into_flag(is_over)}});
  });
  if (!problem.empty()) return problem;
  const auto hook = find(key);
  if (!hook) return hook.error().message;
  if (status != kGoesOn) {
    return fmt::format("lockstep puts no other status in place of a node's: '{}', not '{}'",
                       kGoesOn, printable(status));
  }
  (*hook)->second.is_once |= is_over;
  const bool is_last = (*hook)->second.is_once && is_paused_by((*hook)->second);
  go_on_from((*hook)->second);
  if (is_last) erase(*hook);
  return {};
}

GrootHooks::Hooks::iterator GrootHooks::erase(Hooks::iterator hook) {
  set(hook->second, false);
  go_on_from(hook->second);
  return hooks_.erase(hook);
}

void GrootHooks::remove_all() {
  for (auto hook = hooks_.begin(); hook != hooks_.end();) hook = erase(hook);
}

void GrootHooks::disable_all() {
  for (auto& [key, hook] : hooks_) {
    hook.is_enabled = false;
    set(hook, false);
    go_on_from(hook);
  }
}

std::string GrootHooks::dump() const {
  Json list = Json::array();
  for (const auto& [key, hook] : hooks_) {
    list.push_back({{"desired_status", hook.status},
                    {"enabled", hook.is_enabled},
                    {"mode", hook.mode},
                    {"once", hook.is_once},
                    {"position", key.position},
                    {"uid", key.uid}});
  }
  return list.text();
}

void GrootHooks::set_absent(bool is_absent) {
  if (is_absent == is_absent_) return;
  is_absent_ = is_absent;
  for (const auto& [key, hook] : hooks_) set(hook, hook.is_enabled && !is_absent);
}

std::optional<NodeIndex> GrootHooks::paused_at() const {
  if (control_ == nullptr) return std::nullopt;
  for (const auto& [key, hook] : hooks_) {
    if (is_paused_by(hook)) return static_cast<NodeIndex>(key.uid - 1);
  }
  return std::nullopt;
}

std::optional<NodeIndex> GrootHooks::reached() {
  if (control_ == nullptr) return std::nullopt;
  const std::uint64_t pauses = control_->pauses();
  if (pauses == pauses_) return std::nullopt;
  pauses_ = pauses;
  return paused_at();
}

void GrootHooks::set(const Hook& hook, bool is_on) {
  control_->give({.what = RunControl::Order::What::Break,
                  .breakpoint = breakpoint_of(hook.key.uid, hook.key.position),
                  .is_on = is_on});
}

bool GrootHooks::is_paused_by(const Hook& hook) const {
  const auto state = control_->state();
  return state.is_paused && state.breakpoint == breakpoint_of(hook.key.uid, hook.key.position);
}

void GrootHooks::go_on_from(const Hook& hook) {
  if (is_paused_by(hook)) control_->give({.what = RunControl::Order::What::Resume});
}

}  // namespace lockstep::host
