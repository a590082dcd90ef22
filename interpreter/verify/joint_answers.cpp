#include "verify/joint_answers.h"

#include <algorithm>
#include <cstring>
#include <unordered_map>

#include "engine/node_kind.h"
#include "engine/synchronized.h"
#include "verify/labels.h"
#include "verify/tick_points.h"

namespace lockstep::host {
namespace {

// In a state with more of them, all combinations are tried. To join that many takes some tenths of
// a second, in which nobody looks at limits.
constexpr std::size_t kMostGroups = 8, kMostJoined = 30'000;

bool shares_facts(const LeafModel& it) {
  return it.fact != kNoFact;
}

}  // namespace

JointAnswers::JointAnswers(const Tree& tree, const LeafModels& models, const Symmetry& symmetry,
                           std::uint64_t few_ticks)
    : tree_(tree), symmetry_(symmetry), few_ticks_(few_ticks) {
  const NodeKind& root = *tree.nodes[0].kind;
  const bool is_parallel = root.has_any_order && root.sure_to_end != nullptr;
  const bool is_joinable = is_parallel && !symmetry.empty() && is_plain(tree) &&
                           tree.hooked.empty() && holdable(tree).empty() && models.cuts.most == 0 &&
                           few_ticks != kAllTicks &&
                           std::ranges::none_of(models.leaves, shares_facts);
  if (!is_joinable) return;
  for_each_child(tree, 0, [&](NodeIndex child) {
    children_.push_back({EqualChildren::place_of(tree, child),
                         EqualChildren::place_of(tree, tree.nodes[child].end),
                         symmetry.first_like(child)});
  });
  const auto is_apart = [&](const Child& it) {
    return symmetry.is_on_its_own(it.first.node) && tree.nodes[it.first.node].is_latched;
  };
  if (!std::ranges::all_of(children_, is_apart)) children_.clear();
}

bool JointAnswers::begin_state(const RunState& run, const std::vector<LeafState>& leaves,
                               const NodeContext& context, const TicksOf& ticks_of) {
  at_ = 0;
  after_.clear();
  all_.clear();
  examples_.clear();
  if (children_.empty()) return false;
  make_groups(run, leaves);
  if (groups_.size() > kMostGroups) return false;
  if (!find_outcomes(ticks_of) || has_twins() || are_few() || !join(context)) return false;
  add_examples();
  put(all_[0], 0, 0);
  return true;
}

std::vector<std::byte> JointAnswers::kept(const Child& child, const std::vector<Activity>& activity,
                                          std::span<const std::uint64_t> words,
                                          const std::vector<LeafState>& leaves) {
  std::vector<std::byte> bytes;
  const auto add = [&](std::span<const std::byte> it) {
    bytes.insert(bytes.end(), it.begin(), it.end());
  };
  const auto [first, end, like] = child;
  add(std::as_bytes(std::span(activity).subspan(first.node, end.node - first.node)));
  add(std::as_bytes(words.subspan(first.word, end.word - first.word)));
  for (std::uint32_t leaf = first.leaf; leaf < end.leaf; ++leaf) {
    const LeafState& it = leaves[leaf];
    const std::uint64_t packed = std::uint64_t{it.ticks} << 32u | std::uint64_t{it.level} << 16u |
                                 static_cast<std::uint64_t>(it.phase);
    add(std::as_bytes(std::span(&packed, 1)));
  }
  return bytes;
}

// States have equal children in one order, so those in equal states are beside each other.
void JointAnswers::make_groups(const RunState& run, const std::vector<LeafState>& leaves) {
  std::vector<std::uint64_t> words = run.bytes;
  symmetry_.number_kept_children(tree_, words, Symmetry::Numbered::FromNode);
  groups_.clear();
  for (std::uint32_t child = 0; child < children_.size(); ++child) {
    std::vector<std::byte> kept = this->kept(children_[child], run.activity, words, leaves);
    const bool is_as_before = !groups_.empty() && groups_.back().kept == kept &&
                              children_[groups_.back().children[0]].like == children_[child].like;
    if (!is_as_before) groups_.push_back({.children = {}, .kept = std::move(kept)});
    groups_.back().children.push_back(child);
  }
}

bool JointAnswers::find_outcomes(const TicksOf& ticks_of) {
  outcomes_.clear();
  for (Group& group : groups_) {
    const Child& child = children_[group.children[0]];
    const auto ticks = ticks_of(child);
    if (!ticks) return false;
    for (const ChildTick& tick : *ticks) {
      std::optional<std::uint32_t> after;
      if (tick.after) after = number_of(child.like, *tick.after);
      const auto is_same = [&](const Outcome& it) {
        return it.status == tick.status && it.after == after && it.marks == tick.marks;
      };
      auto known = std::ranges::find_if(group.outcomes, is_same);
      if (known == group.outcomes.end()) {
        known = group.outcomes.insert(known, {tick.status, after, tick.marks, {}});
      }
      known->words.push_back(tick.answers);
    }
    group.first_outcome = outcomes_.size();
    for (std::uint32_t i = 0; i < group.outcomes.size(); ++i) {
      outcomes_.emplace_back(static_cast<std::uint32_t>(&group - groups_.data()), i);
    }
  }
  return true;
}

std::uint32_t JointAnswers::number_of(NodeIndex like, const std::vector<std::byte>& kept) {
  const std::pair wanted(like, kept);
  const auto known = std::ranges::find(after_, wanted);
  const auto number = static_cast<std::uint32_t>(known - after_.begin());
  if (known == after_.end()) after_.push_back(wanted);
  return number;
}

// Two outcomes after which a child keeps the same: in one, a leaf may have ended, in the other it
// works on.
bool JointAnswers::has_twins() const {
  return std::ranges::any_of(groups_, [](const Group& group) {
    for (auto it = group.outcomes.begin(); it != group.outcomes.end(); ++it) {
      const auto rest = std::ranges::subrange(it + 1, group.outcomes.end());
      if (it->after && std::ranges::count(rest, it->after, &Outcome::after) > 0) return true;
    }
    return false;
  });
}

// As many as there are words with rising ones for equal children.
bool JointAnswers::are_few() const {
  double combinations = 1;
  for (const Group& group : groups_) {
    double words = 0;
    for (const Outcome& it : group.outcomes) words += static_cast<double>(it.words.size());
    for (std::size_t i = 1; i <= group.children.size(); ++i) {
      combinations *= (words - 1 + static_cast<double>(i)) / static_cast<double>(i);
    }
  }
  return combinations <= static_cast<double>(few_ticks_);
}

void JointAnswers::find_end(const NodeContext& context, std::uint32_t group, Joined& joined) const {
  const bool was_over = joined.end.has_value();
  joined.end = tree_.nodes[0].kind->sure_to_end(context, 0, joined.statuses);
  if (joined.end && !was_over) joined.ended_by = group;
}

// Visits what comes of it with each number of children that have the next outcome. False: it is not
// known where one of these leads.
template <class Take>
bool JointAnswers::add(const NodeContext& context, const Joined& before, Take take) const {
  const auto [number, place] = outcomes_[before.outcomes.size()];
  const Group& group = groups_[number];
  const Outcome& outcome = group.outcomes[place];
  const auto children = static_cast<std::uint32_t>(group.children.size());
  const std::uint32_t left = place == 0 ? children : before.left;
  const bool is_last = place + 1 == group.outcomes.size();
  Joined joined = before;
  joined.outcomes.push_back(0);
  joined.left = left;
  for (std::uint32_t count = 0; count <= left; ++count) {
    if (count > 0) {
      ++joined.outcomes.back();
      --joined.left;
      ++joined.statuses[index_of(outcome.status)];
      if (outcome.after) ++joined.after[*outcome.after];
      if (outcome.status != Status::Running) find_end(context, number, joined);
      if (!outcome.after && !joined.end) return false;
    }
    if (joined.left == 0 || !is_last) take(joined);
  }
  return true;
}

// Outcome by outcome, with one of those that lead to the same.
bool JointAnswers::join(const NodeContext& context) {
  all_.push_back(nobody());
  std::unordered_map<std::string, std::size_t> known;
  std::string key;
  const auto add_key = [&](const auto& values) {
    const auto bytes = std::as_bytes(std::span(values));
    key.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  for (std::size_t i = 0; i < outcomes_.size(); ++i) {
    std::vector<Joined> next;
    known.clear();
    const auto take = [&](const Joined& joined) {
      key.clear();
      add_key(std::array{joined.left});
      if (joined.end) {
        add_key(std::array{std::uint64_t{joined.ended_by}, *joined.end});
      } else {
        add_key(joined.after);
        add_key(joined.statuses);
      }
      if (known.try_emplace(key, next.size()).second) next.push_back(joined);
    };
    for (const Joined& before : all_) {
      if (!add(context, before, take) || next.size() > kMostJoined) return false;
    }
    all_ = std::move(next);
  }
  return true;
}

// What a node may return is seen in one tick at least: each word of a group while the others stand
// still.
void JointAnswers::add_examples() {
  Joined still = nobody();
  std::vector<std::size_t> still_of;  // of each outcome: the one of its group that stands still
  for (const Group& group : groups_) {
    const auto runs = std::ranges::find(group.outcomes, Status::Running, &Outcome::status);
    const bool some_run = runs != group.outcomes.end();
    const std::size_t place =
        some_run ? static_cast<std::size_t>(runs - group.outcomes.begin()) : 0;
    still.outcomes.resize(group.first_outcome + group.outcomes.size());
    still.outcomes[group.first_outcome + place] = static_cast<std::uint16_t>(group.children.size());
    still_of.resize(still.outcomes.size(), group.first_outcome + place);
  }
  for (std::size_t i = 0; i < outcomes_.size(); ++i) {
    Example example{still, i, 0};
    --example.joined.outcomes[still_of[i]];
    ++example.joined.outcomes[i];
    const auto [group, place] = outcomes_[i];
    for (; example.word < groups_[group].outcomes[place].words.size(); ++example.word) {
      examples_.push_back(example);
    }
  }
}

bool JointAnswers::next() {
  if (++at_ < all_.size()) {
    put(all_[at_], 0, 0);
    return true;
  }
  const std::size_t example = at_ - all_.size();
  if (example >= examples_.size()) return false;
  put(examples_[example].joined, examples_[example].outcome, examples_[example].word);
  return true;
}

// The first child with this outcome has the word, and all others with an outcome its first one.
void JointAnswers::put(const Joined& joined, std::size_t outcome, std::size_t word) {
  answers_.clear();
  for (const Group& group : groups_) {
    auto child = group.children.begin();
    for (std::size_t i = 0; i < group.outcomes.size(); ++i) {
      const std::size_t number = group.first_outcome + i;
      for (std::uint16_t left = joined.outcomes[number]; left > 0; --left, ++child) {
        const bool is_it = number == outcome && left == joined.outcomes[number];
        for (const LeafAnswer& it : group.outcomes[i].words[is_it ? word : 0]) {
          answers_.push_back({it.asker + children_[*child].first.leaf, it.value});
        }
      }
    }
  }
}

}  // namespace lockstep::host
