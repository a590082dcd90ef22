#include "property/reference_pool.h"

#include <algorithm>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "property/reference_barrier.h"

namespace lockstep::host::test {
namespace {

// "left;any(gripper;hook)"
Wish wish_in(const std::string& list) {
  Wish wish;
  bool is_choice = false;
  std::istringstream text(list);
  for (std::string name; std::getline(text, name, ';');) {
    if (name.starts_with("any(")) is_choice = true, name.erase(0, 4);
    const bool is_last = name.ends_with(")");
    if (is_last) name.pop_back();
    if (is_choice) {
      wish.any.push_back(name);
    } else {
      wish.all.insert(name);
    }
    if (is_last) is_choice = false;
  }
  return wish;
}

}  // namespace

Resources Wish::everything() const {
  Resources names = all;
  names.insert(any.begin(), any.end());
  return names;
}

ReferencePool::ReferencePool(Reference& tree, const Plan& its_plan, ReferenceNode& root)
    : ReferenceGroup(tree, its_plan, root) {
  add_names(plan.resources);
  if (!names_.empty()) return;
  for (std::size_t place = 0; place < count(); ++place) {
    const Plan& user = member(place).plan;
    if (!user.from_entries.contains("resources")) add_names(user.resources);
  }
}

void ReferencePool::add_names(std::string list) {
  for (const char* mark : {"any(", ")"}) {
    if (const auto at = list.find(mark); at != list.npos) list.erase(at, std::strlen(mark));
  }
  std::istringstream text(list);
  for (std::string name; std::getline(text, name, ';');) {
    if (!knows(name)) names_.push_back(name);
  }
}

std::string ReferencePool::text_of(const Resources& set) const {
  std::string text;
  for (const std::string& name : names_) {
    if (set.contains(name)) text += (text.empty() ? "" : ";") + name;
  }
  return text;
}

UseResources& ReferencePool::user(std::size_t place) const {
  return dynamic_cast<UseResources&>(member(place));
}

bool ReferencePool::is_owned(const std::string& name) const {
  for (std::size_t place = 0; place < count(); ++place) {
    if (dynamic_cast<const UseResources&>(member(place)).owned(name)) return true;
  }
  return false;
}

// "Before the root is ticked: of the members that are active and unfinished, by (priority falling,
// document order), grant each whose set is disjoint from what is granted in this tick and whose
// gates are open". Those that keep their set come before all others.
void ReferencePool::before_tick() {
  status = Status::Running;
  std::vector<UseResources*> asking;
  for (std::size_t place = 0; place < count(); ++place) user(place).begin_tick();
  for (std::size_t place = 0; place < count(); ++place) {
    UseResources& it = user(place);
    if (it.runs() && it.keeps() && !it.wants_another()) {
      it.keep_set();
      continue;
    }
    if (it.runs()) it.keep_old_set();
    if (it.is_active() && it.is_right(it.wanted())) asking.push_back(&it);
  }
  std::ranges::stable_sort(asking, std::greater<>(), &UseResources::priority);
  for (UseResources* it : asking) it->ask_after_outer(asking);
}

// "However urgent it is, those around it ask before it."
void UseResources::ask_after_outer(const std::vector<UseResources*>& asking) {
  for (UseResources* other : asking) {
    if (other == this || !is_inside_of(*other) || other->asked_in_ == world.tick) continue;
    note("a member asks early for one inside of it");
    other->ask_after_outer(asking);
  }
  if (asked_in_ != world.tick) ask();
}

bool UseResources::is_inside_of(const ReferenceNode& other) const {
  for (const ReferenceNode* node = parent; node != nullptr; node = node->parent) {
    if (node == &other) return true;
  }
  return false;
}

bool UseResources::is_related(const UseResources& other) const {
  return is_inside_of(other) || other.is_inside_of(*this);
}

// "what the members before it in the same Sequence have owned in this tick"
bool UseResources::takes_over_from(const UseResources& other) {
  const bool may_keep = plan.keep || exchanges() || plan.on_change == "keep";
  if (!may_keep || runs() || other.runs() || number < other.number || is_related(other))
    return false;
  const ReferenceNode* common = parent;
  while (!other.is_inside_of(*common)) common = common->parent;
  return common->plan.kind == "Sequence";
}

// "What members around it and inside of it own is no obstacle", nor what it takes over.
bool UseResources::is_free(const Resources& set) {
  for (std::size_t place = 0; place < pool().users(); ++place) {
    const UseResources& other = pool().user(place);
    if (&other == this || is_related(other) || takes_over_from(other)) continue;
    for (const std::string& name : set) {
      if (other.in_tick_.contains(name)) return false;
    }
  }
  return true;
}

Resources UseResources::handed_over() {
  const Resources wishes = wanted().everything();
  Resources handed;
  for (std::size_t place = 0; place < pool().users(); ++place) {
    const UseResources& before = pool().user(place);
    if (&before == this || !takes_over_from(before)) continue;
    for (const std::string& name : before.in_tick_) {
      const bool is_needed = exchanges() || wishes.contains(name);
      if (is_needed && is_free({name})) handed.insert(name);
    }
  }
  if (!handed.empty()) note("a member takes over from the one before it");
  return handed;
}

ReferencePool& UseResources::pool() const {
  for (ReferenceGroup* group : world.groups) {
    auto* pool = dynamic_cast<ReferencePool*>(group);
    if (pool != nullptr && pool->has_member(*this)) return *pool;
  }
  throw std::logic_error("a UseResources without a pool");
}

// "`resources` may be `{key}`, read in each tick."
Wish UseResources::wanted() const {
  const auto key = plan.from_entries.find("resources");
  if (key == plan.from_entries.end()) return wish_in(plan.resources);
  note("resources come from an entry");
  const auto entry = world.entries.texts.find(key->second);
  return entry == world.entries.texts.end() ? Wish() : wish_in(entry->second);
}

bool UseResources::is_right(const Wish& wish) const {
  const Resources names = wish.everything();
  return !names.empty() &&
         std::ranges::all_of(names, [&](const auto& it) { return pool().knows(it); });
}

// "the first free in the written order"; "it prefers the one that it had"
Resources UseResources::choose(const Wish& wish) {
  if (wish.any.empty()) return wish.all;
  Resources set = wish.all;
  for (const std::string& name : wish.any) {
    const bool had = owned_.contains(name) || handed_.contains(name);
    if (!had || !is_free({name})) continue;
    note("a member chooses again what it had");
    set.insert(name);
    return set;
  }
  for (const std::string& name : wish.any) {
    if (!is_free({name})) continue;
    note(name == wish.any[0] ? "a member chooses the first"
                             : "a member chooses the first that is free");
    set.insert(name);
    return set;
  }
  note("none of several is free");
  return wish.everything();
}

void UseResources::ask() {
  if (is_granted_ && last_tick < asked_in_) note("a grant is not used");
  if (pool().increment() == 0) note("an increment of 0");
  asked_in_ = world.tick;
  is_granted_ = false;
  if (!child().runs()) owned_.clear();
  if (!runs()) handed_ = handed_over();
  if (keeps()) handed_.clear();
  const Resources old = kept();
  in_tick_ = old;
  is_open_ = has_open_gates();
  if (!is_open_) return;
  const Resources set = choose(wanted());
  if (!is_free(set))
    return note(old.empty() ? "a member is denied" : "a member keeps what it has and is denied");
  if (!old.empty()) note("a member exchanges its resources");
  is_granted_ = true;
  granted_ = set;
  if (!keeps()) owned_ = set;
  in_tick_.insert(set.begin(), set.end());
  // "A grant sets the priority to 0, used or not"
  priority_ = 0;
}

bool UseResources::wants_another() const {
  if (!exchanges()) return false;
  const Wish wish = wanted();
  if (!is_right(wish)) return true;
  Resources same = wish.all;
  for (const std::string& name : wish.any) {
    if (!owned_.contains(name)) continue;
    same.insert(name);
    break;
  }
  const bool has_choice = wish.any.empty() || same.size() > wish.all.size();
  return !has_choice || same != owned_;
}

// Before the child is ticked.
void UseResources::write_granted() {
  const auto key = plan.from_entries.find("granted");
  if (key == plan.from_entries.end()) return;
  std::string& entry = world.entries.texts[key->second];
  const std::string text = pool().text_of(owned_);
  if (std::exchange(entry, text) != text) note("an entry says what a member got");
}

// "a child that runs keeps its set until it completes or is halted (all or nothing)"
void UseResources::keep_set() {
  note_kept();
  asked_in_ = world.tick;
  is_granted_ = true;
  granted_ = owned_;
  priority_ = 0;
  in_tick_ = owned_;
}

void UseResources::keep(KeptState& state) {
  ReferenceNode::keep(state);
  state.tick(asked_in_);
  if (!runs() || keeps()) handed_.clear();
  state(is_granted_, is_open_, owned_, in_tick_, handed_, priority_);
}

void UseResources::note_kept() const {
  note("a member keeps its resources");
  if (was_held_by_parallel()) note("a member keeps its resources while a parallel holds it");
  if (!has_open_gates()) note("a member keeps its resources behind a closed gate");
  if (wanted().everything() != owned_)
    note("a member keeps its resources when its entry has others");
}

// "the barriers around it, the SyncProgress directly inside of it if that is held, and each outer
// UseResources"
bool UseResources::has_open_gates() const {
  for (const ReferenceNode* node = parent; node != nullptr; node = node->parent) {
    const auto* around = dynamic_cast<const SyncProgress*>(node);
    if (around != nullptr && around->is_held()) return is_closed("a barrier around it");
    const auto* outer = dynamic_cast<const UseResources*>(node);
    if (outer != nullptr)
      note(&outer->pool() == &pool() ? "nested members of one pool" : "nested pools");
    if (outer != nullptr && !outer->is_granted()) return is_closed("an outer UseResources");
  }
  const auto* inside = dynamic_cast<const SyncProgress*>(directly_inside());
  const bool is_open = inside == nullptr || !inside->is_held();
  return is_open || is_closed("the SyncProgress directly inside of it");
}

// Nodes of one child, such as a SubTree, are nothing in between.
const ReferenceNode* UseResources::directly_inside() const {
  const auto is_member = [](const Plan& it) { return !it.barrier.empty() || !it.pool.empty(); };
  const ReferenceNode* below = children.front().get();
  while (below->children.size() == 1 && !is_member(below->plan)) {
    below = below->children.front().get();
  }
  return below;
}

bool UseResources::is_closed(const std::string& gate) const {
  note("a gate is closed: " + gate);
  return false;
}

// "a synchronized parallel held in the last one"
bool UseResources::was_held_by_parallel() const {
  for (const ReferenceNode* node = this; node != nullptr; node = node->parent) {
    if (node->withheld_in != 0 && node->withheld_in + 1 == world.tick) return true;
  }
  return false;
}

Status UseResources::on_tick(bool first) {
  pool().reach();
  // "it is read in each tick, and what is out of range is a fault"
  if ((exchanges() || !keeps()) && !is_right(wanted())) {
    note("an entry names no resource of the pool");
    throw ReferenceFault{number};
  }
  // "A member that is first reached in this tick, or that a synchronized parallel held in the last
  // one, asks when it is reached, for what is left."
  if (asked_in_ != world.tick) {
    note(first ? "a member asks when it is first reached"
               : "a member asks after a parallel has held it");
    ask();
  }
  // What a barrier holds inside withholds the ticks itself.
  if (!is_granted_ && is_open_) return deny();
  // "Granted: tick the child, return its status."
  // "In the tick in which it gets the new set, its child is ticked": until then it has the old one.
  if (is_granted_) {
    owned_ = granted_;
    write_granted();
  }
  const bool has_run = child().runs();
  const Status result = child().tick();
  // "A member whose child returns Skipped after it has run has used its resources in that tick, so
  // they are free in the next one; one that is skipped without having run in this activation gives
  // them back at once"
  if (result == Status::Skipped && has_run) {
    note("a member is skipped after it has run");
  } else if (result == Status::Skipped) {
    note("a member is skipped and gives back what it owned");
    in_tick_.clear();
    owned_.clear();
    handed_.clear();
  }
  return result;
}

// "Reached and denied: pause a child that runs, priority += increment (saturating at 2 N x
// increment), return Running. A member that a barrier holds neither owns nor ages."
Status UseResources::deny() {
  const int older = priority_ + pool().increment();
  if (older > pool().most_priority()) note("a priority saturates");
  priority_ = std::min(older, pool().most_priority());
  child().pause();
  return Status::Running;
}

}  // namespace lockstep::host::test
