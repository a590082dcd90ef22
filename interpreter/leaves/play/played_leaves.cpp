#include "leaves/play/played_leaves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/core/any_value.h"
#include "base/core/deadlines.h"
#include "base/core/suggest.h"
#include "base/core/time_progress.h"
#include "base/core/wording.h"
#include "leaves/model_leaf.h"
#include "leaves/plugin/contract/entry_value.h"
#include "leaves/plugin/contract/host.h"

namespace lockstep::host {
namespace {

using Kind = LeafWord::Kind;

// Its words in order; what it does behind the last one is what that says.
class PlayedLeaf final : public RemoteLeaf {
 public:
  // Null: it has no words. Zero: the first word is due at once.
  PlayedLeaf(const lockstep_caller& caller, const std::vector<LeafWord>* words, bool restarts,
             Nanoseconds time, const Deadlines& deadlines, PlayedLeafWatch* watch)
      : RemoteLeaf(caller),
        words_(words),
        restarts_(restarts),
        time_(time),
        deadlines_(deadlines),
        watch_(watch) {}

  void start() override {
    if (watch_ != nullptr) watch_->begins(caller_);
    if (is_held_) pass_held_words();  // until its process was cut
    is_held_ = false;
    progress_ = 0;
    is_first_ = true;
    began_ = caller_.time->now;
    if (restarts_) at_ = 0;
    // A value that it writes at its start is there before other nodes look.
    const LeafWord* const word = current();
    if (word != nullptr && time_.count() == 0) write(*word);
  }

  lockstep_status tick() override {
    const LeafWord* const word = current();
    if (word == nullptr) return is_condition() ? LOCKSTEP_FAILURE : LOCKSTEP_RUNNING;
    if (time_.count() > 0) {
      if (passed() < time_) return LOCKSTEP_RUNNING;
      write(*word);
    } else if (!std::exchange(is_first_, false)) {
      write(*word);
    }
    if (at_ + 1 < words_->size()) ++at_;
    if (word->kind == Kind::Fault) {
      fail("fails as a program, which the leaf model allows");
      return LOCKSTEP_FAILURE;
    }
    if (word->kind == Kind::Held) {
      fail(fmt::format("gets a tick, but its next word is {}: a tick that is withheld",
                       to_text(*word)));
      return LOCKSTEP_FAILURE;
    }
    progress_ = word->progress;
    return static_cast<lockstep_status>(word->status);
  }
  void halt() override {
    if (is_held_) pass_held_words();
    is_held_ = false;
  }
  void pause() override {
    is_held_ = true;
    held_since_ = caller_.time->now;
  }
  void resume() override {
    progress_ = progress();
    pass_held_words();
    began_ += caller_.time->now - held_since_;
    is_held_ = false;
  }
  // While it is held it may drift, by a word in each tick.
  double progress() override {
    if (time_.count() > 0) return progress_of_time(passed(), time_, deadlines_);
    const std::size_t count = is_held_ ? held_words() : 0;
    return count == 0 ? progress_ : (*words_)[at_ + count - 1].progress;
  }
  // The words of a recording are what the leaf did with its factors, so it accepts them again. A
  // leaf with a time, or with the same words in each activation, does not depend on the factor.
  double set_pace(double factor) override {
    return words_ == nullptr || restarts_ || time_.count() > 0 ? 1 : factor;
  }
  void end() override {}
  std::string trouble() override { return {}; }

 private:
  bool is_condition() const { return caller_.type->category == NodeCategory::Condition; }

  const LeafWord* current() const {
    return words_ == nullptr || words_->empty() ? nullptr : &(*words_)[at_];
  }

  // Since it began, without what it was held: as many periods as a Wait counts.
  Nanoseconds passed() const {
    return deadlines_.between(began_, is_held_ ? held_since_ : caller_.time->now);
  }

  // So many of the words for held ticks have come.
  std::size_t held_words() const {
    if (words_ == nullptr) return 0;
    const Nanoseconds held = caller_.time->now - held_since_;
    const auto ticks = std::llround(to_seconds(held) / to_seconds(caller_.time->period));
    std::size_t count = 0;
    while (static_cast<std::int64_t>(count) < ticks && at_ + count < words_->size() &&
           (*words_)[at_ + count].kind == Kind::Held) {
      ++count;
    }
    return count;
  }

  void pass_held_words() {
    for (std::size_t count = held_words(); count > 0 && at_ + 1 < words_->size(); --count) ++at_;
  }

  void write(const LeafWord& word) {
    for (const auto& [name, text] : word.written) {
      for (const BoundPort* const port : caller_.ports) {
        if (port->name() != name || port->write == nullptr) continue;
        auto value = value_from_outside(port->is_generic, port->type, text);
        if (!value) continue;
        if (write_entry(*port->write, port->type, port->object(), std::move(*value))) continue;
        fail(fmt::format("port '{}': {}", name, refusal_of(*port->write, port->entry, port->type)));
      }
    }
  }

  const std::vector<LeafWord>* const words_;
  const bool restarts_;  // with its first word, in each activation
  const Nanoseconds time_;
  const Deadlines deadlines_;
  PlayedLeafWatch* const watch_;
  std::size_t at_ = 0;  // the next word
  double progress_ = 0;
  bool is_first_ = false;  // the next tick is the first of the activation
  bool is_held_ = false;
  Nanoseconds began_{0}, held_since_{0};
};

// Null: it has no script.
std::unique_ptr<PlayedLeaf> find_script(const LeafScripts& scripts, const lockstep_caller& caller,
                                        PlayedLeafWatch* watch) {
  const auto words = scripts.leaves.find(caller.run->tree->path(caller.node));
  if (words == scripts.leaves.end()) return nullptr;
  const auto time = scripts.times.find(words->first);
  return std::make_unique<PlayedLeaf>(caller, &words->second,
                                      scripts.restarting.contains(words->first),
                                      time == scripts.times.end() ? Nanoseconds(0) : time->second,
                                      scripts.rate ? Deadlines(*scripts.rate) : Deadlines(), watch);
}

class PlayedRun final : public RemoteRun {
 public:
  PlayedRun(const LeafScripts& scripts, PlayedLeafWatch* watch)
      : scripts_(scripts), watch_(watch) {}

  std::unique_ptr<RemoteLeaf> create(const lockstep_caller& caller) override {
    auto leaf = find_script(scripts_, caller, watch_);
    return leaf != nullptr ? std::move(leaf)
                           : std::make_unique<PlayedLeaf>(caller, nullptr, false, Nanoseconds(0),
                                                          Deadlines(), watch_);
  }

 private:
  const LeafScripts& scripts_;
  PlayedLeafWatch* const watch_;
};

// --- by chance -----------------------------------------------------------------------------------

class RandomAnswers final : public Answers {
 public:
  explicit RandomAnswers(const lockstep_caller& caller) : caller_(caller) {}
  std::uint32_t choose(std::uint32_t count, std::uint32_t) override {
    return static_cast<std::uint32_t>(host_table().random(&caller_) * count);
  }
  std::uint32_t draw(std::span<const double> chances, std::uint32_t) override {
    return drawn(chances, host_table().random(&caller_));
  }

 private:
  const lockstep_caller& caller_;
};

// All leaves of a run without a script. Its tick begins with the first call at another time.
class ModelRun final : public RemoteRun {
 public:
  ModelRun(const lockstep_caller& caller, const Tree& tree, const LeafModels& models,
           const LeafScripts& scripts, PlayedLeafWatch* watch)
      : scripts_(scripts),
        watch_(watch),
        caller_(caller),
        answers_(caller),
        callers_(tree.leaves.size()),
        leaves_(
            tree, models,
            [this](std::uint32_t leaf, const LeafModel::Output& output) {
              return callers_[leaf]->ports[output.port]->write;
            },
            answers_) {
    for (std::uint32_t i = 0; i < tree.leaves.size(); ++i) numbers_[tree.leaves[i].node] = i;
  }

  std::unique_ptr<RemoteLeaf> create(const lockstep_caller& caller) override;

  ModelLeaves& leaves() {
    if (caller_.time->now != now_) {
      now_ = caller_.time->now;
      leaves_.fold();
      leaves_.begin_tick();
      leaves_.drift();
    }
    return leaves_;
  }
  void begin(const lockstep_caller& caller, std::uint32_t leaf) {
    if (watch_ != nullptr) watch_->begins(caller);
    leaves().start(leaf);
  }
  const char* error(std::uint32_t leaf) {
    return std::exchange(leaves_.slots()[leaf].error, nullptr);
  }

 private:
  const LeafScripts& scripts_;
  PlayedLeafWatch* const watch_;
  const lockstep_caller& caller_;
  RandomAnswers answers_;
  std::vector<const lockstep_caller*> callers_;  // of each leaf
  ModelLeaves leaves_;
  std::map<NodeIndex, std::uint32_t> numbers_;
  Nanoseconds now_{-1};
};

class ModelLeafOfRun final : public RemoteLeaf {
 public:
  ModelLeafOfRun(const lockstep_caller& caller, ModelRun& run, std::uint32_t number)
      : RemoteLeaf(caller), run_(run), number_(number) {}

  void start() override { run_.begin(caller_, number_); }
  lockstep_status tick() override {
    const Status status = run_.leaves().tick(number_);
    if (const char* error = run_.error(number_)) fail(error);
    return static_cast<lockstep_status>(status);
  }
  void halt() override { run_.leaves().halt(number_); }
  void pause() override { run_.leaves().pause(number_); }
  void resume() override { run_.leaves().resume(number_); }
  double progress() override { return run_.leaves().progress(number_); }
  void end() override {}
  std::string trouble() override { return {}; }

 private:
  ModelRun& run_;
  const std::uint32_t number_;
};

std::unique_ptr<RemoteLeaf> ModelRun::create(const lockstep_caller& caller) {
  if (auto scripted = find_script(scripts_, caller, watch_)) return scripted;
  const std::uint32_t number = numbers_.at(caller.node);
  callers_[number] = &caller;
  return std::make_unique<ModelLeafOfRun>(caller, *this, number);
}

bool is_leaf(const NodeType& type) {
  const bool is_foreign = type.leaf != nullptr || type.mock != nullptr;
  return is_foreign &&
         (type.category == NodeCategory::Action || type.category == NodeCategory::Condition);
}

std::optional<Problem> check_written(const NodeType& type, const LeafWord& word) {
  for (const auto& [name, text] : word.written) {
    const auto port = std::ranges::find(type.parameters, name, &Parameter::name);
    if (port == type.parameters.end() || port->direction == Direction::Input) {
      return Problem{fmt::format("'{}' has no output '{}'", type.id, brief(name))};
    }
    if (!value_from_outside(port->is_generic, port->type, text)) {
      return Problem{
          fmt::format("'{}' is not a value of the port '{}' of '{}'", brief(text), name, type.id),
          fmt::format("expected {}", expected_text(port->type))};
    }
  }
  return std::nullopt;
}

}  // namespace

PlayedLeaves::PlayedLeaves() {
  static_cast<lockstep_plugin&>(plugin_) = proxy_plugin();
  plugin_.name = "leaves";
  plugin_.remote = this;
  plugin_.is_local = true;
}

void PlayedLeaves::take_over(Definition& definition, Stays stays) {
  std::map<const NodeType*, const NodeType*> taken;
  for (DefinitionNode& node : definition.nodes) {
    if (stays != nullptr && stays(*node.type)) continue;
    if (node.type->asks) {
      node.type = add_asking(definition, node);
    } else if (is_leaf(*node.type)) {
      const auto [it, is_new] = taken.try_emplace(node.type);
      if (is_new) it->second = add_type(*node.type);
      node.type = it->second;
    }
  }
}

const NodeType* PlayedLeaves::add_type(const NodeType& from) {
  Type& type = types_.emplace_back(Type{proxy_leaf_type(), from});
  const bool is_condition = type.node.category == NodeCategory::Condition;
  type.leaf.kind = is_condition ? LOCKSTEP_CONDITION : LOCKSTEP_ACTION;
  type.leaf.flags = is_condition && type.node.can_run ? LOCKSTEP_MAY_RUN : 0;
  type.leaf.id = type.node.leaf != nullptr ? type.node.leaf->id : "leaf";
  if (type.node.leaf != nullptr) {
    type.leaf.behavior_count = type.node.leaf->behavior_count;
    type.leaf.behavior = type.node.leaf->behavior;
  }
  type.leaf.start_unreset = nullptr;  // one that takes time keeps its result, as in verify
  if (!type.node.has_progress) type.leaf.progress = nullptr;
  type.node.can_be_slowed |= type.node.mock != nullptr;
  type.node.mock = nullptr;
  type.node.leaf = &type.leaf;
  type.node.origin = &plugin_;
  type.node.real_time = false;
  if (type.node.plugin.empty()) type.node.plugin = plugin_.name;
  return &type.node;
}

// Its options differ from those of other nodes of its kind. It asks in its first tick, so an answer
// comes in the second at the earliest.
const NodeType* PlayedLeaves::add_asking(const Definition& definition, const DefinitionNode& node) {
  add_type(*node.type);
  Type& type = types_.back();
  type.parameters.assign(node.type->parameters.begin(), node.type->parameters.end());
  for (Parameter& it : type.parameters) it.is_script = it.is_template = false;
  type.node.parameters = type.parameters;
  type.node.asks = type.node.has_progress = false;
  type.leaf.progress = nullptr;
  const auto answer = std::ranges::find(type.parameters, "answer", &Parameter::name);
  const auto place = static_cast<std::size_t>(answer - type.parameters.begin());
  const bool tells = definition.ports[node.first + place].entry != Port::kNone;
  const auto& options = std::get<std::vector<std::string>>(*definition.constant(node, "options"));
  const bool may_be_late = definition.has(node, "timeout") && !definition.has(node, "default");
  const bool may_fail = may_be_late || (!tells && options.size() > 1);
  type.texts = {may_fail ? "success;failure" : "success", "2..inf", "success",
                joined(options, "|")};
  type.behavior = {{"result", type.texts[0].c_str()}, {"ticks", type.texts[1].c_str()}};
  if (tells) {
    type.behavior.push_back({"writes", type.texts[2].c_str()});
    type.behavior.push_back({"out.answer", type.texts[3].c_str()});
  }
  type.leaf.behavior = type.behavior.data();
  type.leaf.behavior_count = static_cast<std::uint32_t>(type.behavior.size());
  return &type.node;
}

std::optional<PlayedLeaves::Mistake> PlayedLeaves::check(const LeafScripts& scripts,
                                                         const Tree& tree) {
  std::map<std::string, const NodeType*, std::less<>> leaves;
  for (const LeafNode& leaf : tree.leaves) leaves[tree.path(leaf.node)] = leaf.type;
  const auto unknown = [&](const std::string& path) {
    std::vector<std::string_view> known;
    for (const auto& it : leaves) known.emplace_back(it.first);
    return Mistake{{fmt::format("the tree has no leaf '{}'", brief(path)),
                    suggest_path(path, known, "its leaves")},
                   path};
  };
  for (const ScriptCut& cut : scripts.cuts) {
    for (const auto& [path, does] : cut.leaves)
      if (!leaves.contains(path)) return unknown(path);
  }
  for (const auto& [path, words] : scripts.leaves) {
    const auto leaf = leaves.find(path);
    if (leaf == leaves.end()) return unknown(path);
    for (const LeafWord& word : words) {
      if (auto wrong = check_written(*leaf->second, word)) return Mistake{*std::move(wrong), path};
    }
  }
  return std::nullopt;
}

std::unique_ptr<RemoteRun> PlayedLeaves::begin_run(const lockstep_caller& caller) {
  if (models_ == nullptr) return std::make_unique<PlayedRun>(scripts_, watch_);
  return std::make_unique<ModelRun>(caller, *tree_, *models_, scripts_, watch_);
}

}  // namespace lockstep::host
