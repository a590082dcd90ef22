#include "tree_run.hpp"

#include <algorithm>
#include <stdexcept>

namespace lockstep_ros {
namespace {

using lockstep::Status;
using lockstep::runtime::Error;
using lockstep::runtime::LoopResult;
using Tell = std::function<void(const msg::TreeState&)>;

std::string word_of(std::optional<Status> status) {
  if (status == Status::Running) return "running";
  if (status == Status::Success) return "success";
  return status == Status::Failure ? "failure" : "idle";
}

std::string file_of(const std::string& tree, const std::string& directory) {
  if (tree.empty()) throw Error("the goal names no tree");
  return tree.front() == '/' ? tree : directory + "/" + tree;
}

}  // namespace

TreeRun::TreeRun(const Goal& goal, const TreeSettings& settings)
    : name_(goal.tree),
      settings_(settings),
      project_(std::make_shared<lockstep::runtime::Project>()) {
  for (const std::string& path : settings.plugin_path) project_->add_plugin_path(path);
  for (const std::string& argument : goal.arguments) {
    const auto equals = argument.find('=');
    if (equals == std::string::npos) {
      throw Error("the argument '" + argument + "' has no '=': NAME=VALUE");
    }
    project_->set_argument(argument.substr(0, equals), argument.substr(equals + 1));
  }
  if (!goal.main_tree.empty()) project_->set_main_tree(goal.main_tree);
  project_->load_file(file_of(goal.tree, settings.trees));
  nodes_ = project_->nodes();
  lockstep::runtime::RunSettings of_run;
  of_run.tick_period = settings.period;
  of_run.log = settings.log;
  run_ = std::make_unique<lockstep::runtime::Run>(*project_, of_run);
}

void TreeRun::observe(const Tell& tell) {
  run_->on_tick([this, tell](std::uint64_t tick, double seconds, Status status) {
    ticks_ = tick + 1;
    seconds_ = seconds;
    if (status == Status::Failure) last_failure_ = failed_leaf();
    if (seconds < next_told_ && status == Status::Running) return;
    next_told_ = seconds + settings_.told_each;
    tell(state(tick, seconds, status));
  });
}

TreeRun::Result TreeRun::loop(const std::function<bool()>& stop, const Tell& tell) {
  observe(tell);
  lockstep::runtime::LoopSettings of_loop;
  of_loop.stop = stop;
  const LoopResult ended = run_->loop(of_loop);
  return result(ended.reason == LoopResult::Reason::Stopped, ended.status);
}

TreeRun::Result TreeRun::loop(const std::function<double(double)>& wait, const Tell& tell) {
  observe(tell);
  double next = 0;
  Status status = Status::Running;
  while (status == Status::Running) {
    const double now = wait(next);
    if (now < 0) break;
    try {
      status = run_->tick(std::max(now, seconds_));
    } catch (const Error&) {
      if (run_->fault()) break;
      throw;
    }
    next = std::max(next, now) + settings_.period;
  }
  return result(status == Status::Running, status);
}

TreeRun::Result TreeRun::result(bool is_stopped, Status status) const {
  Result result;
  result.ticks = ticks_;
  result.seconds = static_cast<float>(seconds_);
  const auto fault = run_->fault();
  run_->halt();
  result.status = fault ? "fault" : is_stopped ? "halted" : word_of(status);
  if (fault) result.reason = *fault;
  if (!fault && status == Status::Failure) result.reason = last_failure_;
  return result;
}

msg::TreeState TreeRun::state(std::uint64_t tick, double seconds, Status status) const {
  msg::TreeState state;
  state.tree = name_;
  state.tick = tick;
  state.seconds = static_cast<float>(seconds);
  state.status = word_of(status);
  std::uint32_t held_until = 0;  // what is below a node that is held is held with it
  for (const auto& node : nodes_) {
    const auto now = run_->node(node.index);
    const auto progress = static_cast<float>(now.progress);
    if (node.index == 0) state.progress = progress;
    if (now.held && node.index >= held_until) {
      held_until = node.end;
      auto& held = state.held.emplace_back();
      held.path = node.path;
      held.by = holder_of(node.index);
      held.progress = progress;
    }
    if (now.status != Status::Running || node.end != node.index + 1) continue;
    auto& running = state.running.emplace_back();
    running.path = node.path;
    running.status = "running";
    running.progress = progress;
  }
  return state;
}

std::string TreeRun::holder_of(std::uint32_t held) const {
  constexpr const char* kHolders[] = {"ParallelAbsolute", "ParallelRelative", "SyncProgress",
                                      "UseResources"};
  for (std::uint32_t at = nodes_[held].parent;; at = nodes_[at].parent) {
    const auto* const end = std::end(kHolders);
    if (std::find(std::begin(kHolders), end, nodes_[at].id) != end) return nodes_[at].path;
    if (at == 0) return nodes_[nodes_[held].parent].path;
  }
}

// The last leaf, in the order of the tree, that was ticked and failed.
std::string TreeRun::failed_leaf() const {
  std::string path;
  for (const auto& node : nodes_) {
    if (node.end != node.index + 1) continue;
    const auto now = run_->node(node.index);
    if (now.ticked && now.status == Status::Failure) path = node.path;
  }
  return path;
}

}  // namespace lockstep_ros
