#include "property/btcpp_reference.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>

namespace lockstep::host::test::law {

// Ends the run.
struct Failed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Board {
  Board* parent = nullptr;
  std::string prefix = {};
  std::map<std::string, std::string> remapped = {};
  std::set<std::string> literals = {};
  bool autoremap = false;
  std::map<std::string, Entry> entries = {};

  Board& main() { return parent == nullptr ? *this : parent->main(); }

  // Where a key is, or would be made.
  std::pair<Board*, std::string> home(const std::string& key) {
    if (key[0] == '@') return {&main(), key.substr(1)};
    if (parent == nullptr || literals.contains(key)) return {this, key};
    if (const auto it = remapped.find(key); it != remapped.end()) return parent->home(it->second);
    if (autoremap && key[0] != '_') return parent->home(key);
    return {this, key};
  }
  Entry* find(const std::string& key) {
    const auto [board, name] = home(key);
    const auto it = board->entries.find(name);
    return it == board->entries.end() ? nullptr : &it->second;
  }
  Entry& make(const std::string& key) {
    const auto [board, name] = home(key);
    return board->entries[name];
  }
};

struct World {
  const Document& document;
  std::vector<std::unique_ptr<Board>> boards = {};
  EventLog events = {};
  std::uint32_t leaves = 0;
  LeafBehavior* behavior = nullptr;
  std::vector<Node*> nodes = {};
  int time = 0;           // milliseconds
  bool is_asked = false;  // for another tick
};

// A value as an attribute names it.
std::optional<std::string> key_in(const std::string& text) {
  if (text.size() < 3 || text.front() != '{') return std::nullopt;
  return text.substr(1, text.size() - 2);
}

class Node {
 public:
  Node(const Element& element, Board& board, World& world)
      : element_(element), board_(&board), world_(world) {
    world.nodes.push_back(this);
    if (element.tag == "Act" || element.tag == "Cond") number_ = world.leaves++;
    read_letters();
    for (const auto& [name, value] : element.attributes) declare(name, value);
    if (element.tag == "SubTree") enter();
    for (const Element& child : element.children) {
      children_.push_back(std::make_unique<Node>(child, board, world));
    }
    for (const auto& child : children_) child->parent_ = this;
  }

  Status execute() {
    was_ticked_ = true;
    const Status result = decide().value_or(Status::Idle);
    Status it = result == Status::Idle ? tick() : result;
    if (it == Status::Success || it == Status::Failure) {
      run(it == Status::Success ? "_onSuccess" : "_onFailure");
      run("_post");
    }
    status_ = it == Status::Skipped ? Status::Idle : it;
    was_skipped_ = it == Status::Skipped;
    is_paused_ = false;
    last_ = it;
    return it;
  }

  // In [0, 1]; of a node that runs as the table of semantics says.
  double progress() const {
    if (status_ == Status::Running) return progress_of_running();
    return status_ == Status::Success ? 1 : 0;
  }

  void pause() {
    if (status_ != Status::Running || is_paused_) return;
    is_paused_ = true;
    if (element_.tag == "Act") tell(Call::Pause);
    for (const auto& child : children_) child->pause();
  }

  void halt() {
    if (element_.tag == "Act") tell(Call::Halt);
    if (element_.tag == "TryCatch") catch_halt();
    reset_children();
    forget(Ended::Halted);
    status_ = Status::Idle;
    was_skipped_ = is_paused_ = false;
    run("_onHalted");
  }

  Status status() const { return status_; }
  bool was_ticked() const { return was_ticked_; }
  void forget_tick() { was_ticked_ = false; }

  void keep(KeptState& state) {
    state(status_, progress_, last_, was_skipped_, is_paused_, at_, skipped_, rounds_, times_);
    state(is_over_, is_open_, once_);
    keep_moment(state);
    for (const auto& child : children_) {
      const auto it = done_.find(child.get());
      std::optional<bool> done = it == done_.end() ? std::nullopt : std::optional(it->second);
      state(done);
      if (!done) {
        done_.erase(child.get());
      } else {
        done_[child.get()] = *done;
      }
    }
  }

  void reset() {
    if (status_ == Status::Running) {
      halt();
    } else {  // it, or what is in it, may have been skipped and keep something
      reset_children();
      forget(Ended::Reset);
    }
    status_ = Status::Idle;
    was_skipped_ = is_paused_ = false;
  }

 private:
  enum class Ended { Halted, Reset };
  using Children = std::vector<std::unique_ptr<Node>>;

  void keep_moment(KeptState& state) {
    bool has_moment = since_.has_value();
    state(has_moment);
    Nanoseconds since = std::chrono::milliseconds(since_.value_or(0));
    state.moment(since);
    since_.reset();
    if (has_moment) since_ = static_cast<int>(since / std::chrono::milliseconds(1));
  }

  // A leaf.
  void tell(Call call) {
    world_.events.push_back({call, number_});
    if (world_.behavior == nullptr) return;
    if (call == Call::Start) world_.behavior->start(number_);
    if (call == Call::Halt) world_.behavior->halt(number_);
    if (call == Call::Pause) world_.behavior->pause(number_);
    if (call == Call::Resume) world_.behavior->resume(number_);
  }

  void declare(const std::string& name, const std::string& value) {
    const auto key = key_in(value);
    if (!key || element_.tag == "SubTree") return;
    const bool is_new = board_->find(*key) == nullptr;
    Entry& entry = board_->make(*key);
    const bool is_int = name == "num_cycles" || name == "num_attempts" || name == "success_count" ||
                        (name == "value" && element_.tag == "LoopInt");
    if (is_new) entry.is_int = is_int;
  }

  void enter() {
    Board& inner = *world_.boards.emplace_back(std::make_unique<Board>());
    inner.parent = board_;
    inner.prefix = board_->prefix + element_.attributes.at("name") + "/";
    for (const auto& [name, value] : element_.attributes) {
      if (name == "ID" || name == "name") continue;
      if (name == "_autoremap") {
        inner.autoremap = value == "true";
      } else if (value == "{=}") {
        inner.remapped[name] = name;
      } else if (const auto key = key_in(value)) {
        inner.remapped[name] = *key;
      } else {
        const bool is_number = value.find_first_not_of("0123456789") == std::string::npos;
        inner.literals.insert(name);
        literals_.push_back({name, is_number ? Entry{std::stod(value), 1, true, false}
                                             : Entry{value, 1, false, false}});
      }
    }
    for (const auto& [name, entry] : literals_) inner.entries[name] = entry;
    const Element& root = world_.document.at(element_.attributes.at("ID"));
    children_.push_back(std::make_unique<Node>(root, inner, world_));
  }

  // --- scripts ---

  const Entry& need(const std::string& name) const {
    const Entry* entry = board_->find(name);
    if (entry == nullptr) throw Failed("no " + name);
    if (entry->value.index() == 0) throw Failed("empty " + name);
    return *entry;
  }

  using Operand = std::variant<std::monostate, double, std::string>;
  Operand operand(const Script& script) const {
    if (!script.other.empty()) return need(script.other).value;
    if (const auto* text = std::get_if<std::string>(&script.value)) return *text;
    return std::get<double>(script.value);
  }

  // Scripts compute with real numbers, and each number is whole here.
  static double need_exact(const Operand& operand) {
    const double number = std::get<double>(operand);
    if (std::fabs(number) > 9007199254740991) throw Failed("beyond what a real number has exactly");
    return number;
  }

  bool holds(const Script& script) const {
    if (script.name.empty()) return std::get<double>(script.value) != 0;
    const Operand left = need(script.name).value, right = operand(script);
    if (left.index() != right.index()) throw Failed("a text and a number");
    if (left.index() == 1) need_exact(left), need_exact(right);
    if (script.op == "==") return left == right;
    if (script.op == "!=") return left != right;
    return script.op == "<" ? left < right : left > right;
  }

  void assign(const Script& script) {
    Entry* entry = script.op == ":=" ? &board_->make(script.name) : board_->find(script.name);
    if (entry == nullptr) throw Failed("no " + script.name);
    Operand value = operand(script);
    if (script.op == "+=") {
      if (entry->value.index() == 0) throw Failed("empty " + script.name);
      value = need_exact(entry->value) + need_exact(value);
    }
    entry->value = value;
    ++entry->writes;
  }

  void run(const std::string& attribute) {
    const auto it = element_.scripts.find(attribute);
    if (it != element_.scripts.end()) assign(it->second);
  }
  std::optional<bool> ask(const std::string& attribute) const {
    const auto it = element_.scripts.find(attribute);
    return it == element_.scripts.end() ? std::nullopt : std::optional(holds(it->second));
  }

  // The result without a tick.
  std::optional<Status> decide() {
    if (status_ == Status::Success || status_ == Status::Failure) return std::nullopt;
    if (status_ == Status::Idle) {
      if (ask("_failureIf").value_or(false)) return Status::Failure;
      if (ask("_successIf").value_or(false)) return Status::Success;
      if (ask("_skipIf").value_or(false)) return Status::Skipped;
    }
    if (ask("_while").value_or(true)) return std::nullopt;
    if (status_ == Status::Running) halt();
    return Status::Skipped;
  }

  // --- parameters ---

  std::string text(const std::string& name) const {
    const auto it = element_.attributes.find(name);
    return it == element_.attributes.end() ? "" : it->second;
  }
  std::int64_t number(const std::string& name, int otherwise = 0) const {
    const std::string value = text(name);
    if (value.empty()) return otherwise;
    const auto key = key_in(value);
    if (!key) return std::stoi(value);
    const Entry* entry = board_->find(*key);
    const auto* held = entry == nullptr ? nullptr : std::get_if<double>(&entry->value);
    if (held == nullptr && otherwise != 0) return otherwise;
    if (held == nullptr) throw Failed(name + " has no value");
    return static_cast<std::int64_t>(*held);
  }

  // --- nodes ---

  Status tick() {
    const std::string& tag = element_.tag;
    if (tag == "Act") return act();
    if (tag == "Cond") return leaf();
    if (tag == "Script") return run("code"), Status::Success;
    if (tag == "ScriptCondition") return *ask("code") ? Status::Success : Status::Failure;
    if (tag == "AlwaysSuccess") return Status::Success;
    if (tag == "AlwaysFailure") return Status::Failure;
    if (tag == "Sleep") return sleep();
    if (tag == "SetBlackboard") return set();
    if (tag == "UnsetBlackboard") return unset();
    if (tag == "WasEntryUpdated") return was_updated() ? Status::Success : Status::Failure;
    if (tag == "Sequence" || tag == "AsyncSequence" || tag == "SequenceWithMemory") {
      return ordered(Status::Success);
    }
    if (tag == "Fallback" || tag == "AsyncFallback") return ordered(Status::Failure);
    if (tag == "ReactiveSequence") return reactive(Status::Success);
    if (tag == "ReactiveFallback") return reactive(Status::Failure);
    if (tag == "Parallel") return parallel();
    if (tag == "ParallelAll") return parallel_all();
    if (is_synchronized()) return synchronized();
    if (tag == "IfThenElse") return if_then_else();
    if (tag == "WhileDoElse") return while_do_else();
    if (tag == "Switch2") return choose();
    if (tag == "TryCatch") return try_catch();
    if (tag == "SubTree") return pass(children_[0]->execute());
    return decorate();
  }

  // "R.5RS": letters, and the progress after that tick where one is written.
  void read_letters() {
    const std::string& text = element_.letters;
    for (std::size_t at = 0; at < text.size();) {
      const char letter = text[at++];
      const std::size_t end = std::min(text.find_first_not_of(".0123456789", at), text.size());
      steps_.emplace_back(letter, std::nullopt);
      if (end != at) steps_.back().second = std::stod(text.substr(at, end - at));
      at = end;
    }
  }

  Status leaf() {
    if (status_ != Status::Running) {
      tell(Call::Start);
      progress_ = 0;
    } else if (is_paused_) {
      tell(Call::Resume);
    }
    tell(Call::Tick);
    if (world_.behavior != nullptr) return world_.behavior->tick(number_);
    const auto& [letter, progress] = steps_[std::min(ticks_++, steps_.size() - 1)];
    progress_ = progress.value_or(progress_);
    return letter == 'R'   ? Status::Running
           : letter == 'S' ? Status::Success
           : letter == 'F' ? Status::Failure
                           : Status::Skipped;
  }
  Status act() {
    if (status_ == Status::Success || status_ == Status::Failure) return status_;
    return leaf();
  }

  Status sleep() {
    if (status_ == Status::Success || status_ == Status::Failure) return status_;
    if (status_ == Status::Idle) since_ = world_.time;
    return world_.time - *since_ >= number("msec") ? Status::Success : Status::Running;
  }

  Status set() {
    const std::string value = text("value");
    if (const auto key = key_in(value)) {
      const Entry* from = board_->find(*key);
      if (from == nullptr) throw Failed("no " + *key);
      if (from->value.index() == 0) return Status::Failure;
      const Entry* const before = board_->find(text("output_key"));
      if (from == before) return Status::Success;
      const Entry copied = *from;
      const bool is_text = before != nullptr ? before->is_text : copied.is_text;
      if (is_text && std::holds_alternative<double>(copied.value)) throw Failed("a text is wanted");
      Entry& to = board_->make(text("output_key"));
      to.value = copied.value;
      to.is_text = is_text;
      ++to.writes;
      return Status::Success;
    }
    const bool is_new = board_->find(text("output_key")) == nullptr;
    Entry& to = board_->make(text("output_key"));
    to.value = value;
    to.is_text = to.is_text || is_new;
    ++to.writes;
    return Status::Success;
  }

  Status unset() {
    const auto [board, key] = board_->home(text("key"));
    if (board == board_ && text("key")[0] != '@') board->entries.erase(key);
    return Status::Success;
  }

  bool was_updated() {
    const Entry* entry = board_->find(key_in(text("entry")).value_or(text("entry")));
    if (entry == nullptr || entry->writes == seen_) return false;
    seen_ = entry->writes;
    return true;
  }

  Status end(Status result) {
    reset_children();
    at_ = 0;
    skipped_ = 0;
    return result;
  }

  // A child, and whether the root is to be ticked again after it.
  bool completes_at_once(Node& child, Status& result) {
    const bool was_idle = child.status_ == Status::Idle;
    result = child.execute();
    return was_idle && (result == Status::Success || result == Status::Failure);
  }

  Status ordered(Status goes_on) {
    const bool yields = element_.tag.starts_with("Async") || element_.tag == "SequenceWithMemory";
    const bool keeps = element_.tag == "SequenceWithMemory";
    if (status_ != Status::Running) {
      skipped_ = 0;
      if (!keeps) at_ = 0;
    }
    while (at_ < children_.size()) {
      Status result{};
      const bool at_once = completes_at_once(*children_[at_], result);
      if (result == Status::Running) return result;
      if (result != goes_on && result != Status::Skipped) {
        const std::size_t place = at_;
        end(result);
        if (keeps) at_ = place;
        return result;
      }
      if (result == Status::Skipped) ++skipped_;
      ++at_;
      if (yields && at_once && at_ < children_.size()) {
        world_.is_asked = true;
        return Status::Running;
      }
      if (goes_on == Status::Success && at_ < children_.size() && is_limit_reached())
        return Status::Running;
    }
    return end(skipped_ == children_.size() ? Status::Skipped : goes_on);
  }

  Status reactive(Status goes_on) {
    std::size_t skipped = 0;
    const std::size_t last = status_ == Status::Running ? at_ : 0;
    at_ = 0;
    for (const auto& child : children_) {
      if (goes_on == Status::Success && at_ > last && is_limit_reached()) {
        for (const auto& each : children_) each->reset();
        return Status::Running;
      }
      const Status result = child->execute();
      if (result != Status::Running) ++at_;
      if (result == goes_on) continue;
      if (result == Status::Skipped) {
        child->reset();
        ++skipped;
        continue;
      }
      if (result != Status::Running) return end(result);
      for (const auto& other : children_) {
        if (other != child) other->reset();
      }
      return result;
    }
    return end(skipped == children_.size() ? Status::Skipped : goes_on);
  }

  std::int64_t count(std::int64_t given) const {
    const std::int64_t all = std::ssize(children_);
    return given >= 0 ? given : std::max(all + given + 1, std::int64_t{0});
  }

  // How many were skipped: it, or none.
  unsigned tick_unless_done(Node& child) {
    if (done_.contains(&child)) return 0u;
    const Status result = child.execute();
    if (result == Status::Success) done_[&child] = true;
    if (result == Status::Failure) done_[&child] = false;
    return result == Status::Skipped ? 1u : 0u;
  }

  Status parallel() {
    const int all = static_cast<int>(children_.size());
    const std::int64_t given = number("success_count", -1);
    const std::int64_t wanted = count(given), failures = count(number("failure_count", 1));
    unsigned skipped = 0;
    for (const auto& child : children_) {
      skipped += tick_unless_done(*child);
      int succeeded = 0, failed = 0;
      for (const auto& [node, success] : done_) ++(success ? succeeded : failed);
      if (succeeded + static_cast<int>(given < 0 ? skipped : 0) >= wanted)
        return end_parallel(Status::Success);
      if (all - failed < wanted || failed == failures) return end_parallel(Status::Failure);
    }
    return skipped == children_.size() ? pass(Status::Skipped) : Status::Running;
  }
  Status end_parallel(Status result) {
    done_.clear();
    return end(result);
  }

  Status parallel_all() {
    std::size_t skipped = 0;
    int failed = 0;
    for (const auto& child : children_) skipped += tick_unless_done(*child);
    for (const auto& [node, success] : done_) failed += success ? 0 : 1;
    if (skipped == children_.size()) return Status::Skipped;
    if (done_.size() + skipped < children_.size()) return Status::Running;
    return end_parallel(failed >= count(number("max_failures", 1)) ? Status::Failure
                                                                   : Status::Success);
  }

  // --- what lockstep adds ---

  bool is_synchronized() const {
    return element_.tag == "ParallelAbsolute" || element_.tag == "ParallelRelative";
  }

  // Without an action in it.
  bool is_guard() const {
    constexpr const char* kActions[] = {
        "Act",           "Script",        "Sleep",          "SetBlackboard",
        "AlwaysSuccess", "AlwaysFailure", "UnsetBlackboard"};
    if (std::ranges::find(kActions, element_.tag) != std::end(kActions)) return false;
    return std::ranges::all_of(children_, [](const auto& child) { return child->is_guard(); });
  }

  // Of a child of a synchronized node: nobody waits for one that has failed.
  double reached() const { return status_ == Status::Failure && !is_guard() ? 1 : progress(); }

  // "hold=\"between\" looks at the barrier also between the children of a Sequence in a tick."
  bool is_limit_reached() {
    if (is_guard()) return false;
    for (Node* branch = this; branch->parent_ != nullptr; branch = branch->parent_) {
      const Node& holder = *branch->parent_;
      if (holder.text("hold") != "between") continue;
      if (holder.is_held(progress_in_tick(*branch), holder.least_)) return true;
    }
    return false;
  }
  // Of a node around this one: as if the tick ended here.
  double progress_in_tick(Node& branch) {
    std::vector<std::pair<Node*, Status>> before;
    for (Node* node = this; node != branch.parent_; node = node->parent_) {
      before.emplace_back(node, node->status_);
      node->status_ = Status::Running;
    }
    const double progress = branch.progress();
    for (auto& [node, status_before] : before) node->status_ = status_before;
    return progress;
  }

  bool is_held(double reached, double least) const {
    constexpr double kEpsilon = 1e-9;
    if (element_.tag == "ParallelRelative") {
      return reached > least + std::stod(text("delta")) + kEpsilon;
    }
    std::istringstream barriers(text("barriers"));
    for (std::string it; std::getline(barriers, it, ';');) {
      const double barrier = std::stod(it);
      if (barrier <= least + kEpsilon) continue;
      return text("at_barrier") == "tick" ? reached > barrier + kEpsilon
                                          : reached >= barrier - kEpsilon;
    }
    return false;
  }

  Status synchronized() {
    const bool has_ended = status_ == Status::Success || status_ == Status::Failure;
    if (has_ended) reset_children();  // one whose members were all skipped resets nothing
    std::vector<double> snapshot;
    double& least = least_ = 1;
    for (const auto& child : children_) {
      snapshot.push_back(child->was_skipped_ ? -1 : child->reached());
      if (!child->was_skipped_) least = std::min(least, snapshot.back());
    }
    int there = 0, succeeded = 0, failed = 0;
    for (std::size_t i = 0; i < children_.size(); ++i) {
      Node& child = *children_[i];
      const bool is_over = child.status_ == Status::Success || child.status_ == Status::Failure;
      if (child.is_guard()) {
        if (is_over) child.reset();
        child.execute();
      } else if (!is_over && (snapshot[i] < 0 || !is_held(snapshot[i], least))) {
        child.execute();
      } else if (!is_over) {
        child.pause();
      }
      there += child.was_skipped_ ? 0 : 1;
      succeeded += child.status_ == Status::Success ? 1 : 0;
      failed += child.status_ == Status::Failure ? 1 : 0;
    }
    if (there == 0) return pass(Status::Skipped);
    const std::int64_t wanted = std::min<std::int64_t>(number("success_count", there), there);
    if (succeeded >= wanted) return end(Status::Success);
    const bool is_lost = failed >= number("failure_count", 1) || there - failed < wanted;
    return is_lost ? end(Status::Failure) : Status::Running;
  }

  double progress_of_running() const {
    const std::string& tag = element_.tag;
    const auto all = static_cast<double>(children_.size());
    if (tag == "Act" && world_.behavior != nullptr) return world_.behavior->progress(number_);
    if (tag == "Act") return progress_;
    if (tag == "Sleep")
      return std::min(1.0, (world_.time - *since_) / static_cast<double>(number("msec")));
    if (tag == "Sequence" || tag == "AsyncSequence" || tag == "SequenceWithMemory") {
      return (static_cast<double>(at_) + children_[at_]->progress()) / all;
    }
    if (tag == "TryCatch" && at_ + 1 < children_.size()) {
      return (static_cast<double>(at_) + children_[at_]->progress()) / (all - 1);
    }
    if (tag == "IfThenElse") return at_ == 0 ? 0 : children_[at_]->progress();
    if (tag == "Fallback" || tag == "AsyncFallback" || tag == "Switch2" || tag == "TryCatch") {
      return children_[at_]->progress();
    }
    if (tag.starts_with("Reactive") || tag == "WhileDoElse") return progress_of_reactive();
    if (tag == "Parallel") return progress_of_parallel();
    if (tag == "ParallelAll" || is_synchronized()) return least_progress();
    const Node& child = *children_[0];
    if (tag == "Repeat" && times_ > 0)
      return std::min(
          1.0, (static_cast<double>(rounds_) + running(child)) / static_cast<double>(times_));
    if (tag == "LoopInt") {
      const bool runs = child.status_ == Status::Running;
      return (static_cast<double>(rounds_ - (runs ? 1 : 0)) + running(child)) / 3;
    }
    // Its child has succeeded, and begins again in the next tick.
    const bool begins_again = child.status_ != Status::Running && child.last_ == Status::Success;
    if (tag == "KeepRunningUntilFailure" && begins_again) return 1;
    return tag == "Repeat" ? running(child) : child.progress();
  }

  static double running(const Node& child) {
    return child.status_ == Status::Running ? child.progress() : 0;
  }

  // Of the child that runs; at most one does.
  double progress_of_reactive() const {
    for (std::size_t i = 0; i < children_.size(); ++i) {
      if (children_[i]->status_ != Status::Running) continue;
      const double child = children_[i]->progress();
      if (element_.tag == "WhileDoElse") return i == 0 ? 0 : child;
      if (element_.tag == "ReactiveFallback") return child;
      return (static_cast<double>(i) + child) / static_cast<double>(children_.size());
    }
    if (element_.tag == "ReactiveSequence")  // it is held between two children
      return static_cast<double>(at_) / static_cast<double>(children_.size());
    return 0;
  }

  double progress_of_parallel() const {
    std::vector<double> all;
    for (const auto& child : children_) {
      if (!child->was_skipped_) all.push_back(child->progress());
    }
    if (all.empty()) return 0;
    std::ranges::sort(all, std::greater<>());
    const std::int64_t wanted =
        std::clamp<std::int64_t>(count(number("success_count", -1)), 1, std::ssize(children_));
    return all[std::min(static_cast<std::size_t>(wanted), all.size()) - 1];
  }

  double least_progress() const {
    double least = 1;
    for (const auto& child : children_) {
      if (child->was_skipped_) continue;
      if (is_synchronized()) {
        least = std::min(least, child->reached());
      } else if (child->status_ != Status::Failure) {
        least = std::min(least, child->progress());
      }
    }
    return least;
  }

  Status if_then_else() {
    if (status_ != Status::Running) at_ = 0;
    if (at_ == 0) {
      const Status condition = children_[0]->execute();
      if (condition == Status::Running) return condition;
      if (condition == Status::Skipped) throw Failed("a condition was skipped");
      at_ = condition == Status::Success ? 1 : 2;
    }
    if (at_ == children_.size()) return end(Status::Failure);
    const Status result = children_[at_]->execute();
    return result == Status::Running ? result : end(result);
  }

  Status while_do_else() {
    const Status condition = children_[0]->execute();
    if (condition == Status::Running) return condition;
    if (condition == Status::Skipped) {
      reset_children();  // a TryCatch may tick a leaf when it is halted
      throw Failed("a condition was skipped");
    }
    const std::size_t branch = condition == Status::Success ? 1 : 2, other = 3 - branch;
    if (other < children_.size()) children_[other]->reset();
    if (branch == children_.size()) return end(Status::Failure);
    const Status result = children_[branch]->execute();
    return result == Status::Running ? result : end(result);
  }

  // The cases are texts here.
  Status choose() {
    std::size_t chosen = 2;
    const Entry* entry = board_->find(*key_in(text("variable")));
    const auto* held = entry == nullptr ? nullptr : std::get_if<std::string>(&entry->value);
    if (held != nullptr && *held == text("case_2")) chosen = 1;
    if (held != nullptr && *held == text("case_1")) chosen = 0;
    if (status_ == Status::Running && at_ != chosen) children_[at_]->reset();
    at_ = chosen;
    const Status result = children_[chosen]->execute();
    if (result == Status::Success || result == Status::Failure) reset_children();
    return result;
  }

  Status try_catch() {
    if (status_ != Status::Running) at_ = skipped_ = 0;
    const std::size_t last = children_.size() - 1;
    while (at_ < last) {
      const Status result = children_[at_]->execute();
      if (result == Status::Running) return result;
      if (result == Status::Failure) {
        reset_children();
        at_ = last;
        break;
      }
      if (result == Status::Skipped) ++skipped_;
      if (++at_ == last) return end(skipped_ == last ? Status::Skipped : Status::Success);
    }
    const Status result = children_[last]->execute();
    return result == Status::Running ? result : end(Status::Failure);
  }
  void catch_halt() {
    const std::size_t last = children_.size() - 1;
    if (at_ == last || text("catch_on_halt") != "true") return;
    for (std::size_t i = 0; i < last; ++i) children_[i]->reset();
    if (children_[last]->execute() == Status::Running) children_[last]->halt();
  }

  // A child that has completed is reset.
  Status pass(Status result) {
    if (result == Status::Success || result == Status::Failure) children_[0]->reset();
    return result;
  }

  Status decorate() {
    const std::string& tag = element_.tag;
    Node& child = *children_[0];
    if (tag == "Repeat") return repeat(Status::Success, "num_cycles");
    if (tag == "RetryUntilSuccessful") return repeat(Status::Failure, "num_attempts");
    if (tag == "Delay") {
      if (!since_) since_ = world_.time;
      if (!is_over_ && world_.time - *since_ < number("delay_msec")) return Status::Running;
      is_over_ = true;
    }
    if (tag == "Timeout") {
      if (!since_) since_ = world_.time;
      if (!is_over_ && number("msec") > 0 && world_.time - *since_ >= number("msec")) {
        is_over_ = true;
        if (child.status_ == Status::Running) {
          child.halt();
          forget(Ended::Reset);
          return Status::Failure;
        }
      }
    }
    if (tag == "RunOnce" && once_) {
      return text("then_skip") == "false" ? *once_ : Status::Skipped;
    }
    if (tag == "Precondition" && !is_open_) {
      if (!*ask("if")) return word(text("else"));
      is_open_ = true;
    }
    if (tag == "LoopInt") return loop();
    const bool waits = tag == "SkipUnlessUpdated" || tag == "WaitValueUpdate";
    if (waits && child.status_ != Status::Running && !was_updated()) {
      return tag == "WaitValueUpdate" ? Status::Running : Status::Skipped;
    }
    return decorated(tag, pass(child.execute()));
  }

  Status decorated(const std::string& tag, Status result) {
    if (tag == "KeepRunningUntilFailure") {
      return result == Status::Failure ? result : Status::Running;
    }
    if (result == Status::Running || result == Status::Skipped) return result;
    forget(Ended::Reset);
    if (tag == "RunOnce") once_ = result;
    if (tag == "Inverter") {
      return result == Status::Success ? Status::Failure : Status::Success;
    }
    if (tag == "ForceSuccess") return Status::Success;
    return tag == "ForceFailure" ? Status::Failure : result;
  }

  Status repeat(Status goes_on, const std::string& port) {
    Node& child = *children_[0];
    times_ = number(port);  // once in a tick; a Retry reads it after each attempt, too
    while (rounds_ < times_) {
      Status result{};
      const bool at_once = completes_at_once(child, result);
      if (result == Status::Running) return result;
      child.reset();
      if (result == Status::Skipped) return result;
      if (result != goes_on) {
        rounds_ = 0;
        return result;
      }
      ++rounds_;
      if (goes_on == Status::Failure) times_ = number(port);
      if (at_once && rounds_ < times_) {
        world_.is_asked = true;
        return Status::Running;
      }
    }
    rounds_ = 0;
    return goes_on;
  }

  // Over the items 1, 2 and 3.
  Status loop() {
    if (status_ == Status::Idle) rounds_ = 0;  // one that has completed goes on
    if (children_[0]->status_ != Status::Running) {
      if (rounds_ < 0 || rounds_ == 3) return word(text("if_empty"));
      Entry& entry = board_->make(*key_in(text("value")));
      entry.value = static_cast<double>(++rounds_);
      ++entry.writes;
    }
    return pass(children_[0]->execute()) == Status::Failure ? Status::Failure : Status::Running;
  }

  static Status word(const std::string& text) {
    return text == "SUCCESS"   ? Status::Success
           : text == "RUNNING" ? Status::Running
           : text == "SKIPPED" ? Status::Skipped
                               : Status::Failure;
  }

  void reset_children() {
    for (const auto& child : children_) child->reset();
  }

  // What ends with an activation. RunOnce, and what was seen of an entry, stay.
  void forget(Ended how) {
    since_.reset();
    is_over_ = is_open_ = false;
    if (element_.tag != "LoopInt") rounds_ = 0;
    done_.clear();
    if (how == Ended::Halted && element_.tag != "SequenceWithMemory") at_ = 0;
  }

  const Element& element_;
  Board* board_;
  World& world_;
  Children children_;
  Status status_ = Status::Idle;
  std::uint32_t number_ = 0;
  std::vector<std::pair<std::string, Entry>> literals_;
  std::vector<std::pair<char, std::optional<double>>> steps_;  // of a leaf
  double progress_ = 0;                                        // of a leaf
  Node* parent_ = nullptr;
  double least_ = 1;            // of the snapshot of a synchronized node
  Status last_ = Status::Idle;  // what its last tick returned
  bool was_skipped_ = false, is_paused_ = false, was_ticked_ = false;
  std::size_t ticks_ = 0, at_ = 0, skipped_ = 0;
  unsigned seen_ = 0;
  // Those of a LoopInt that has not begun are -1: after _successIf it is not idle, and has no list.
  std::int64_t rounds_ = element_.tag == "LoopInt" ? -1 : 0, times_ = 0;
  std::optional<int> since_;
  bool is_over_ = false, is_open_ = false;
  std::optional<Status> once_;
  std::map<const Node*, bool> done_;  // whether it succeeded
};

Reference::Reference(const Document& document, LeafBehavior* behavior)
    : world_(new World{.document = document, .behavior = behavior}) {
  Board& main = *world_->boards.emplace_back(std::make_unique<Board>());
  root_ = std::make_unique<Node>(document.at("Main"), main, *world_);
}
Reference::~Reference() = default;

std::optional<Status> Reference::tick() {
  for (Node* node : world_->nodes) node->forget_tick();
  try {
    Status result = Status::Running;
    int ticks = 0;
    do {
      if (ticks++ == kMostTicksAtOnce) throw Failed("endless");
      world_->is_asked = false;
      result = root_->execute();
    } while (result == Status::Running && world_->is_asked);
    if (result == Status::Success || result == Status::Failure) root_->reset();
    world_->time += 100;
    return result;
  } catch (const Failed&) {
    return std::nullopt;
  }
}

void Reference::write(const std::string& entry, double value) {
  Entry& to = world_->boards.front()->make(entry);
  to.value = value;
  ++to.writes;
}

void Reference::keep(KeptState& state) {
  for (const auto& board : world_->boards) {
    std::map<std::string, double> numbers;
    std::map<std::string, std::string> texts;
    for (const auto& [key, entry] : board->entries) {
      if (const auto* number = std::get_if<double>(&entry.value)) numbers[key] = *number;
      if (const auto* text = std::get_if<std::string>(&entry.value)) texts[key] = *text;
    }
    state(numbers, texts);
    if (state.is_writing()) continue;
    for (auto& [key, entry] : board->entries) entry.value = {};
    for (const auto& [key, number] : numbers) board->entries[key].value = number;
    for (const auto& [key, text] : texts) board->entries[key].value = text;
  }
  for (Node* node : world_->nodes) node->keep(state);
}

std::string Reference::save(Nanoseconds longest) {
  std::string bytes;
  KeptState state(bytes, {std::chrono::milliseconds(world_->time), 0, longest});
  keep(state);
  return bytes;
}

void Reference::restore(const std::string& bytes, Nanoseconds longest) {
  world_->time = 1'000'000;
  world_->events.clear();
  KeptState state(bytes, {std::chrono::milliseconds(world_->time), 0, longest});
  keep(state);
}

std::size_t Reference::nodes() const {
  return world_->nodes.size();
}
Status Reference::status(std::size_t node) const {
  return world_->nodes[node]->status();
}
bool Reference::ticked(std::size_t node) const {
  return world_->nodes[node]->was_ticked();
}

EventLog& Reference::events() {
  return world_->events;
}

std::map<std::string, Entry> Reference::entries() const {
  std::map<std::string, Entry> all;
  for (const auto& board : world_->boards) {
    for (const auto& [key, entry] : board->entries) all[board->prefix + key] = entry;
  }
  return all;
}

}  // namespace lockstep::host::test::law
