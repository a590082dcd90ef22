// A property of the runs of a tree: "base.running leads to base.success within 100 ticks". Parsed
// once against the names of a tree; then a monitor that sees the ticks of a run one after the other
// and keeps a few plain bytes. It knows no engine and no recording: whoever has ticks gives it what
// it asks for, so its verdict is the same for a live run, a recording and all behaviors of a tree.
// docs/properties.md defines the language.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "language/property/entry_comparison.h"
#include "language/property/formula.h"
#include "language/property/node_names.h"

namespace lockstep::host {

// The names that a property may use.
struct PropertyNames {
  struct Entry {
    std::string key;
    std::string type;        // "int"
    bool is_strict = false;  // it holds values of this type only
  };
  std::vector<std::string> paths;  // of each node, by its index
  std::vector<Entry> entries;      // of the blackboard, by their number
  PathEnds ends = {};              // of the paths, or of none: then all paths are looked at
};

struct PropertyError {
  std::string message;     // lower case, no full stop
  std::string hint = {};   // what to do, or ""
  std::size_t offset = 0;  // in the text
};

// After a tick, and after the end.
enum class PropertyVerdict : std::uint8_t {
  Open,      // the ticks to come decide
  Holds,     // whatever comes
  Violated,  // likewise
};
std::string_view to_string(PropertyVerdict verdict);  // "open", "holds", "violated"

// What is shown: a tick, or a moment of one, in their order. A tick in which completed nodes were
// begun again has several (docs/properties.md).
struct TickPart {
  bool is_first = true, is_last = true;  // of the tick
};

// A tick as a property sees it: only what it asks for, in that order.
struct PropertyView {
  std::span<const SeenNode> nodes = {};    // Property::nodes
  std::span<const bool> comparisons = {};  // Property::comparisons: whether each is true
};

class Property {
 public:
  using Parsed = tl::expected<Property, PropertyError>;
  // A text may begin with its name: "grip: never arm.running". Without one, its text is its name.
  static Parsed parse(std::string_view text, const PropertyNames& names);

  const std::string& name() const { return name_; }
  void set_name(std::string name) { name_ = std::move(name); }
  bool has_name() const { return name_ != text_; }
  const std::string& text() const { return text_; }  // without the name

  // The nodes and comparisons that it looks at, each once.
  std::span<const std::uint32_t> nodes() const { return formula_.nodes; }
  std::span<const EntryComparison> comparisons() const { return formula_.comparisons; }
  // The constants that it compares progress with, of nodes by their index in the tree.
  std::vector<ProgressComparison> progress_comparisons() const;
  // Whether it looks at the progress of a node, by its place in nodes().
  bool needs_progress(std::size_t place) const;

  // The monitor. Its state is the caller's: `state_size()` bytes at any address. Equal bytes mean
  // equal verdicts on equal ticks from then on.
  std::size_t state_size() const { return state_size_; }
  void begin(std::byte* state) const;
  // After each tick, or each of its moments, until it is violated. Does not allocate.
  PropertyVerdict step(std::byte* state, const PropertyView& view, TickPart part = {}) const;
  // Whether it is about the last tick only, so that a run without an end does not violate it.
  bool is_of_last_tick() const { return pattern_ == Pattern::Finally; }
  // When no tick comes any more: never Open.
  PropertyVerdict at_end(const std::byte* state) const;

 private:
  friend class PropertyParser;
  enum class Pattern : std::uint8_t {
    Never,
    Sometimes,
    LeadsTo,
    OnlyAfter,
    AfterNever,
    AtMost,
    Until,
    Finally
  };

  Property() = default;
  void choose_state();
  std::uint32_t load(const std::byte* state) const;
  void store(std::byte* state, std::uint32_t value) const;
  PropertyVerdict step_leads_to(std::byte* state, bool left, bool right, TickPart part) const;
  PropertyVerdict step_at_most(std::byte* state, bool left, TickPart part) const;

  std::string name_, text_;
  Formula formula_;  // what both sides share
  FormulaCode left_, right_;
  Pattern pattern_ = Pattern::Never;
  bool has_limit_ = false;   // LeadsTo: within
  std::uint32_t ticks_ = 0;  // of LeadsTo and AtMost
  std::size_t state_size_ = 0;
};

}  // namespace lockstep::host
