// An expansion finds what the ticks from some states do. Several threads make chunks of these at a
// time; the search puts them together in the order of the states, so that all is the same with any
// number of threads.
#pragma once

#include <atomic>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "verify/coverage.h"
#include "verify/edge_rows.h"
#include "verify/labels.h"
#include "verify/search_limits.h"
#include "verify/stepper.h"

namespace lockstep::host {

// A thread sees this for the first time: in the order of the states, the first of all threads is
// among these.
struct News {
  enum class Kind : std::uint8_t { Result, Fault, Broken, Passed, Repeated, Violated, EntryValue };
  Kind kind;
  std::uint32_t which;  // a status, node, property or entry
  std::string text = {};
  std::vector<LeafAnswer> answers = {};  // of the tick, but for an EntryValue
};

// What a search may take of the machine. All threads look at it.
struct SearchRoom {
  const SearchLimits& limits;
  Nanoseconds began;
  std::size_t memory = 0;                // taken before the round
  std::atomic<std::size_t> of_round{0};  // by its chunks, so far

  // Why nothing may go on.
  std::optional<SearchEnd> why_over() const;
  // A round ends early where its chunks take much of what there is.
  bool is_round_full() const;
};

// A row of states. What they lead to and was not known when the row was begun is in `fresh`.
// The label of an edge to another state says only who is held: see CycleGraph.
struct Chunk {
  struct State {
    std::uint64_t transitions = 0, root_ticks = 0;
    std::size_t edges = 0, fresh = 0, news = 0;  // where those of the next state begin
    std::uint32_t equals = 0;                    // a label, if leaves may change places
    bool ends = false;                           // some tick without a cut ends the run
    std::optional<std::uint32_t> end = {};       // a label of all that these hold, if they do
    std::optional<SearchEnd> cut = {};           // why not all of its ticks were made
  };
  static constexpr StateId kFresh = 0x80000000;  // of an edge: its goal is in `fresh`

  StateId first = 0;
  std::uint64_t root_ticks = 0;
  unsigned thread = 0;  // whose labels the edges have
  std::vector<State> states;
  std::vector<Edge> edges;
  StateStore fresh;
  std::vector<News> news;

  void clear();
  std::size_t memory() const;  // that is used, and will be when it is put to the others
};

// One for each thread.
class Expander {
 public:
  // All must outlive this.
  Expander(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
           double rate, const Symmetry& symmetry, const SearchLimits& limits);

  StateBytes first_state() { return stepper_.first_state(); }
  // All ticks from these states. They can be cut by limits: then the chunk ends there.
  void expand(const StateStore& known, StateId first, StateId last, SearchRoom& room, Chunk& into);
  // The same once more, for all that labels say of the edges for which `is_wanted`. All of their
  // goals are known. No limit of states or ticks cuts them.
  using BytesOf = std::function<std::span<const std::byte>(StateId)>;
  using EdgeWanted = std::function<bool(StateId from, StateId to, const StateBytes& goal)>;
  void expand_again(const StateStore& known, std::span<const StateId> states,
                    const BytesOf& bytes_of, const EdgeWanted& is_wanted, SearchRoom& room,
                    Chunk& into);

  const LabelTable& labels() const { return labels_; }
  const LabelShape& label_shape() const { return labeller_.shape(); }
  const SearchCoverage& coverage() const { return coverage_; }

 private:
  template <class Take, class Cut>
  void for_each_tick(StateId state, std::span<const std::byte> bytes, Chunk& into, const Take& take,
                     const Cut& why_cut);
  std::optional<Status> tick(Chunk::State& at, Chunk& into);
  void take(StateId from, Status status, Chunk& into);
  void tell(News::Kind kind, std::size_t which, Chunk& into, const std::string& text = {});
  void tell_repeated(Chunk& into);
  void look_at_values(Chunk& into);
  std::optional<SearchEnd> why_cut(const Chunk& chunk) const;
  void begin(const StateStore& known, SearchRoom& room, Chunk& into);
  bool is_over(std::uint64_t ticks);
  void count_memory();

  const SearchLimits& limits_;
  const StateStore* known_ = nullptr;
  SearchRoom* room_ = nullptr;
  Chunk* chunk_ = nullptr;   // that is made
  std::size_t counted_ = 0;  // of its memory
  std::uint64_t ticks_since_look_ = 0;
  std::optional<SearchEnd> over_ = {};  // why nothing goes on
  Stepper stepper_;
  Labeller labeller_;
  LabelTable labels_;
  Label end_;  // of the state that is looked at
  SearchCoverage coverage_;
  std::set<std::pair<News::Kind, std::size_t>> told_;
  std::vector<std::pair<std::uint32_t, std::set<std::string>>> values_;
  std::uint64_t most_root_ticks_ = 0;  // in a chunk
};

}  // namespace lockstep::host
