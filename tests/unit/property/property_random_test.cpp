// Random properties on random traces: the monitor, which sees a tick after the other and forgets
// it, says what the definition says, which looks at all of them again and again.
#include <catch2/catch.hpp>
#include <map>
#include <memory>
#include <optional>

#include "base/core/random.h"
#include "unit/property/trace.h"

namespace lockstep::host::test {
namespace {

constexpr std::uint64_t kProperties = 4'000;
const char* const kNames[] = {"Main/x/a", "Main/x/b", "Main/y/c"};

// A formula as a tree.
struct Term {
  enum class What { Status, Held, Progress, Entry, And, Or, Not } what;
  std::size_t node = 0;
  Status status = Status::Idle;
  int tenths = 0;  // of progress, or the value of the entry
  std::unique_ptr<Term> left = {}, right = {};

  std::string text() const {
    const std::string name(1, "abc"[node]);
    switch (what) {
      case What::Status:
        return name + "." + std::string(to_string(status));
      case What::Held:
        return name + ".held";
      case What::Progress:
        return name + ".progress < 0." + std::to_string(tenths);
      case What::Entry:
        return "{n} >= " + std::to_string(tenths);
      case What::And:
        return "(" + left->text() + " and " + right->text() + ")";
      case What::Or:
        return "(" + left->text() + " or " + right->text() + ")";
      case What::Not:
        return "not " + left->text();
    }
    return {};
  }

  bool holds(const Trace& trace, std::size_t tick) const {
    switch (what) {
      case What::Status:
        return trace.seen(node, tick).status == status;
      case What::Held:
        return trace.seen(node, tick).held;
      case What::Progress:
        return trace.nodes[node].progress[tick] * 10 < tenths - 0.5;
      case What::Entry:
        return !trace.entries[0].values[tick].empty() &&
               std::stoi(trace.entries[0].values[tick]) >= tenths;
      case What::And:
        return left->holds(trace, tick) && right->holds(trace, tick);
      case What::Or:
        return left->holds(trace, tick) || right->holds(trace, tick);
      case What::Not:
        return !left->holds(trace, tick);
    }
    return false;
  }
};

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed, 0) {}

  std::size_t below(std::size_t end) { return static_cast<std::size_t>(random_.next() % end); }

  std::unique_ptr<Term> term(int depth) {
    auto term = std::make_unique<Term>();
    term->what = static_cast<Term::What>(below(depth == 0 ? 4 : 7));
    term->node = below(3);
    term->status = static_cast<Status>(below(5));
    term->tenths = static_cast<int>(1 + below(9));
    if (term->what >= Term::What::And) term->left = this->term(depth - 1);
    if (term->what == Term::What::And || term->what == Term::What::Or) {
      term->right = this->term(depth - 1);
    }
    return term;
  }

  Trace trace() {
    const std::size_t size = 1 + below(12);
    Trace trace;
    for (const char* name : kNames) {
      TraceNode node{name, {}, {}};
      for (std::size_t tick = 0; tick < size; ++tick) {
        node.ticks += "rrsfikh"[below(7)];
        node.progress.push_back(static_cast<double>(below(11)) / 10);
      }
      trace.nodes.push_back(std::move(node));
    }
    // Half of them have ticks of several moments.
    const bool has_moments = below(2) == 0;
    for (std::size_t i = 0, tick = 0; has_moments && i < size; ++i) {
      if (i > 0 && below(2) == 0) ++tick;
      trace.tick_of_moments.push_back(tick);
    }
    TraceEntry entry{"n", "int", {}};
    for (std::size_t tick = 0; tick < size; ++tick) {
      const bool has_value = tick > 0 && !entry.values.back().empty();
      entry.values.push_back(has_value || below(2) == 0 ? std::to_string(below(10)) : "");
    }
    trace.entries.push_back(std::move(entry));
    return trace;
  }

 private:
  RandomStream random_;
};

struct Definition {
  enum class Pattern {
    Never,
    Sometimes,
    LeadsTo,
    LeadsToWithin,
    OnlyAfter,
    AtMost,
    Until,
    Finally,
    AfterNever
  } pattern;
  std::unique_ptr<Term> left, right;
  std::size_t ticks = 0;

  std::string text() const {
    const std::string l = left->text(), r = right->text(), n = std::to_string(ticks) + " ticks";
    switch (pattern) {
      case Pattern::Never:
        return "never " + l;
      case Pattern::Sometimes:
        return "sometimes " + l;
      case Pattern::LeadsTo:
        return l + " leads to " + r;
      case Pattern::LeadsToWithin:
        return l + " leads to " + r + " within " + n;
      case Pattern::OnlyAfter:
        return l + " only after " + r;
      case Pattern::AtMost:
        return l + " at most " + n;
      case Pattern::Until:
        return l + " until " + r;
      case Pattern::Finally:
        return "finally " + l;
      case Pattern::AfterNever:
        return "after " + l + " never " + r;
    }
    return {};
  }

  // The verdict on a whole trace, word by word of docs/properties.md: in the order of its moments,
  // where numbers of ticks are about the ticks that these are in.
  std::string verdict(const Trace& trace, bool is_cut) const {
    const std::string owed = is_cut ? "open" : "violated";
    const std::size_t size = trace.size();
    const auto l = [&](std::size_t tick) { return left->holds(trace, tick); };
    const auto r = [&](std::size_t tick) { return right->holds(trace, tick); };
    const auto any = [](std::size_t from, std::size_t end, const auto& is_so) {
      for (; from < end; ++from) {
        if (is_so(from)) return true;
      }
      return false;
    };
    const auto at_tick = [](const char* word, std::size_t tick) {
      return std::string(word) + " " + std::to_string(tick);
    };
    const auto at = [&](const char* word, std::size_t moment) {
      return at_tick(word, trace.tick_of(moment));
    };
    // One past the last moment up to a tick.
    const auto end_of = [&](std::size_t tick) {
      std::size_t end = 0;
      while (end < size && trace.tick_of(end) <= tick) ++end;
      return end;
    };
    switch (pattern) {
      case Pattern::Never:
        for (std::size_t i = 0; i < size; ++i) {
          if (l(i)) return at("violated", i);
        }
        return "holds";
      case Pattern::Sometimes:
        for (std::size_t i = 0; i < size; ++i) {
          if (l(i)) return at("holds", i);
        }
        return owed;
      case Pattern::LeadsTo:
        for (std::size_t i = 0; i < size; ++i) {
          if (l(i) && !any(i, size, r)) return owed;
        }
        return "holds";
      case Pattern::LeadsToWithin:
        for (std::size_t i = 0; i < size; ++i) {  // the earliest is due first
          if (!l(i)) continue;
          const std::size_t due = trace.tick_of(i) + ticks;
          if (any(i, end_of(due), r)) continue;
          return due <= trace.tick_of(size - 1) ? at_tick("violated", due) : owed;
        }
        return "holds";
      case Pattern::OnlyAfter:
        for (std::size_t i = 0; i < size; ++i) {
          if (any(0, i + 1, r)) return at("holds", i);
          if (l(i)) return at("violated", i);
        }
        return "holds";
      case Pattern::AtMost:
        for (std::size_t i = 0; i < size; ++i) {
          std::size_t first = i + 1;  // of the moments in a row that end with this one
          while (first > 0 && l(first - 1)) --first;
          const bool is_row = first <= i;
          if (is_row && trace.tick_of(i) - trace.tick_of(first) + 1 > ticks) {
            return at("violated", i);
          }
        }
        return "holds";
      case Pattern::Until:
        for (std::size_t i = 0; i < size; ++i) {
          if (r(i)) return at("holds", i);
          if (!l(i)) return at("violated", i);
        }
        return owed;
      case Pattern::Finally:
        if (is_cut) return "open";
        return size > 0 && l(size - 1) ? "holds" : "violated";
      case Pattern::AfterNever:
        for (std::size_t i = 0; i < size; ++i) {
          if (r(i) && any(0, i, l)) return at("violated", i);
        }
        return "holds";
    }
    return {};
  }
};

}  // namespace

TEST_CASE("random properties have the verdict of their definition on random traces") {
  std::map<std::string, int> seen;
  for (std::uint64_t seed = 0; seed < kProperties; ++seed) {
    Generator make(seed);
    const Definition definition{static_cast<Definition::Pattern>(make.below(9)), make.term(3),
                                make.term(2), make.below(4)};
    for (int i = 0; i < 10; ++i) {
      const Trace trace = make.trace();
      const auto property = Property::parse(definition.text(), trace.names());
      INFO("seed " << seed << ": " << definition.text());
      REQUIRE(property);
      for (const bool is_cut : {false, true}) {
        const auto end = is_cut ? RunIsOver::FromOutside : RunIsOver::ByItself;
        const std::string expected = definition.verdict(trace, is_cut);
        REQUIRE(verdict_of(*property, trace, end) == expected);
        ++seen[expected.substr(0, expected.find(' '))];
      }
    }
  }
  for (const char* verdict : {"holds", "violated", "open"}) CHECK(seen[verdict] > 1000);
}

TEST_CASE("a state that is copied goes on as the original") {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Generator make(seed);
    const Definition definition{static_cast<Definition::Pattern>(make.below(9)), make.term(2),
                                make.term(2), make.below(4)};
    const Trace trace = make.trace();
    const auto property = Property::parse(definition.text(), trace.names());
    REQUIRE(property);
    // Each tick on a copy of the bytes, as a search does; the last state decides.
    std::vector<std::byte> state(property->state_size() + 1, std::byte{0xee});
    property->begin(state.data());
    PropertyVerdict verdict = PropertyVerdict::Open;
    for (std::size_t tick = 0; tick < trace.size(); ++tick) {
      std::vector<SeenNode> nodes;
      for (const auto node : property->nodes()) nodes.push_back(trace.seen(node, tick));
      const auto compared = std::make_unique<bool[]>(property->comparisons().size());
      for (std::size_t i = 0; i < property->comparisons().size(); ++i) {
        const std::string& value = trace.entries[0].values[tick];
        const EntryComparison& it = property->comparisons()[i];
        compared[i] = value.empty() ? it.holds_without_value() : it.holds_for_text(value);
      }
      std::vector<std::byte> copy = state;
      verdict = property->step(
          copy.data(), {nodes, {compared.get(), property->comparisons().size()}}, trace.part(tick));
      state = std::move(copy);
      if (verdict == PropertyVerdict::Violated) break;
    }
    if (verdict == PropertyVerdict::Open) verdict = property->at_end(state.data());
    const std::string expected = definition.verdict(trace, false);
    INFO("seed " << seed << ": " << definition.text());
    CHECK(to_string(verdict) == expected.substr(0, expected.find(' ')));
    CHECK(state.back() == std::byte{0xee});  // nothing behind it is touched
  }
}

}  // namespace lockstep::host::test
