#include "verify/tick_answers.h"

#include <algorithm>
#include <stdexcept>

namespace lockstep::host {

namespace {

constexpr std::size_t kMostChildren = 32;  // one in the other; what is farther out has any order

}  // namespace

TickAnswers::TickAnswers(const Tree& tree, const Symmetry& symmetry, std::size_t askers)
    : tree_(tree), symmetry_(symmetry), children_of_(askers) {
  std::uint32_t child = 0;
  for (const EqualChildren& it : symmetry.classes()) {
    for (const EqualChildren::Place& place : it.places) {
      for (std::uint32_t i = 0; i < it.leaves; ++i) {
        std::vector<std::uint32_t>& inner = children_of_[place.leaf + i];
        if (inner.size() < kMostChildren) inner.push_back(child);
      }
      ++child;
    }
  }
  children_.resize(child);
}

// States have equal children in one order, so those in equal states are beside each other.
void TickAnswers::begin_state(const RunState& run, const std::vector<LeafState>& leaves) {
  digits_.clear();
  at_ = 0;
  is_given_ = false;
  of_others_ = nullptr;
  equal_children_.clear();
  with_equals_.clear();
  if (children_.empty()) return;
  words_ = run.bytes;
  symmetry_.number_kept_children(tree_, words_, Symmetry::Numbered::FromNode);
  for (Child& it : children_) it.has_equal = it.follows = false;
  std::uint32_t child = 0;
  for (std::size_t of = 0; of < symmetry_.classes().size(); ++of) {
    const EqualChildren& it = symmetry_.classes()[of];
    for (std::size_t place = 0; place < it.places.size(); ++place, ++child) {
      if (place == 0 || !are_equal(it, place, run, leaves)) continue;
      equal_children_.push_back({of, place});
      children_[child - 1].has_equal = children_[child].has_equal = true;
      children_[child].follows = true;
    }
  }
  for (child = 0; child < children_.size(); ++child) {
    if (!children_[child].has_equal) continue;
    with_equals_.push_back(child);
    children_[child].answers.clear();
    children_[child].is_tied = children_[child].follows;
  }
}

// Whether it is in the state of the one before it.
bool TickAnswers::are_equal(const EqualChildren& it, std::size_t place, const RunState& run,
                            const std::vector<LeafState>& leaves) const {
  const EqualChildren::Place &one = it.places[place - 1], &other = it.places[place];
  const auto equal = [](const auto& all, std::size_t first, std::size_t second, std::size_t count) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    return std::equal(begin, begin + static_cast<std::ptrdiff_t>(count),
                      all.begin() + static_cast<std::ptrdiff_t>(second));
  };
  return equal(run.activity, one.node, other.node, it.nodes) &&
         equal(words_, one.word, other.word, it.words) &&
         equal(leaves, one.leaf, other.leaf, it.leaves);
}

void TickAnswers::give(std::span<const LeafAnswer> answers) {
  is_given_ = true;
  of_others_ = nullptr;
  given_.resize(children_of_.size());
  for (std::vector<std::uint32_t>& it : given_) it.clear();
  for (const LeafAnswer& it : answers) given_[it.asker].push_back(it.value);
}

void TickAnswers::ask_only(std::uint32_t first, std::uint32_t end, OfOthers others) {
  digits_.clear();
  is_given_ = false;
  first_asked_ = first;
  end_asked_ = end;
  of_others_ = std::move(others);
}

void TickAnswers::begin() {
  at_ = 0;
  repeats_ = is_known_ = false;
  repeated_.clear();
  if (!is_given_) return;
  digits_.clear();
  next_given_.assign(children_of_.size(), 0);
}

bool TickAnswers::next() {
  const auto take_back = [&] {
    undo(digits_.back());
    digits_.pop_back();
  };
  while (digits_.size() > at_) take_back();
  at_ = 0;
  while (!digits_.empty() && digits_.back().value + 1 == digits_.back().count) take_back();
  if (digits_.empty()) return false;
  undo(digits_.back());
  ++digits_.back().value;
  note(digits_.back());
  return true;
}

void TickAnswers::repeat_from(std::size_t first) {
  repeats_ = true;
  repeats_from_ = first;
}

std::uint32_t TickAnswers::choose(std::uint32_t count, std::uint32_t asker) {
  if (count <= 1) return 0;
  if (repeats_) return repeat(asker);
  if (is_known_) return 0;
  if (of_others_ != nullptr && (asker < first_asked_ || asker >= end_asked_)) {
    return of_others_(count, asker);
  }
  if (at_ == digits_.size()) {
    is_known_ = looks_ && !is_given_ && of_others_ == nullptr && is_known_before_(asker);
    if (is_known_) return 0;
    digits_.push_back({is_given_ ? given(asker, count) : least(asker), count, asker});
    note(digits_.back());
  }
  return digits_[at_++].value;
}

std::uint32_t TickAnswers::draw(std::span<const double> chances, std::uint32_t asker) {
  const std::size_t place = at_;
  const std::uint32_t answer = choose(static_cast<std::uint32_t>(chances.size()), asker);
  if (at_ > place) digits_[place].chances = chances.data();
  return answer;
}

std::uint32_t TickAnswers::repeat(std::uint32_t asker) {
  const Question& digit = digits_[repeats_from_ + repeated_.size() % (at_ - repeats_from_)];
  if (digit.asker != asker) throw std::logic_error("a round requests something else");
  repeated_.push_back({asker, digit.value});
  return digit.value;
}

// As long as a child has answered as the one before it, it is asked the same.
std::uint32_t TickAnswers::least(std::uint32_t asker) const {
  std::uint32_t least = 0;
  if (!has_ties()) return least;
  for (const std::uint32_t it : children_of_[asker]) {
    const Child& child = children_[it];
    if (!child.has_equal || !child.is_tied) continue;
    const std::vector<std::uint32_t>& before = children_[it - 1].answers;
    if (child.answers.size() < before.size()) {
      least = std::max(least, before[child.answers.size()]);
    }
  }
  return least;
}

void TickAnswers::note(Question& digit) {
  if (!has_ties()) return;
  digit.was_tied = 0;
  std::uint32_t bit = 1;
  for (const std::uint32_t it : children_of_[digit.asker]) {
    Child& child = children_[it];
    if (child.has_equal && child.is_tied) {
      const std::vector<std::uint32_t>& before = children_[it - 1].answers;
      const std::size_t place = child.answers.size();
      digit.was_tied |= bit;
      child.is_tied = place < before.size() && before[place] == digit.value;
    }
    if (child.has_equal) child.answers.push_back(digit.value);
    bit <<= 1u;
  }
}

// Those after it are taken back before it.
void TickAnswers::undo(const Question& digit) {
  if (!has_ties()) return;
  std::uint32_t bit = 1;
  for (const std::uint32_t it : children_of_[digit.asker]) {
    Child& child = children_[it];
    if (child.has_equal) {
      child.answers.pop_back();
      child.is_tied = (digit.was_tied & bit) != 0;
    }
    bit <<= 1u;
  }
}

std::uint32_t TickAnswers::given(std::uint32_t asker, std::uint32_t count) {
  std::size_t& next = next_given_[asker];
  if (next == given_[asker].size() || given_[asker][next] >= count) {
    throw std::logic_error("a tick requests more than it did before");
  }
  return given_[asker][next++];
}

std::vector<LeafAnswer> TickAnswers::asked() const {
  std::vector<LeafAnswer> asked;
  for (std::size_t i = 0; i < at_; ++i) asked.push_back({digits_[i].asker, digits_[i].value});
  asked.insert(asked.end(), repeated_.begin(), repeated_.end());
  return asked;
}

}  // namespace lockstep::host
