// Checks properties against one sequence of ticks. Whoever has the ticks fills in what they look
// at, and then lets it step: judge/measure/property_steps.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "language/property/property.h"

namespace lockstep::host {

// Between two ticks, of each property its text, and what it keeps as bytes.
using KeptProperties = std::vector<std::pair<std::string, std::string>>;

// How a run has ended, as far as debts are concerned.
enum class RunIsOver : bool {
  ByItself,     // no tick could follow: what is owed is not paid
  FromOutside,  // a limit, a signal, a recording that is cut: what is owed stays open
};

class PropertyChecks {
 public:
  explicit PropertyChecks(std::vector<Property> properties);

  std::span<const Property> all() const { return properties_; }

  // To be filled in before each step: for each node that is looked at, in this order, what it did,
  // and for each comparison whether it is true. A node may come more than once.
  std::span<const std::uint32_t> nodes() const { return nodes_; }
  bool needs_progress(std::size_t place) const { return needs_progress_[place]; }
  std::span<SeenNode> seen() { return seen_; }
  std::span<const EntryComparison> comparisons() const { return comparisons_; }
  std::span<bool> compared() { return {compared_.get(), comparisons_.size()}; }

  // After a tick, or each of its moments. Gives the properties that the tick has violated until
  // now, by their place in all(). Valid until the next call. Does not allocate.
  std::span<const std::size_t> step(std::uint64_t tick, TickPart part = {});
  // After the last one, likewise.
  std::span<const std::size_t> end(RunIsOver how);
  // Ticks are missing: from now on, what is open stays open.
  void give_up();

  PropertyVerdict verdict(std::size_t property) const { return checked_[property].verdict; }
  // The tick that has decided; none: the end, or nothing.
  std::optional<std::uint64_t> decided(std::size_t property) const {
    return checked_[property].decided;
  }
  // How the nodes of a property were when it was decided, or are now: in the order of its nodes.
  std::span<const SeenNode> seen_by(std::size_t property) const {
    const Checked& it = checked_[property];
    const std::span<const SeenNode> all(it.decided ? decided_by_ : seen_);
    return all.subspan(it.first_node, properties_[property].nodes().size());
  }
  bool any(PropertyVerdict verdict) const;

  // Does not allocate where `into` is what it made of the tick before.
  void keep(KeptProperties& into) const;
  // Before the first step: continues from what was kept. Returns the names of the properties of
  // which nothing was kept: their verdicts are about the ticks from now on.
  std::vector<std::string> go_on(const KeptProperties& kept);

 private:
  struct Checked {
    std::size_t first_node = 0, first_comparison = 0, first_byte = 0;
    PropertyVerdict verdict = PropertyVerdict::Open;
    std::optional<std::uint64_t> decided = {};
  };

  struct KeptHead {
    PropertyVerdict verdict;
    bool is_decided;
    std::uint64_t decided;
  };
  std::size_t state_size(std::size_t property) const { return properties_[property].state_size(); }

  std::vector<Property> properties_;
  std::vector<Checked> checked_;
  std::vector<std::uint32_t> nodes_;
  std::vector<bool> needs_progress_;
  std::vector<SeenNode> seen_, decided_by_;
  std::vector<EntryComparison> comparisons_;
  std::unique_ptr<bool[]> compared_;
  std::vector<std::byte> states_;
  std::vector<std::size_t> violated_;  // in the last step
  bool has_given_up_ = false;
};

}  // namespace lockstep::host
