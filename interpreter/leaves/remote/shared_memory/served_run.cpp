#include "leaves/remote/shared_memory/served_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "base/core/plugin_exception.h"
#include "leaves/remote/shared_memory/answer.h"
#include "leaves/remote/shared_memory/channel.h"
#include "leaves/remote/shared_memory/descriptor_message.h"
#include "leaves/remote/shared_memory/remote_entries.h"

namespace lockstep::host {
namespace {

constexpr std::uint32_t kMostEntries = std::uint32_t{1} << 24;

void call_if_there(void (*function)(void*), void* self) {
  if (function != nullptr) function(self);
}

bool is_destroy(PluginFunction function) {
  return function == PluginFunction::Destroy || function == PluginFunction::DestroyRun;
}

}  // namespace

std::unique_ptr<ServedRun::Object> ServedRun::make_object(std::uint32_t number, const char* who,
                                                          RandomStream random) {
  auto object = std::make_unique<Object>();
  object->number = number;
  object->log = [this, number](std::string_view, lockstep_log_level level, std::string_view text) {
    log_.write(number, level, text);
  };
  object->run.written = &written_;
  lockstep_caller& caller = object->caller.emplace(time_, object->slot, object->run);
  caller.who = who;
  caller.random = random;
  return object;
}

// Whatever was left of a run before it, which the host has given up, is forgotten.
ServedRun::Object* ServedRun::create_run(MessageReader& request) {
  objects_.clear();
  sites_.emplace();
  entries_.clear();
  numbers_.clear();
  const auto random = request.get<std::uint64_t>();
  auto run = make_object(0, descriptors_.plugin.name, std::bit_cast<RandomStream>(random));
  run->site = &CallSite::of_plugin(descriptors_.plugin.name);
  return (objects_[0] = std::move(run)).get();
}

ServedRun::Mirror* ServedRun::entry(std::uint32_t number) {
  if (number >= kMostEntries) return nullptr;
  while (number >= entries_.size()) {
    numbers_.emplace(&entries_.emplace_back(), static_cast<std::uint32_t>(numbers_.size()));
  }
  return &entries_[number];
}

bool ServedRun::bind(BoundPort& port, std::uint32_t number, bool is_writable) {
  Mirror* const bound = entry(number);
  if (bound == nullptr) return false;
  if (port.object() != nullptr) bound->objects = &PackedType::of(port.object()->name());
  port.read = &bound->value();
  if (is_writable) port.write = bound;
  if (port.is_generic) {
    bound->typing = Typing::Any;
    bound->objects = &PackedType::of("object");
  }
  return true;
}

bool ServedRun::read_ports(MessageReader& request, Object& leaf,
                           std::span<const Parameter> declared) {
  const auto count = request.get<std::uint32_t>();
  if (count != declared.size()) return false;
  for (std::uint32_t index = 0; index < count && request.good(); ++index) {
    BoundPort port{.parameter = &declared[index],
                   .type = request.get<ValueType>(),
                   .is_generic = declared[index].is_generic,
                   .has_limits = has_limits(declared[index])};
    const auto writes = static_cast<RemoteEntries::Sets>(request.get<std::uint8_t>());
    const bool is_writable = writes != RemoteEntries::Sets::No;
    port.is_loose_there = writes == RemoteEntries::Sets::Loosely;
    const auto number = request.get<std::uint32_t>();
    const auto fallback = request.get<std::uint32_t>();
    port.entry = leaf.entry_names.emplace_back(request.text());
    if (fallback != RemoteEntries::kNone) {
      const Entry* const held = entry(fallback);
      if (held == nullptr) return false;
      port.fallback = &held->value();
    }
    if (number != RemoteEntries::kNone && !bind(port, number, is_writable)) return false;
    leaf.ports.add(std::move(port));
  }
  leaf.ports.give_to(*leaf.caller);
  return request.good();
}

namespace {

// Null: the plugin has no type for such an element.
const NodeType* type_of(const Descriptors::Leaf& leaf, std::span<const FixedText> fixed) {
  if (leaf.element_types == nullptr) return &leaf.node_type;
  return leaf.element_types->type_of(fixed).value_or(nullptr);
}

}  // namespace

ServedRun::Object* ServedRun::create_leaf(std::uint32_t number, MessageReader& request) {
  const auto random = request.get<std::uint64_t>();
  const auto type = request.get<std::uint32_t>();
  const std::string_view who = request.text();
  std::string name(request.text());
  const std::vector<FixedText> fixed = read_fixed(request);
  if (type >= descriptors_.leaves.size() || number == 0 || !sites_) return nullptr;
  const NodeType* const node_type = type_of(*descriptors_.leaves[type], fixed);
  if (node_type == nullptr) return nullptr;
  const lockstep_leaf_type& declared = *node_type->leaf;
  const CallSite& site = sites_->add(
      who, CallSite::origin_of({.id = declared.id, .plugin = descriptors_.plugin.name}));
  auto leaf = make_object(number, site.path, std::bit_cast<RandomStream>(random));
  leaf->caller->texts.set({.name = std::move(name)});
  leaf->type = &declared;
  leaf->caller->type = node_type;
  leaf->site = leaf->slot.site = &site;
  if (!read_ports(request, *leaf, node_type->parameters)) return nullptr;
  return (objects_[number] = std::move(leaf)).get();
}

ServedRun::Object* ServedRun::find(std::uint32_t number) {
  const auto found = objects_.find(number);
  return found == objects_.end() ? nullptr : found->second.get();
}

bool ServedRun::read_entries(MessageReader& request) {
  for (auto number = request.get<std::uint32_t>(); number != RemoteEntries::kNone;
       number = request.get<std::uint32_t>()) {
    Mirror* const known = entry(number);
    if (known == nullptr || !request.value_into(known->to_write(), known->objects)) return false;
  }
  return request.good();
}

std::uint64_t ServedRun::call_run(Object& object, PluginFunction function) {
  const lockstep_plugin& plugin = descriptors_.plugin;
  if (plugin.create_run == nullptr) return 1;
  if (function == PluginFunction::CreateRun) {
    object.slot.self = plugin.create_run(&host_table(), &*object.caller);
    return object.slot.self != nullptr || object.slot.error == nullptr ? 1 : 0;
  }
  plugin.destroy_run(object.slot.self);
  return 0;
}

std::uint64_t ServedRun::call_leaf(Object& object, PluginFunction function) {
  const lockstep_leaf_type& type = *object.type;
  void* const self = object.slot.self;
  switch (function) {
    case PluginFunction::Start:
      call_if_there(type.start, self);
      break;
    case PluginFunction::StartUnreset:
      call_if_there(type.start_unreset, self);
      break;
    case PluginFunction::Halt:
      call_if_there(type.halt, self);
      break;
    case PluginFunction::Pause:
      call_if_there(type.pause, self);
      break;
    case PluginFunction::Resume:
      call_if_there(type.resume, self);
      break;
    case PluginFunction::Destroy:
      type.destroy(self);
      break;
    case PluginFunction::Tick:
      return static_cast<std::uint64_t>(type.tick(self));
    case PluginFunction::Progress:
      return type.progress == nullptr ? 0 : std::bit_cast<std::uint64_t>(type.progress(self));
    case PluginFunction::SetPace:
      return std::bit_cast<std::uint64_t>(type.set_pace == nullptr ? 1.0
                                                                   : type.set_pace(self, factor_));
    case PluginFunction::Save:
      return save(type, self);
    case PluginFunction::Restore:
      if (type.restore == nullptr) break;
      return static_cast<std::uint64_t>(
          type.restore(self, restored_.data(), restored_.size(), &cut_));
    default:
      break;
  }
  return 0;
}

std::uint64_t ServedRun::save(const lockstep_leaf_type& type, void* self) {
  if (type.save == nullptr) return 0;
  kept_.resize(LOCKSTEP_MOST_KEPT);
  const std::size_t size = type.save(self, kept_.data(), kept_.size());
  kept_.resize(std::min(size, kept_.size()));
  return size;
}

std::uint64_t ServedRun::create(Object& object) {
  object.slot.self = object.type->create(&host_table(), &*object.caller, objects_.at(0)->slot.self);
  return object.slot.self != nullptr ? 1 : 0;
}

std::string ServedRun::call(Object& object, PluginFunction function, std::uint64_t& result) {
  const MarkedCall mark(*object.site, function);
  return thrown_by([&] {
    result = object.type == nullptr               ? call_run(object, function)
             : function == PluginFunction::Create ? create(object)
                                                  : call_leaf(object, function);
  });
}

void ServedRun::write_entries(MessageWriter& answer) const {
  for (const Entry* entry : written_) {
    // A set that failed for want of memory may have left nothing there.
    if (!entry->has_value()) continue;
    answer.put(numbers_.at(entry));
    answer.put_value(entry->value());
  }
  answer.put(RemoteEntries::kNone);
}

void ServedRun::perform(Object& object, PluginFunction function, MessageWriter& message) {
  Answer answer;
  written_.clear();
  kept_.clear();
  const Nanoseconds began = is_measured_ ? monotonic_now() : Nanoseconds(0);
  const std::string thrown = call(object, function, answer.result);
  if (is_measured_) answer.took = monotonic_now() - began;
  if (!thrown.empty()) answer.outcome = Outcome::Threw;
  answer.thrown = thrown;
  answer.kept = kept_;
  if (object.slot.error != nullptr) answer.error = object.slot.error;
  if (object.caller->rest != nullptr) answer.reason = object.caller->rest->reason.text();
  write_answer(answer, message);
  write_entries(message);
  is_measured_ |= message.bytes().size() >= kMuchToCarry;
  if (message.bytes().size() > Channel::kLargest) {
    message.clear();
    write_answer({.outcome = Outcome::TooLarge, .result = answer.result}, message);
    message.put(RemoteEntries::kNone);
  }
  object.slot.set_error(nullptr);
  if (!answer.reason.empty()) object.caller->rest->reason = Shortened();
  const bool creates = function == PluginFunction::Create;
  if (is_destroy(function) || (creates && answer.result == 0)) objects_.erase(object.number);
}

// The turns that the engine has given to the workers of its own process since the last request, at
// the same times: first those after the tick before, and two at the start of this tick.
void ServedRun::give_turns(Nanoseconds now, std::uint32_t turns) {
  constexpr std::uint32_t kAtStart = 2;
  std::uint32_t missed = turns - std::exchange(time_.turns, turns);
  if (missed > 0 && now != time_.now) {
    workers_.give_turns(time_.now);
    --missed;
  }
  time_.now = now;
  for (missed = std::min(missed, kAtStart); missed > 0; --missed) workers_.give_turns(now);
}

bool ServedRun::answer(PluginFunction function, MessageReader& request, MessageWriter& answer) {
  is_measured_ |= request.rest().size() >= kMuchToCarry;
  const auto number = request.get<std::uint32_t>();
  time_.thread = this_thread_id();
  const auto now = request.get<Nanoseconds>();
  time_.period = request.get<Nanoseconds>();
  const auto turns = request.get<std::uint32_t>();
  time_.workers = turns != 0 ? &workers_ : nullptr;
  give_turns(now, turns);
  Object* const object = function == PluginFunction::CreateRun ? create_run(request)
                         : function == PluginFunction::Create  ? create_leaf(number, request)
                                                               : find(number);
  factor_ = function == PluginFunction::SetPace ? request.get<double>() : 1.0;
  if (function == PluginFunction::Restore) {
    cut_ = request.get<lockstep_cut>();
    restored_ = request.text();
  }
  if (object == nullptr || !read_entries(request)) return false;
  perform(*object, function, answer);
  return true;
}

}  // namespace lockstep::host
