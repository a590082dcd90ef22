// lockstep/runtime.hpp: lockstep inside a C++ program, C++17. Header only, over the C interface of
// lockstep/runtime.h, so a program continues to work with later versions of the library. Link
// lockstep::runtime. docs/embedding.md is the manual. In a few lines:
//
//   lockstep::runtime::Project project;
//   project.add_leaf<Reach>("Reach", "Moves the arm");     // a leaf as in a plugin
//   project.load_file("tree.xml");                         // throws when there are errors
//   lockstep::runtime::Run run(project);
//   while (run.tick(seconds_since_start()) == lockstep::Status::Running) sleep_until_next_cycle();
//
// Errors are exceptions of type lockstep::runtime::Error. Threads: see runtime.h.
#pragma once

#include <lockstep/runtime.h>
#include <lockstep/value_types.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <lockstep/leaf.hpp>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace lockstep::runtime {

class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Diagnostic {
  enum class Severity { Error = LOCKSTEP_ERROR, Warning = LOCKSTEP_WARNING, Note = LOCKSTEP_NOTE };
  Severity severity = Severity::Error;
  std::string file;  // "" when it is about no file
  std::uint32_t line = 0, column = 0;
  std::string message, hint;
};

// Node `index` of a tree, in pre-order.
struct NodeInfo {
  std::uint32_t index = 0, parent = 0, end = 0;
  std::string path, name, id;
};

// An entry of the blackboard, found once: for all runs of its project, in any thread.
struct EntryHandle {
  std::uint32_t index = 0;
};

struct NodeState {
  std::optional<Status> status;  // nothing when it is idle
  double progress = 0;
  bool held = false, ticked = false;
};

namespace detail {

inline void require(bool good) {
  if (!good) throw Error(lockstep_last_error());
}

// How a call names an entry: by key, which is searched each time, or by handle.
class EntryName {
 public:
  EntryName(const char* key) : key_(key) {}
  EntryName(const std::string& key) : key_(key.c_str()) {}
  EntryName(EntryHandle entry) : index_(entry.index) {}

  template <class ByKey, class ByIndex, class... Rest>
  auto call(ByKey by_key, ByIndex by_index, lockstep_run* run, Rest... rest) const {
    return key_ != nullptr ? by_key(run, key_, rest...) : by_index(run, index_, rest...);
  }

 private:
  const char* key_ = nullptr;
  std::uint32_t index_ = 0;
};

inline std::optional<Status> status_of(lockstep_status status) {
  if (status == LOCKSTEP_IDLE) return std::nullopt;
  return static_cast<Status>(status);
}
inline lockstep_status status_or_idle(const std::optional<Status>& status) {
  return status ? static_cast<lockstep_status>(*status) : LOCKSTEP_IDLE;
}

template <class Struct>
Struct sized() {
  Struct it{};
  it.struct_size = sizeof it;
  return it;
}

}  // namespace detail

// A tree with its includes and plugins. Its runs share it and may outlive it.
class Project {
 public:
  Project() : it_(lockstep_project_new()) { detail::require(it_ != nullptr); }
  Project(Project&&) noexcept = default;
  Project& operator=(Project&& other) noexcept {
    it_ = std::move(other.it_);  // before the tables that it uses
    leaves_ = std::move(other.leaves_);
    load_tried_ = other.load_tried_;
    return *this;
  }

  Project& add_plugin_path(const std::string& directory) {
    return check(lockstep_project_add_plugin_path(it_.get(), directory.c_str()));
  }
  // A file, or a name to search for.
  Project& add_plugin(const std::string& plugin) {
    return check(lockstep_project_add_plugin(it_.get(), plugin.c_str()));
  }
  // A leaf, control node or decorator of the program, of a class as in a plugin; `id` is its tag.
  // Both texts must live as long as the program.
  template <class T>
  Project& add_leaf(const char* id, const char* doc) {
    require_unloaded();
    if (id == nullptr || !lockstep::detail::is_id(id)) {
      throw Error("'" + std::string(id == nullptr ? "" : id) +
                  "' is no ID of a leaf: a letter, then letters, digits, '_' and '-'");
    }
    leaves_->types.push_back(
        std::make_unique<lockstep_leaf_type>(lockstep::detail::leaf_type<T>(id, doc)));
    return *this;
  }
  // An object that the leaves of the program share in a run; they reach it with context<Context>().
  template <class Context>
  Project& set_run_context() {
    require_unloaded();
    const lockstep::detail::RunContextPart part = run_context<Context>();
    leaves_->plugin.create_run = part.create;
    leaves_->plugin.destroy_run = part.destroy;
    return *this;
  }
  Project& set_argument(const std::string& name, const std::string& value) {
    return check(lockstep_project_set_argument(it_.get(), name.c_str(), value.c_str()));
  }
  Project& set_value(const std::string& key, const std::string& value) {
    return check(lockstep_project_set_value(it_.get(), key.c_str(), value.c_str()));
  }
  Project& set_main_tree(const std::string& id) {
    return check(lockstep_project_set_main_tree(it_.get(), id.c_str()));
  }
  Project& isolate_all() { return check(lockstep_project_isolate_all(it_.get())); }
  // Keeps what Run::groot2 shows of the tree.
  Project& show_groot2() { return check(lockstep_project_show_groot2(it_.get())); }

  // For tests of trees, before loading: leaves play scripts, and no plugin is called.
  Project& play_leaves() { return check(lockstep_project_play_leaves(it_.get())); }
  // After loading: what the leaves with this path, in which * stands for any part, do in runs that
  // are made or restarted from then on: "R0.25 R0.5 S". `play_each`: in each activation again.
  Project& play(const std::string& path, const std::string& words) {
    return check(lockstep_project_play(it_.get(), path.c_str(), words.c_str(), false));
  }
  Project& play_each(const std::string& path, const std::string& words) {
    return check(lockstep_project_play(it_.get(), path.c_str(), words.c_str(), true));
  }

  // Both throw an Error with all error messages; diagnostics() has them as data. Once in the life
  // of a project.
  void load_file(const std::string& path) {
    add_leaves();
    finish(lockstep_project_load_file(it_.get(), path.c_str()));
  }
  void load_text(const std::string& text, const std::string& name = "text") {
    add_leaves();
    finish(lockstep_project_load_text(it_.get(), name.c_str(), text.data(), text.size()));
  }

  std::vector<Diagnostic> diagnostics() const {
    std::vector<Diagnostic> list(lockstep_project_diagnostic_count(it_.get()));
    for (std::uint32_t i = 0; i < list.size(); ++i) {
      auto from = detail::sized<lockstep_diagnostic>();
      detail::require(lockstep_project_diagnostic(it_.get(), i, &from));
      list[i] = {static_cast<Diagnostic::Severity>(from.severity),
                 from.file,
                 from.line,
                 from.column,
                 from.message,
                 from.hint};
    }
    return list;
  }

  std::vector<NodeInfo> nodes() const {
    std::vector<NodeInfo> list(lockstep_project_node_count(it_.get()));
    for (std::uint32_t i = 0; i < list.size(); ++i) {
      auto from = detail::sized<lockstep_node>();
      detail::require(lockstep_project_node(it_.get(), i, &from));
      list[i] = {i, from.parent, from.end, from.path, from.name, from.id};
    }
    return list;
  }
  // The node with this path: "Main/pull/arm".
  std::uint32_t find_node(const std::string& path) const {
    std::uint32_t index = 0;
    detail::require(lockstep_project_find_node(it_.get(), path.c_str(), &index));
    return index;
  }

  // The entry with this key: "height", or "Deliver/height" in a SubTree.
  EntryHandle find_entry(const std::string& key) const {
    EntryHandle entry;
    detail::require(lockstep_project_find_entry(it_.get(), key.c_str(), &entry.index));
    return entry;
  }

  lockstep_project* get() const { return it_.get(); }

 private:
  friend class Run;  // of this namespace, not that of leaf.hpp

  struct Free {
    void operator()(lockstep_project* project) const { lockstep_project_free(project); }
  };
  // The tables of the program's leaves.
  struct Leaves {
    lockstep_plugin plugin{};
    std::vector<std::unique_ptr<lockstep_leaf_type>> types;
    std::vector<const lockstep_leaf_type*> list;
  };

  Project& check(bool good) {
    detail::require(good);
    return *this;
  }

  void require_unloaded() const {
    if (load_tried_) throw Error("the project has been loaded already");
  }

  void add_leaves() {
    require_unloaded();
    load_tried_ = true;
    if (leaves_->types.empty()) return;
    lockstep_plugin& plugin = leaves_->plugin;
    plugin.abi_major = LOCKSTEP_ABI_MAJOR;
    plugin.abi_minor = LOCKSTEP_ABI_MINOR;
    plugin.struct_size = sizeof plugin;
    plugin.name = "program";
    leaves_->list.clear();
    for (const auto& type : leaves_->types) leaves_->list.push_back(type.get());
    plugin.leaf_type_count = static_cast<std::uint32_t>(leaves_->list.size());
    plugin.leaf_types = leaves_->list.data();
    check(lockstep_project_add_leaves(it_.get(), &plugin));
  }

  // "tree.xml:3:5: ", as much of it as is known.
  static std::string place_of(const Diagnostic& it) {
    if (it.file.empty()) return {};
    std::string place = it.file + ":";
    if (it.line != 0) place += std::to_string(it.line) + ":";
    if (it.column != 0) place += std::to_string(it.column) + ":";
    return place + " ";
  }

  void finish(bool good) const {
    if (good) return;
    std::string text = lockstep_last_error();
    if (text.find("diagnostics") == std::string::npos) throw Error(text);
    for (const Diagnostic& it : diagnostics()) {
      if (it.severity != Diagnostic::Severity::Error) continue;
      text += "\n" + place_of(it) + it.message + (it.hint.empty() ? "" : " (" + it.hint + ")");
    }
    throw Error(text);
  }

  std::shared_ptr<Leaves> leaves_ = std::make_shared<Leaves>();
  std::unique_ptr<lockstep_project, Free> it_;
  bool load_tried_ = false;
};

struct RunSettings {
  std::uint64_t seed = 0;      // of the leaves' random numbers
  double tick_period = 0.01;   // what leaves see as such, and the period of the loop, in seconds
  bool fail_on_fault = false;  // a fault of a leaf is its Failure, and the run continues
  // The times of ticks are not real: a tick waits for threaded leaves, whose sleeps are in the
  // run's time. For the loop with virtual_clock.
  bool virtual_time = false;
  // A line that a leaf logs; from any thread. Also what the run reports about a leaf: that it
  // reported a progress outside [0, 1], or that it failed and the run continues.
  std::function<void(const std::string& who, LogLevel level, const std::string& message)> log = {};
  // In seconds; 0: none. A call of a leaf that takes longer is reported with what leaves log.
  double tick_budget = 0;
  // In seconds; 0: none. A call of a leaf that lasts longer and has not returned is reported once,
  // in another thread; it continues.
  double hang_limit = 0;
  std::function<void(const std::string& who, const std::string& function, double seconds)> hang =
      {};
  // A leaf wants a tick before the next period; from any thread. For programs that wait in a loop
  // of their own.
  std::function<void()> wake = {};
};

enum class Overrun {
  Skip = LOCKSTEP_OVERRUN_SKIP,
  CatchUp = LOCKSTEP_OVERRUN_CATCH_UP,
  Fail = LOCKSTEP_OVERRUN_FAIL
};

struct LoopSettings {
  bool virtual_clock = false;   // time jumps to the next tick: as fast as possible
  std::uint64_t max_ticks = 0;  // 0: any number; on the virtual clock a million
  double timeout = 0;           // seconds; 0: none
  Overrun overrun = Overrun::Skip;
  // Called before each tick, and on the wall clock also while the loop waits for the next one.
  // True: stop; it is not called again then.
  std::function<bool()> stop = {};
};

struct LoopResult {
  enum class Reason {
    Completed = LOCKSTEP_COMPLETED,
    Fault = LOCKSTEP_FAULT,
    Timeout = LOCKSTEP_TIMEOUT,
    MaxTicks = LOCKSTEP_MAX_TICKS,
    Stopped = LOCKSTEP_STOPPED,
    Overrun = LOCKSTEP_OVERRUN
  };
  Reason reason = Reason::Completed;
  Status status = Status::Running;  // of the root after the last tick
  std::uint64_t ticks = 0, overruns = 0;
  double seconds = 0;
};

// How the state of a run is kept in a file, and resumed: docs/resume.md.
struct KeepSettings {
  bool resume = true;  // continue the run of the file, if it was cut
  // What leaves do that ran at the cut and cannot continue; nothing: they start again.
  std::optional<Status> on_resume = std::nullopt;
  std::uint32_t resume_limit = 3;  // in a row, without a leaf that completes
  double sync = 0.1;               // seconds: written through to the disk at most so often
  std::string version = {};        // of the program: a file of another one is refused
};

// A leaf that ran at the cut. `status`: Running, it continues; nothing, it starts again in its next
// tick; otherwise, its next tick has this result, without a call.
struct ResumedLeaf {
  std::uint32_t node = 0;
  std::optional<Status> status;
  bool asked = false;   // the leaf has decided so
  double progress = 0;  // of one that continues
};

struct Resumed {
  std::uint64_t ticks = 0;  // before the cut
  double seconds = 0;       // the time of the last of them: the times of ticks continue from here
  double gap = 0;           // seconds of the wall clock since then
  std::string text;         // "resumed after 35 s; 'Main/left' continues at 0.42"
  std::vector<ResumedLeaf> leaves;
};

// One run of a tree, with separate leaves. Used by one thread at a time, and not destroyed in a
// function that it calls.
class Run {
  using EntryName = detail::EntryName;

 public:
  explicit Run(const Project& project, RunSettings settings = {})
      : leaves_(project.leaves_), hooks_(std::make_unique<Hooks>()) {
    hooks_->log = std::move(settings.log);
    hooks_->hang = std::move(settings.hang);
    hooks_->wake = std::move(settings.wake);
    auto options = detail::sized<lockstep_run_options>();
    options.seed = settings.seed;
    options.tick_period = settings.tick_period;
    options.on_fault = settings.fail_on_fault ? LOCKSTEP_ON_FAULT_FAIL : LOCKSTEP_ON_FAULT_STOP;
    options.virtual_time = settings.virtual_time;
    options.tick_budget = settings.tick_budget;
    options.hang_limit = settings.hang_limit;
    if (hooks_->log) options.log = &Hooks::on_log;
    if (hooks_->hang) options.hang = &Hooks::on_hang;
    if (hooks_->wake) options.wake = &Hooks::on_wake;
    options.user = hooks_.get();
    it_.reset(lockstep_run_new(project.get(), &options));
    detail::require(it_ != nullptr);
    detail::require(lockstep_run_observe(it_.get(), &Hooks::on_tick, hooks_.get()));
  }
  Run(Run&&) noexcept = default;
  // The run that was here ends, as in the destructor: before what it calls back.
  Run& operator=(Run&& other) noexcept {
    it_ = std::move(other.it_);
    hooks_ = std::move(other.hooks_);
    leaves_ = std::move(other.leaves_);
    return *this;
  }

  // One tick, `seconds` after the run began. Throws an Error after a fault of a leaf, with the path
  // of the leaf, when everything that runs has been halted; and when nothing was ticked, since the
  // time is before that of the last tick, negative or no number: then the run may continue.
  Status tick(double seconds) {
    const auto status = static_cast<Status>(lockstep_run_tick(it_.get(), seconds));
    throw_refusal();
    throw_failures();
    return status;
  }
  // The same, but the root is ticked exactly once, also when a node requests another tick at once.
  Status tick_once(double seconds) {
    const auto status = static_cast<Status>(lockstep_run_tick_once(it_.get(), seconds));
    throw_refusal();
    throw_failures();
    return status;
  }
  // The loop of the run ticks at once, if it waits for its next period. From any thread.
  void wake() { lockstep_run_wake(it_.get()); }

  // Keeps the state of the run in a file, from before its first tick and before what watches it, to
  // its restart or the end of a loop. A run that was cut resumes from there; nothing: it is new.
  // Throws an Error when the file is of another run, or cannot be used: then the run is new and not
  // kept. And when a leaf has a fault.
  std::optional<Resumed> keep(const std::string& file, const KeepSettings& settings = {}) {
    auto options = detail::sized<lockstep_keep_options>();
    options.resume = settings.resume;
    options.on_resume = detail::status_or_idle(settings.on_resume);
    options.resume_limit = settings.resume_limit;
    options.sync = settings.sync;
    if (!settings.version.empty()) options.version = settings.version.c_str();
    auto from = detail::sized<lockstep_resumed>();
    detail::require(lockstep_run_keep(it_.get(), file.c_str(), &options, &from));
    throw_failures();
    if (!from.resumed) return std::nullopt;
    Resumed resumed{from.ticks, from.seconds, from.gap, from.text, {}};
    auto leaf = detail::sized<lockstep_resumed_leaf>();
    while (lockstep_run_resumed_leaf(it_.get(), static_cast<std::uint32_t>(resumed.leaves.size()),
                                     &leaf)) {
      resumed.leaves.push_back(
          {leaf.node, detail::status_of(leaf.status), leaf.asked, leaf.progress});
    }
    return resumed;
  }
  // Why nothing is kept any more, such as on a full disk; the run continues.
  std::optional<std::string> not_kept() const {
    const char* const why = lockstep_run_not_kept(it_.get());
    return why == nullptr ? std::nullopt : std::optional<std::string>(why);
  }

  // Lets others watch the run, each from before its first tick to its end: a file for `lockstep
  // replay` and `lockstep log`, browsers (the link is returned), Groot2 (after
  // Project::show_groot2). `address` is "8080", "0.0.0.0:8080", or "0" for a free port.
  void record(const std::string& file) {
    detail::require(lockstep_run_record(it_.get(), file.c_str()));
  }
  std::string monitor(const std::string& address) {
    const char* const link = lockstep_run_monitor(it_.get(), address.c_str());
    detail::require(link != nullptr);
    return link;
  }
  void groot2(const std::string& address) {
    detail::require(lockstep_run_groot2(it_.get(), address.c_str()));
  }

  // A property of the run (docs/properties.md), before its first tick.
  void check(const std::string& property) {
    detail::require(lockstep_run_check(it_.get(), property.c_str()));
  }
  // Those of the tree file.
  void check_properties_of_file() { detail::require(lockstep_run_check(it_.get(), nullptr)); }
  // The properties that are violated so far, and when.
  std::vector<std::string> violations() const {
    std::vector<std::string> list;
    for (std::uint32_t i = 0;; ++i) {
      const char* const text = lockstep_run_violation(it_.get(), i);
      if (text == nullptr) return list;
      list.emplace_back(text);
    }
  }

  // Halts every leaf that runs, in the order of the tree.
  void halt() {
    lockstep_run_halt(it_.get());
    throw_refusal();
  }
  // After a fault, when tick has thrown: the next tick begins the tree, with the entries and the
  // leaves as they are.
  void recover() { detail::require(lockstep_run_recover(it_.get())); }
  // Begins again, as a new run with this seed would.
  void restart(std::uint64_t seed) { detail::require(lockstep_run_restart(it_.get(), seed)); }
  // Ticks at the run's period until the tree completes or must stop. What on_tick or `stop` throws
  // ends it, in order, and is thrown then.
  LoopResult loop(const LoopSettings& settings = {}) {
    auto options = detail::sized<lockstep_loop_options>();
    options.virtual_clock = settings.virtual_clock;
    options.max_ticks = settings.max_ticks;
    options.timeout = settings.timeout;
    options.overrun = static_cast<std::int32_t>(settings.overrun);
    Stop stop{*hooks_, settings.stop};
    options.stop = &Stop::is_asked;
    options.user = &stop;
    auto result = detail::sized<lockstep_loop_result>();
    detail::require(lockstep_run_loop(it_.get(), &options, &result));
    rethrow();
    return {static_cast<LoopResult::Reason>(result.reason), static_cast<Status>(result.status),
            result.ticks, result.overruns, result.seconds};
  }

  // "Main/arm: threw an exception: …"; nothing while there is none.
  std::optional<std::string> fault() const {
    const char* const text = lockstep_run_fault(it_.get(), nullptr);
    if (text == nullptr) return std::nullopt;
    return text;
  }
  NodeState node(std::uint32_t index) const {
    auto state = detail::sized<lockstep_node_state>();
    detail::require(lockstep_run_node(it_.get(), index, &state));
    return {detail::status_of(state.status), state.progress, state.held, state.ticked};
  }

  // What a node asks a person at this moment; nothing: it asks nothing. And the answer, one of its
  // options, which counts in the next tick.
  std::optional<std::string> question(std::uint32_t index) const {
    const char* const text = lockstep_run_question(it_.get(), index);
    return text == nullptr ? std::nullopt : std::optional<std::string>(text);
  }
  void answer(std::uint32_t index, const std::string& answer, const std::string& who = "program") {
    detail::require(lockstep_run_answer(it_.get(), index, answer.c_str(), who.c_str()));
  }

  // An entry of the blackboard, by key, "height" or "Deliver/height", or by the handle that
  // Project::find_entry gives, which saves the search: a bool, std::int64_t, double, a std::vector
  // of one of these or of std::string, or as text (std::string), which works for every type, also
  // for objects whose type has texts. get throws while nothing has written the entry. A whole
  // number is also a double.
  template <class T>
  T get(const EntryName& entry) const;
#define LOCKSTEP_ROW(TYPE, of_type, Item)                                             \
  void set(const EntryName& entry, Item value) {                                      \
    write(entry, lockstep_run_set_##of_type, lockstep_run_set_##of_type##_at, value); \
  }
  LOCKSTEP_PLAIN_TYPES(LOCKSTEP_ROW)
#undef LOCKSTEP_ROW
  // A whole number, also where the entry has a real one.
  template <class T, std::enable_if_t<std::is_integral_v<T>, int> = 0>
  void set(const EntryName& entry, T value) {
    if constexpr (std::is_unsigned_v<T> && sizeof(T) == sizeof(std::int64_t)) {
      if (value > static_cast<T>(INT64_MAX)) throw Error("a number is too large for an entry");
    }
    set(entry, static_cast<std::int64_t>(value));
  }
  void set(const EntryName& entry, const std::string& text) {
    write(entry, lockstep_run_set_sized_text, lockstep_run_set_sized_text_at, text.data(),
          text.size());
  }
  void set(const EntryName& entry, const char* text) {
    set(entry, std::string(text));
  }
#define LOCKSTEP_ROW(TYPE, of_type, Item)                                                   \
  void set(const EntryName& entry, const std::vector<Item>& values) {                       \
    write_list(entry, lockstep_run_set_##of_type, lockstep_run_set_##of_type##_at, values); \
  }
  LOCKSTEP_LIST_TYPES(LOCKSTEP_ROW)
#undef LOCKSTEP_ROW
  void set(const EntryName& entry, const std::vector<std::string>& values) {
    std::vector<lockstep_text> texts;
    for (const std::string& text : values) texts.push_back({text.data(), text.size()});
    write(entry, lockstep_run_set_text_list, lockstep_run_set_text_list_at, texts.data(),
          texts.size());
  }

  // An object by reference, of a type that LOCKSTEP_OBJECT_TYPE names, as the ports of plugins have
  // it. Throws when the entry has another type, or its objects are in another process.
  template <class T>
  void set(const EntryName& entry, const std::shared_ptr<T>& object) {
    if (object == nullptr) throw Error("an object is null");
    auto* const holder = new lockstep::detail::ObjectHolder<std::remove_const_t<T>>{object};
    const bool is_set = entry.call(lockstep_run_set_object, lockstep_run_set_object_at, it_.get(),
                                   object_type<T>(), static_cast<void*>(holder));
    object_type<T>()->release(holder);
    detail::require(is_set);
  }
  template <class T>
  std::shared_ptr<const T> get_object(const EntryName& entry) const {
    const void* const object = entry.call(lockstep_run_get_object, lockstep_run_get_object_at,
                                          it_.get(), object_type<T>());
    detail::require(object != nullptr);
    return static_cast<const lockstep::detail::ObjectHolder<T>*>(object)->value;
  }

  // Called after each tick, also of the loop, with the tick's number from 0, its time and the
  // status of the root. It may read the run, and must not tick or halt it. Called in such a
  // function, it takes effect with the next tick.
  void on_tick(std::function<void(std::uint64_t tick, double seconds, Status status)> observe) {
    hooks_->observers.push_back(std::move(observe));
  }

  lockstep_run* get() const {
    return it_.get();
  }

 private:
  template <class T>
  static constexpr const lockstep_object_type* object_type() {
    return &lockstep::detail::kObjectTable<std::remove_const_t<T>>;
  }
  template <class ByKey, class ByIndex, class... Rest>
  void write(const EntryName& entry, ByKey by_key, ByIndex by_index, Rest... value) {
    detail::require(entry.call(by_key, by_index, it_.get(), value...));
  }
  template <class Item, class ByKey, class ByIndex>
  void write_list(const EntryName& entry, ByKey by_key, ByIndex by_index,
                  const std::vector<Item>& values) {
    write(entry, by_key, by_index, values.data(), values.size());
  }
  template <class ByKey, class ByIndex>
  void write_list(const EntryName& entry, ByKey by_key, ByIndex by_index,
                  const std::vector<bool>& values) {
    const std::unique_ptr<bool[]> flags(new bool[values.size()]);  // NOLINT: std::vector has none
    std::copy(values.begin(), values.end(), flags.get());
    write(entry, by_key, by_index, flags.get(), values.size());
  }
  template <class T, class ByKey, class ByIndex>
  T read(const EntryName& entry, ByKey by_key, ByIndex by_index) const {
    T value{};
    detail::require(entry.call(by_key, by_index, it_.get(), &value));
    return value;
  }
  template <class Item, class ByKey, class ByIndex>
  std::vector<Item> read_list(const EntryName& entry, ByKey by_key, ByIndex by_index) const {
    const Item* values = nullptr;
    std::size_t count = 0;
    detail::require(entry.call(by_key, by_index, it_.get(), &values, &count));
    return std::vector<Item>(values, values + count);
  }

  // The functions that the C interface calls back. No exception may pass through it: it is kept and
  // thrown after the tick, or the loop, which it ends.
  struct Hooks {
    decltype(RunSettings::log) log;
    decltype(RunSettings::hang) hang;
    decltype(RunSettings::wake) wake;
    std::deque<std::function<void(std::uint64_t, double, Status)>> observers;  // they do not move
    std::exception_ptr thrown;

    static void on_hang(void* self, const char* who, const char* function, double seconds) {
      lockstep::detail::catching([&] { static_cast<Hooks*>(self)->hang(who, function, seconds); },
                                 [](const char*) {});
    }
    static void on_wake(void* self) {
      lockstep::detail::catching([&] { static_cast<Hooks*>(self)->wake(); }, [](const char*) {});
    }

    static void on_log(void* self, const char* who, lockstep_log_level level, const char* text) {
      lockstep::detail::catching(
          [&] { static_cast<Hooks*>(self)->log(who, static_cast<LogLevel>(level), text); },
          [](const char*) {});
    }
    static void on_tick(void* self, lockstep_run*, std::uint64_t tick, double seconds,
                        lockstep_status status) {
      auto& hooks = *static_cast<Hooks*>(self);
      try {
        const std::size_t count = hooks.observers.size();  // one of them may add others
        for (std::size_t i = 0; i < count; ++i) {
          hooks.observers[i](tick, seconds, static_cast<Status>(status));
        }
      } catch (...) {
        hooks.thrown = std::current_exception();
      }
    }
  };
  // Of a loop.
  struct Stop {
    Hooks& hooks;
    const std::function<bool()>& stop;

    static bool is_asked(void* self) {
      const Stop& it = *static_cast<Stop*>(self);
      try {
        return it.hooks.thrown != nullptr || (it.stop && it.stop());
      } catch (...) {
        it.hooks.thrown = std::current_exception();
        return true;
      }
    }
  };
  struct Free {
    void operator()(lockstep_run* run) const { lockstep_run_free(run); }
  };

  // Throws the error of a function that has no other result.
  static void throw_refusal() {
    const char* const why = lockstep_last_error();
    if (*why != '\0') throw Error(why);
  }
  void rethrow() {
    if (hooks_->thrown) std::rethrow_exception(std::exchange(hooks_->thrown, nullptr));
  }
  void throw_failures() {
    rethrow();
    const auto reason = fault();
    if (!reason) return;
    halt();
    throw Error(*reason);
  }

  std::shared_ptr<void> leaves_;  // outlive the run
  std::unique_ptr<Hooks> hooks_;
  std::unique_ptr<lockstep_run, Free> it_;
};

#define LOCKSTEP_ROW(TYPE, of_type, Item)                                                  \
  template <>                                                                              \
  inline Item Run::get<Item>(const EntryName& entry) const {                               \
    return read<Item>(entry, lockstep_run_get_##of_type, lockstep_run_get_##of_type##_at); \
  }
LOCKSTEP_PLAIN_TYPES(LOCKSTEP_ROW)
#undef LOCKSTEP_ROW
// NOLINTBEGIN(bugprone-macro-parentheses): it is a type
#define LOCKSTEP_ROW(TYPE, of_type, Item)                                                       \
  template <>                                                                                   \
  inline std::vector<Item> Run::get<std::vector<Item>>(const EntryName& entry) const {          \
    return read_list<Item>(entry, lockstep_run_get_##of_type, lockstep_run_get_##of_type##_at); \
  }
LOCKSTEP_LIST_TYPES(LOCKSTEP_ROW)
#undef LOCKSTEP_ROW
// NOLINTEND(bugprone-macro-parentheses)
template <>
inline std::string Run::get<std::string>(const EntryName& entry) const {
  const auto text =
      read<lockstep_text>(entry, lockstep_run_get_sized_text, lockstep_run_get_sized_text_at);
  return {text.text, text.length};
}
template <>
inline std::vector<std::string> Run::get<std::vector<std::string>>(const EntryName& entry) const {
  std::vector<std::string> texts;
  const auto views =
      read_list<lockstep_text>(entry, lockstep_run_get_text_list, lockstep_run_get_text_list_at);
  for (const lockstep_text& it : views) texts.emplace_back(it.text, it.length);
  return texts;
}

}  // namespace lockstep::runtime
