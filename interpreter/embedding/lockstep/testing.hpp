// lockstep/testing.hpp: tests of trees in C++17, for Catch2, GoogleTest or any other framework.
// Header only, over lockstep/runtime.hpp; link lockstep::runtime. docs/testing.md is the manual. A
// tree is loaded without its plugins, and each of its leaves does what the test declares:
//
//   TEST_CASE("the arm slips") {
//     lockstep::testing::TreeTest tree("door.xml");
//     tree.leaf("arm", "R.25 R.5 F");
//     tree.check("arm.failure leads to base.idle within 0 ticks");
//     CHECK(tree.run() == lockstep::Status::Failure);
//     CHECK(tree.ticks() == 11);
//     CHECK(tree.violations().empty());
//   }
//
// Time is virtual: a test of an hour takes milliseconds, and is the same each time. Errors, as a
// leaf that is not there, are exceptions of type lockstep::runtime::Error. A TreeTest is used by
// one thread.
#pragma once

#include <cstdint>
#include <functional>
#include <lockstep/runtime.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lockstep::testing {

using NamedText = std::pair<std::string, std::string>;

struct Settings {
  double rate = 10;                       // Hz
  std::vector<NamedText> arguments = {};  // of <arg>
  std::vector<NamedText> values = {};     // start values of entries, written as in XML
  std::string main_tree = {};             // which <BehaviorTree>; "": that of the file
  std::vector<std::string> plugin_paths = {};
  std::uint64_t seed = 0;
};

class TreeTest {
 public:
  // The properties of the tree file are also checked.
  explicit TreeTest(const std::string& file, const Settings& settings = {}) : settings_(settings) {
    prepare();
    project_.load_file(file);
    begin();
  }
  static TreeTest from_text(const std::string& text, const Settings& settings = {}) {
    return TreeTest(settings, text);
  }

  // The results of a leaf, tick by tick: R.25 (running, with its progress), S, F, K (skipped), X (a
  // fault), S[port=value]. The last word stays. `path` is the path of the leaf or the end of it;
  // * stands for any part. Leaves without a call succeed at once. Before the first tick.
  TreeTest& leaf(const std::string& path, const std::string& words) {
    require_unbegun();
    play(path, [&](const std::string& full) { project_.play(full, words); });
    return *this;
  }
  // The same, from the first word on in each activation.
  TreeTest& leaf_each(const std::string& path, const std::string& words) {
    require_unbegun();
    play(path, [&](const std::string& full) { project_.play_each(full, words); });
    return *this;
  }
  // A property (docs/properties.md) of all ticks. Before the first one.
  TreeTest& check(const std::string& property) {
    require_unbegun();
    properties_.push_back(property);
    return *this;
  }
  // The value of an entry, before or between ticks.
  template <class T>
  TreeTest& set(const std::string& key, const T& value) {
    begun().set(key, value);
    if (ticks_ == 0) first_values_.push_back([=](runtime::Run& run) { run.set(key, value); });
    return *this;
  }
  template <class T>
  T get(const std::string& key) {
    return begun().template get<T>(key);
  }

  // One tick. After a result or a fault nothing is ticked any more.
  Status tick() {
    if (is_over()) return *status_;
    runtime::Run& run = begun();
    const double time = static_cast<double>(ticks_) / settings_.rate;
    try {
      status_ = run.tick(time);
    } catch (const runtime::Error& error) {
      if (!run.fault()) throw;
      fault_ = error.what();
      status_ = Status::Running;
    }
    ++ticks_;
    return *status_;
  }
  // Until the tree has a result or a fault, at most so many ticks more.
  Status run(std::uint64_t most_ticks = 10'000) {
    for (; most_ticks > 0 && !is_over(); --most_ticks) tick();
    return status_.value_or(Status::Running);
  }

  // The status of the root; Running also before the first tick and after a fault.
  Status status() const { return status_.value_or(Status::Running); }
  bool is_over() const { return fault_ || (status_ && *status_ != Status::Running); }
  std::uint64_t ticks() const { return ticks_; }
  double seconds() const { return static_cast<double>(ticks_) / settings_.rate; }
  // The fault that has ended it; "" for none.
  std::string fault() const { return fault_.value_or(""); }

  // A node, by its path or the end of it: status (nothing: idle), progress, held, ticked.
  runtime::NodeState node(const std::string& path) { return begun().node(find(path)); }
  // The properties that are violated, and when.
  std::vector<std::string> violations() { return begun().violations(); }
  // A recording for `lockstep replay` and `lockstep log`. Before the first tick.
  TreeTest& record(const std::string& file) {
    require_unbegun();
    recording_ = file;
    return *this;
  }

 private:
  TreeTest(const Settings& settings, const std::string& text) : settings_(settings) {
    prepare();
    project_.load_text(text);
    begin();
  }

  void prepare() {
    project_.play_leaves();
    for (const auto& it : settings_.arguments) project_.set_argument(it.first, it.second);
    for (const auto& it : settings_.values) project_.set_value(it.first, it.second);
    for (const auto& it : settings_.plugin_paths) project_.add_plugin_path(it);
    if (!settings_.main_tree.empty()) project_.set_main_tree(settings_.main_tree);
  }
  void begin() {
    nodes_ = project_.nodes();
    for (const runtime::NodeInfo& it : nodes_) {
      if (it.end == it.index + 1) play_if_leaf(it.path, "S");
    }
  }
  // A built-in node without children is no leaf that can play.
  void play_if_leaf(const std::string& path, const std::string& words) {
    if (lockstep_project_play(project_.get(), path.c_str(), words.c_str(), false)) {
      leaves_.push_back(path);
    }
  }

  // The run, which is made at its first use.
  runtime::Run& begun() {
    if (run_) return *run_;
    runtime::RunSettings settings;
    settings.seed = settings_.seed;
    settings.tick_period = 1 / settings_.rate;
    settings.virtual_time = true;
    run_.emplace(project_, std::move(settings));
    run_->check_properties_of_file();
    for (const std::string& it : properties_) run_->check(it);
    for (const auto& set : first_values_) set(*run_);
    if (!recording_.empty()) run_->record(recording_);
    return *run_;
  }
  void require_unbegun() {
    if (ticks_ != 0) throw runtime::Error("the tree has been ticked already");
    run_.reset();
  }

  static bool ends_in(const std::string& path, const std::string& name) {
    if (path == name) return true;
    return path.size() > name.size() && path[path.size() - name.size() - 1] == '/' &&
           path.compare(path.size() - name.size(), name.size(), name) == 0;
  }
  template <class Play>
  void play(const std::string& path, Play play_path) {
    if (path.find('*') != std::string::npos) return play_path(path);
    std::string found;
    for (const std::string& it : leaves_) {
      if (!ends_in(it, path)) continue;
      if (!found.empty()) {
        throw runtime::Error("'" + path + "' is the end of several paths: " + found + ", " + it);
      }
      found = it;
    }
    play_path(found.empty() ? path : found);  // which lists the paths
  }
  std::uint32_t find(const std::string& path) const {
    const runtime::NodeInfo* found = nullptr;
    for (const runtime::NodeInfo& it : nodes_) {
      if (!ends_in(it.path, path)) continue;
      if (found != nullptr) {
        throw runtime::Error("'" + path + "' is the end of several paths: " + found->path + ", " +
                             it.path);
      }
      found = &it;
    }
    return found != nullptr ? found->index : project_.find_node(path);
  }

  Settings settings_;
  runtime::Project project_;
  std::vector<runtime::NodeInfo> nodes_;
  std::vector<std::string> leaves_;  // the paths of those that play
  std::vector<std::string> properties_;
  std::vector<std::function<void(runtime::Run&)>> first_values_;
  std::string recording_;
  std::optional<runtime::Run> run_;
  std::optional<Status> status_;
  std::optional<std::string> fault_;
  std::uint64_t ticks_ = 0;
};

}  // namespace lockstep::testing
