#include "verify/stepper.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace lockstep::host {
namespace {

constexpr std::uint64_t kMostTicksAtOnce = 10'000, kTicksBetweenQuestions = 256;
const Symmetry kNoSymmetry;

SavedRun saved(const Ticker& ticker) {
  SavedRun run;
  ticker.save(run);
  return run;
}

}  // namespace

std::vector<CutLeaf> after_cut(Ticker& ticker, const LeafModels& models, Answers& answers,
                               ModelLeaves& leaves) {
  std::vector<CutLeaf> cut = ticker.cut_leaves();
  for (CutLeaf& it : cut) {
    std::vector<AfterCut> may = models.leaves[it.place].after_cut;
    // One that has not got a tick since the last cut has kept nothing to go on with.
    if (!leaves.states()[it.place].runs()) std::erase(may, AfterCut::Continues);
    if (may.empty()) may.push_back(AfterCut::StartsAgain);
    it.does = may[answers.choose(static_cast<std::uint32_t>(may.size()), it.place)];
    leaves.cut(it);  // so that what is asked next knows of it
  }
  ticker.go_on_after_cut(cut);
  return cut;
}

// Behind the leaves and the facts.
std::uint32_t cut_asker(const Tree& tree, const LeafModels& models) {
  return static_cast<std::uint32_t>(tree.leaves.size() + models.facts.size());
}

Stepper::Stepper(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
                 double rate, const Symmetry& symmetry, bool rising_answers,
                 std::uint64_t few_root_ticks, std::uint64_t few_ticks, bool joins)
    : deadlines_(rate),
      board_(tree),
      answers_(tree, rising_answers ? symmetry : kNoSymmetry, cut_asker(tree, models) + 1),
      leaves_(tree, models, board_, answers_),
      ticker_(tree, leaves_.slots(), board_),
      watch_(tree, properties),
      fresh_(saved(ticker_)),
      from_(fresh_),
      code_(tree, models, fresh_, nodes_of(properties, tree), symmetry),
      parameters_(tree, fresh_),
      symmetry_(symmetry),
      models_(models),
      cuts_(models.cuts),
      cut_asker_(cut_asker(tree, models)),
      from_leaves_(leaves_.states()),
      from_facts_(leaves_.facts()),
      property_bytes_(watch_.state_size()),
      from_properties_(property_bytes_),
      rounds_(few_root_ticks),
      points_(tree, models, nodes_of(properties, tree), few_ticks),
      joint_(tree, models, symmetry,
             joins && rising_answers && properties.empty() ? few_ticks : kAllTicks),
      has_gone_round_(tree.nodes.size() + properties.size()) {
  ticker_.set_deadlines(deadlines_);
  ticker_.keep_moments();
  if (cuts_.most > 0) barriers_.emplace(tree, leaves_);
  answers_.set_is_known([this](std::uint32_t asker) {
    return points_.add(ticker_, leaves_, answers_, code_, asker, root_ticks_);
  });
}

StateBytes Stepper::first_state() {
  ticker_.restore(fresh_);
  leaves_.restore(std::vector<LeafState>(from_leaves_.size()), first_facts(models_));
  code_.before_fold(ticker_);
  watch_.begin(property_bytes_.data());
  code_.set_cuts(0);
  StateBytes state;
  code_.encode(ticker_, leaves_, property_bytes_, StateCode::Children::AsTheyAre, state);
  return state;
}

void Stepper::load(std::span<const std::byte> state, bool is_first) {
  code_.decode(state, from_, from_leaves_, from_facts_, from_properties_, from_read_);
  parameters_.give(from_, from_read_, ticker_);
  leaves_.restore(from_leaves_, from_facts_);
  from_cuts_ = code_.cuts();
  time_ = deadlines_.at(is_first ? 0 : 1);
  is_begun_ = is_joint_ = false;
  begin_combinations();
}

void Stepper::begin_combinations() {
  answers_.begin_state(from_.run, from_leaves_);
  rounds_.begin_state();
  points_.begin_state(from_.run.activity, from_leaves_);
}

void Stepper::give(std::span<const LeafAnswer> answers) {
  is_begun_ = true;
  is_joint_ = false;
  answers_.give(answers);
}

void Stepper::begin_joint() {
  is_begun_ = true;
  if (joint_.is_empty()) return;
  is_joint_ = joint_.begin_state(from_.run, from_leaves_, ticker_,
                                 [this](const JointAnswers::Child& it) { return ticks_of(it); });
  begin_combinations();
}

// A leaf stands still that runs on, or has succeeded.
std::optional<std::vector<JointAnswers::ChildTick>> Stepper::ticks_of(
    const JointAnswers::Child& child) {
  constexpr std::size_t kMost = 64;
  answers_.ask_only(child.first.leaf, child.end.leaf,
                    [this](std::uint32_t count, std::uint32_t asker) {
                      return models_.leaves[asker].can_run ? count - 1 : 0;
                    });
  std::vector<JointAnswers::ChildTick> ticks;
  do {
    const Status status = tick(1);
    if (!is_done() || ticker_.faulted() || ticks.size() == kMost) return std::nullopt;
    JointAnswers::ChildTick& it = ticks.emplace_back();
    it.status = ticker_.status(child.first.node);
    it.marks = marks_of(child);
    for (const LeafAnswer& answer : answers_.asked()) {
      it.answers.push_back({answer.asker - child.first.leaf, answer.value});
    }
    if (status != Status::Running) continue;
    code_.before_fold(ticker_);
    ticker_.fold();
    leaves_.fold();
    code_.encode(ticker_, leaves_, property_bytes_, StateCode::Children::AsTheyAre, moved_);
    std::vector<std::uint64_t> words = code_.kept().words;
    symmetry_.number_kept_children(ticker_.tree(), words, Symmetry::Numbered::FromNode);
    it.after = JointAnswers::kept(child, code_.kept().activity, words, code_.kept().leaves);
  } while (answers_.next());
  return ticks;
}

// What a label has of its leaves.
std::vector<std::byte> Stepper::marks_of(const JointAnswers::Child& child) const {
  std::vector<std::byte> marks;
  for (std::uint32_t leaf = child.first.leaf; leaf < child.end.leaf; ++leaf) {
    const LeafMark& it = leaves_.marks()[leaf];
    const unsigned bits = (it.touched ? 1u : 0u) | (it.ticked ? 2u : 0u) | (it.ended ? 4u : 0u);
    if (models_.leaves[leaf].ends) marks.push_back(static_cast<std::byte>(bits));
  }
  return marks;
}

Status Stepper::tick(std::uint64_t most) {
  if (!is_begun_) begin_joint();
  if (is_joint_) answers_.give(joint_.answers());
  ticker_.restore(from_);
  leaves_.restore_again(from_leaves_, from_facts_);
  answers_.begin();
  points_.begin_tick();
  answers_.look_at_points(points_.are_looked_at());
  root_ticks_ = 0;
  rounds_.begin_tick(answers_.same_as_before());
  code_.set_cuts(from_cuts_);
  leaves_.begin_tick();
  was_cut_ = is_cut_here();
  if (was_cut_) cut();
  leaves_.drift();
  is_known_ = is_going_round_ = is_short_ = is_cut_ = false;
  if (!watch_.empty()) {
    property_bytes_ = from_properties_;
    ticker_.set_now(time_);
    watch_.before_tick(ticker_);
  }
  if (barriers_) begin_watching();
  const Status status = tick_again(ticker_.tick_root(time_), most);
  // Within a tick of several rounds, somebody may come and go on.
  if (barriers_ && root_ticks_ == 1) barriers_->after_tick(ticker_);
  rounds_.count(root_ticks_);
  is_known_ = is_known_ || answers_.is_known();
  if (is_short_) {
    watch_.skip_tick();
  } else if (!watch_.empty()) {
    const bool is_over = status != Status::Running || ticker_.faulted();
    watch_.after_tick(property_bytes_.data(), ticker_, leaves_.facts(),
                      is_over ? PropertyWatch::End::OfRun : PropertyWatch::End::OfTick);
  }
  return status;
}

void Stepper::begin_watching() {
  barriers_->clear();
  if (barriers_->empty()) return;
  ticker_.set_now(time_);
  barriers_->before_tick(ticker_);
}

// A cut while no leaf runs changes nothing.
bool Stepper::is_cut_here() {
  return from_cuts_ < cuts_.most && std::ranges::any_of(from_leaves_, &LeafState::notices_cut) &&
         answers_.choose(2, cut_asker_) == 1;
}

void Stepper::cut() {
  code_.set_cuts(static_cast<std::uint8_t>(from_cuts_ + 1));
  cut_leaves_ = after_cut(ticker_, models_, answers_, leaves_);
}

bool Stepper::repeats(const CutLeaf& cut) const {
  const LeafNode& leaf = ticker_.tree().leaves[cut.place];
  const LeafState& was = from_leaves_[cut.place];
  return leaf.at_cut.commits && !leaf.type->can_be_restored && cut.does == AfterCut::StartsAgain &&
         was.phase == Phase::Running && leaves_.may_succeed(cut.place, was);
}

Status Stepper::tick_again(Status status, std::uint64_t most) {
  for (root_ticks_ = 1; ticker_.is_asked() && root_ticks_ < most; ++root_ticks_) {
    if (gives_up_ && root_ticks_ % kTicksBetweenQuestions == 0 && gives_up_()) break;
    const auto node = ticker_.take_request();
    if (!node || status != Status::Running || ticker_.faulted()) break;
    if (answers_.is_known()) break;
    if (root_ticks_ == kMostTicksAtOnce) {
      fault(*node);
      break;
    }
    if (rounds_.are_looked_at() && !answers_.are_given() && look_at_round(*node)) {
      if (!is_going_round_) break;
      return go_round(status);
    }
    if (before_tick_again_) before_tick_again_(leaves_);
    status = ticker_.tick_root_again();
  }
  return status;
}

// Whether what follows is known.
bool Stepper::look_at_round(NodeIndex asks) {
  if (rounds_.is_on_way()) {
    rounds_.pass();
    return false;
  }
  Rounds::Round round{.answers = answers_.count(), .asks = asks};
  round_properties_ = from_properties_;
  if (!watch_.empty()) {
    if (!watch_.knows_rounds() || !ticker_.moments().rest.empty()) return false;
    watch_.after_tick(round_properties_.data(), ticker_, leaves_.facts(),
                      PropertyWatch::End::OfRun);
    round.owing.assign(watch_.violated().begin(), watch_.violated().end());
    round_properties_ = from_properties_;
    watch_.after_tick(round_properties_.data(), ticker_, leaves_.facts(),
                      PropertyWatch::End::OfRound);
  }
  make_round_state(asks);
  switch (rounds_.add(round_state_, std::move(round))) {
    case Rounds::Found::New:
      return false;
    case Rounds::Found::Known:
      is_known_ = true;
      return true;
    case Rounds::Found::Loop:
      is_going_round_ = true;
      return true;
  }
  return false;
}

// All that what follows depends on: a state as between two ticks, and what a fold forgets that
// counts within one.
void Stepper::make_round_state(NodeIndex asks) {
  StateBytes& into = round_state_;
  const auto add = [&](const auto& it) {
    const auto bytes = std::as_bytes(std::span(&it, 1));
    into.insert(into.end(), bytes.begin(), bytes.end());
  };
  const auto add_all = [&](std::span<const std::byte> bytes) {
    into.insert(into.end(), bytes.begin(), bytes.end());
  };
  ticker_.save(round_);
  round_leaves_ = leaves_.states();
  round_facts_ = leaves_.facts();
  code_.before_fold(ticker_);
  ticker_.fold();
  leaves_.fold();
  code_.encode(ticker_, leaves_, round_properties_, StateCode::Children::AsTheyAre, into);
  ticker_.restore(round_);
  leaves_.restore_again(round_leaves_, round_facts_);
  add(asks);
  add_all(std::as_bytes(std::span(round_.run.activity)));
  for (const std::uint32_t it : round_.run.last_tick) add(it != 0);
  const Tree& tree = ticker_.tree();
  for (const Group& it : tree.groups) add_all(ticker_.kept_bytes(it.node));
  for (const Member& it : tree.members) add_all(ticker_.kept_bytes(it.node));
  leaves_.for_each_of_tick(add);
  for (const std::size_t it : watch_.violated()) add(it);
  answers_.for_each_tie(add);
}

// The run comes back to where it has been, until there are too many rounds. Somebody may ask to
// see all of these; for the others it is enough to know how it ends.
Status Stepper::go_round(Status status) {
  const Rounds::Round& last = rounds_.last_of(kMostTicksAtOnce);
  const std::size_t nodes = ticker_.tree().nodes.size();
  const std::uint64_t root_ticks = root_ticks_;
  bool is_new = !has_gone_round_[last.asks];
  has_gone_round_[last.asks] = true;
  for (const std::size_t it : last.owing) {
    is_new = is_new || !has_gone_round_[nodes + it];
    has_gone_round_[nodes + it] = true;
  }
  if (!is_new) {
    is_short_ = true;
    fault(last.asks);
    return status;
  }
  answers_.repeat_from(rounds_.loop().answers);
  for (NodeIndex asks = last.asks; root_ticks_ < kMostTicksAtOnce; ++root_ticks_) {
    if (gives_up_ && root_ticks_ % kTicksBetweenQuestions == 0 && gives_up_()) {
      is_cut_ = true;
      return status;
    }
    if (before_tick_again_) before_tick_again_(leaves_);
    status = ticker_.tick_root_again();
    asks = ticker_.take_request().value_or(NodeIndex{0});
    const bool is_last = root_ticks_ + 1 == kMostTicksAtOnce;
    if (status != Status::Running || ticker_.faulted() || (is_last && asks != last.asks)) {
      throw std::logic_error("a round of a tick does not do what it did before");
    }
  }
  root_ticks_ = root_ticks;  // it counts the same whoever sees it first
  fault(last.asks);
  return status;
}

void Stepper::fault(NodeIndex asks) {
  ticker_.set_fault(asks, "requested another tick 10,000 times in one period");
}

const StateBytes& Stepper::fold() {
  parameters_.learn(from_, ticker_);
  code_.before_fold(ticker_);
  ticker_.fold();
  leaves_.fold();
  code_.encode(ticker_, leaves_, property_bytes_, StateCode::Children::Sorted, folded_);
  return folded_;
}

const StateBytes& Stepper::in_place() {
  code_.encode(ticker_, leaves_, property_bytes_, StateCode::Children::AsTheyAre, moved_);
  return moved_;
}

const StateBytes& Stepper::moved(std::span<const std::byte> state,
                                 std::span<const NodeIndex> places) {
  code_.move(state, places, moved_);
  return moved_;
}

}  // namespace lockstep::host
