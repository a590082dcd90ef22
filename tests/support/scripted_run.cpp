#include "support/scripted_run.h"

#include <map>
#include <sstream>
#include <stdexcept>

#include "base/system/call_mark.h"
#include "support/tree_text.h"

namespace lockstep::host::test {
namespace {

std::map<std::string, LeafScript> scripts(std::string_view text) {
  std::map<std::string, LeafScript> scripts;
  std::istringstream words{std::string(text)};
  for (std::string word; words >> word;) {
    const auto end = word.find_first_of("=+");
    if (end == std::string::npos) throw std::invalid_argument("leaves: what is '" + word + "'?");
    const auto script = word.substr(word[end] == '=' ? end + 1 : end);
    scripts[word.substr(0, end)] = parse_leaf_script(script);
  }
  return scripts;
}

// Of each leaf.
const CallSite& site = CallSite::of({.path = "leaf", .id = "Scripted", .plugin = "test"});

}  // namespace

ScriptedRun::ScriptedRun(std::string_view tree, std::string_view leaves, FaultPolicy policy,
                         const LanguageRules& rules)
    : ScriptedRun(tree_from_text(tree, rules), leaves, policy) {}

ScriptedRun::ScriptedRun(Tree tree, std::string_view leaves, FaultPolicy policy, LeafWatch* watch)
    : tree_(std::move(tree)),
      board_(tree_),
      slots_(tree_.leaves.size(), {.site = &site}),
      plugin_nodes_(tree_, board_, slots_),
      ticker_(tree_, slots_, board_, policy, watch) {
  plugin_nodes_.set_node_context(ticker_);
  const auto by_name = scripts(leaves);
  for (std::uint32_t number = 0; number < slots_.size(); ++number) {
    if (slots_[number].self != nullptr) continue;
    const auto script = by_name.find(leaf_name(number));
    if (script == by_name.end()) {
      throw std::invalid_argument("no script for leaf '" + leaf_name(number) + "'");
    }
    LeafSlot& slot = slots_[number];
    leaves_.emplace_back(script->second, number, &tree_tick_, &events,
                         [this, &slot](const char* reason) {
                           slot.set_error(reason);
                           ticker_.note_error();
                         });
    slot.type = tree_.leaves[number].type->leaf;
    slot.self = &leaves_.back();
  }
}

std::string ScriptedRun::leaf_name(std::uint32_t leaf) const {
  return std::string(tree_.labels[tree_.leaves[leaf].node].name);
}

Entry& ScriptedRun::entry(std::string_view key) {
  for (std::size_t slot = 0; slot < tree_.slots.size(); ++slot) {
    if (tree_.slots[slot].name == key) return board_.entries[slot];
  }
  throw std::invalid_argument("no entry '" + std::string(key) + "'");
}

void ScriptedRun::set(std::string_view key, Value value) {
  entry(key).assign(std::move(value));
}

std::string ScriptedRun::text_of(std::string_view key) {
  return to_text(entry(key).value());
}

Status ScriptedRun::tick_root(Nanoseconds now) {
  ++tree_tick_;
  plugin_nodes_.time.now = now;
  Status status = ticker_.tick_root(now);
  // Some trees for BehaviorTree.CPP ask again and again. Run ends there with an error.
  constexpr int kMostTicksAtOnce = 1000;
  for (int ticks = 1; ticks < kMostTicksAtOnce; ++ticks) {
    if (!ticker_.take_request() || status != Status::Running) break;
    status = ticker_.tick_root_again();
  }
  return status;
}

Status ScriptedRun::tick(Nanoseconds now) {
  const Status status = tick_root(now);
  if (ticker_.fault() != nullptr) ticker_.halt_all();
  return status;
}

ScriptedRun::Saved ScriptedRun::save() const {
  Saved saved{.engine = {}, .leaves = leaves_, .tree_tick = tree_tick_};
  ticker_.save(saved.engine);
  return saved;
}

void ScriptedRun::restore(const Saved& from) {
  ticker_.restore(from.engine);
  leaves_ = from.leaves;  // each stays where it is
  tree_tick_ = from.tree_tick;
}

void ScriptedRun::go_on_as(const Saved& from) {
  ticker_.restore(from.engine);
  for (std::size_t i = 0; i < leaves_.size(); ++i) leaves_[i].go_on_as(from.leaves[i]);
  tree_tick_ = from.tree_tick;
}

void ScriptedRun::restart() {
  ticker_.halt_all();
  board_.reset(tree_);
  ticker_.reset();
  plugin_nodes_.restart();
  for (ScriptedLeaf& leaf : leaves_) leaf.rewind();
  for (LeafSlot& slot : slots_) slot.set_error(nullptr);
  events.clear();
  tree_tick_ = 0;
}

}  // namespace lockstep::host::test
