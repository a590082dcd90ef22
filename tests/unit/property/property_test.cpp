// What each property means: tables of traces with verdicts.
#include "language/property/property.h"

#include <catch2/catch.hpp>

#include "unit/property/trace.h"

namespace lockstep::host::test {
namespace {

const char* const kA = "Main/both/a";
const char* const kB = "Main/both/b";

Property parsed(std::string_view text, const PropertyNames& names) {
  auto property = Property::parse(text, names);
  INFO(text << ": " << (property ? "" : property.error().message));
  REQUIRE(property);
  return std::move(*property);
}

// Of a run that has ended by itself.
std::string verdict(std::string_view text, const Trace& trace,
                    RunIsOver end = RunIsOver::ByItself) {
  return verdict_of(parsed(text, trace.names()), trace, end);
}

// How it ends if it is told from outside: only debts that are not paid differ.
std::string cut_verdict(std::string_view text, const Trace& trace) {
  return verdict(text, trace, RunIsOver::FromOutside);
}

struct PropertyRow {
  const char* property;
  const char* a;
  const char* b;
  const char* ended;  // by itself
  const char* cut;    // from outside
};

}  // namespace

TEST_CASE("each pattern has its verdict on a trace") {
  constexpr PropertyRow kRows[] = {
      {"never a.failure", "rrrr", "iiii", "holds", "holds"},
      {"never a.failure", "rrfr", "iiii", "violated 2", "violated 2"},
      {"sometimes a.failure", "rrrr", "iiii", "violated", "open"},
      {"sometimes a.failure", "rrfr", "iiii", "holds 2", "holds 2"},
      // the same tick pays
      {"a.failure leads to b.success", "rfrr", "isii", "holds", "holds"},
      // one before does not
      {"a.failure leads to b.success", "rfrr", "siii", "violated", "open"},
      // one success pays all that is owed
      {"a.failure leads to b.success", "ffrrr", "iiisi", "holds", "holds"},
      {"a.failure leads to b.success", "fffrf", "iiisi", "violated", "open"},
      {"a.failure leads to b.success within 0 ticks", "rfr", "isi", "holds", "holds"},
      {"a.failure leads to b.success within 0 ticks", "rfr", "iis", "violated 1", "violated 1"},
      // the tick of the failure is not counted
      {"a.failure leads to b.success within 2 ticks", "frrr", "iisi", "holds", "holds"},
      {"a.failure leads to b.success within 2 ticks", "frrr", "iiis", "violated 2", "violated 2"},
      // the oldest debt is due first
      {"a.failure leads to b.success within 2 ticks", "ffrr", "iiis", "violated 2", "violated 2"},
      {"a.failure leads to b.success within 3 ticks", "frr", "iii", "violated", "open"},
      {"a.failure leads to b.success within 1 tick", "fff", "sss", "holds", "holds"},
      {"b.running only after a.success", "rss", "irr", "holds 1", "holds 1"},
      {"b.running only after a.success", "rrs", "iri", "violated 1", "violated 1"},
      {"b.running only after a.success", "rrr", "iii", "holds", "holds"},
      // in the same tick is soon enough
      {"b.running only after a.success", "rsi", "iri", "holds 1", "holds 1"},
      // the tick itself does not count
      {"after a.success never b.running", "rsr", "iri", "holds", "holds"},
      {"after a.success never b.running", "rsr", "rir", "violated 2", "violated 2"},
      {"after a.success never a.success", "rsir", "iiii", "holds", "holds"},
      {"after a.success never a.success", "rsrs", "iiii", "violated 3", "violated 3"},
      {"a.held at most 2 ticks", "rhhrhh", "iiiiii", "holds", "holds"},
      {"a.held at most 2 ticks", "rhhrhhh", "iiiiiii", "violated 6", "violated 6"},
      {"a.held at most 0 ticks", "rrh", "iii", "violated 2", "violated 2"},
      {"a.held at most 1000 ticks", "hhh", "iii", "holds", "holds"},
      {"a.running until b.success", "rrrf", "iisi", "holds 2", "holds 2"},
      {"a.running until b.success", "rfrr", "iiss", "violated 1", "violated 1"},
      {"a.running until b.success", "rrrr", "iiii", "violated", "open"},
      {"finally a.failure", "rrrf", "iiii", "holds", "open"},
      {"finally a.failure", "rrfr", "iiii", "violated", "open"},
      // what holds until then need not hold in that tick
      {"a.running until b.success", "rf", "is", "holds 1", "holds 1"},
      {"a.running until b.success", "f", "s", "holds 0", "holds 0"},
  };
  for (const PropertyRow& row : kRows) {
    const Trace trace{{{kA, row.a}, {kB, row.b}}};
    INFO(row.property << " on " << row.a << " and " << row.b);
    CHECK(verdict(row.property, trace) == row.ended);
    CHECK(cut_verdict(row.property, trace) == row.cut);
  }
}

TEST_CASE("what a property says of a node is what a recording says") {
  const std::pair<const char*, const char*> kFields[] = {
      {"running", "rh"}, {"success", "s"}, {"failure", "f"}, {"idle", "i"},
      {"skipped", "k"},  {"done", "sf"},   {"held", "h"},    {"ticked", "rsfk"}};
  for (const auto& [field, letters] : kFields) {
    for (const char letter : std::string("rhsfik")) {
      const Trace trace{{{kA, std::string(1, letter)}}};
      const bool is_so = std::string(letters).find(letter) != std::string::npos;
      INFO(field << " of " << letter);
      CHECK(verdict(std::string("never a.") + field, trace) == (is_so ? "violated 0" : "holds"));
    }
  }
}

TEST_CASE("not binds before and, which binds before or") {
  const auto holds = [](const char* formula, const char* a, const char* b) {
    const Trace trace{{{kA, a}, {kB, b}}};
    return verdict(std::string("sometimes ") + formula, trace) == "holds 0";
  };
  CHECK(holds("a.running or b.running and b.failure", "r", "i"));
  CHECK_FALSE(holds("(a.running or b.running) and b.failure", "r", "i"));
  CHECK(holds("not a.running and b.running", "i", "r"));
  CHECK_FALSE(holds("not (a.running or b.running)", "i", "r"));
  CHECK(holds("not not a.running", "r", "i"));
  CHECK(holds("a.idle or a.running and b.running or b.idle", "r", "r"));
}

TEST_CASE("progress is compared within the tolerance of barriers") {
  const auto holds = [](const std::string& relation, double progress) {
    const Trace trace{{{kA, "r", {progress}}}};
    return verdict("sometimes a.progress " + relation + " 0.5", trace) == "holds 0";
  };
  const double below = 0.5 - 1e-12, above = 0.5 + 1e-12;
  for (const double same : {below, 0.5, above}) {
    CHECK(holds("==", same));
    CHECK(holds("<=", same));
    CHECK(holds(">=", same));
    CHECK_FALSE(holds("!=", same));
    CHECK_FALSE(holds("<", same));
    CHECK_FALSE(holds(">", same));
  }
  CHECK(holds("<", 0.49));
  CHECK(holds(">", 0.51));
  CHECK(holds("!=", 0.51));
}

TEST_CASE("entries are compared as numbers or as texts, and without a value equal nothing") {
  const auto holds = [](const std::string& comparison, const char* type, const char* value) {
    const Trace trace{{{kA, "r"}}, {{"x", type, {value}}}};
    return verdict("sometimes {x} " + comparison, trace) == "holds 0";
  };
  CHECK(holds("== 3", "int", "3"));
  CHECK(holds("< 3.5", "double", "3"));
  CHECK(holds(">= -2", "double", "-2"));
  CHECK(holds("== 0.3", "double", "0.30000000000000004"));
  CHECK_FALSE(holds("== 3", "int", ""));
  CHECK_FALSE(holds("< 3", "int", ""));
  CHECK(holds("!= 3", "int", ""));
  CHECK(holds("== 'kitchen'", "string", "kitchen"));
  CHECK(holds("!= \"it's\"", "string", "kitchen"));
  CHECK(holds("== true", "bool", "true"));
  CHECK_FALSE(holds("!= true", "bool", "true"));
}

TEST_CASE("a live value and its text in a recording compare alike") {
  const std::vector<Value> values = {Value(),
                                     Value(true),
                                     Value(false),
                                     Value(std::int64_t{3}),
                                     Value(3.0),
                                     Value(3.25),
                                     Value(-1e300),
                                     Value(std::string("3")),
                                     Value(std::string("kitchen")),
                                     Value(std::string(300, 'x')),
                                     Value(std::vector<double>{3}),
                                     Value(std::vector<double>{1, 2}),
                                     Value(std::vector<std::string>{"a", "b"})};
  std::vector<EntryComparison> comparisons;
  for (const Relation relation :
       {Relation::Equal, Relation::NotEqual, Relation::Less, Relation::GreaterEqual}) {
    for (const double number : {3.0, -2.0, 3.25}) {
      comparisons.push_back({.relation = relation, .number = number});
    }
  }
  for (const char* text : {"true", "3", "kitchen", "a;b", "1;2"}) {
    comparisons.push_back({.relation = Relation::Equal, .text = text});
    comparisons.push_back({.relation = Relation::NotEqual, .text = text});
  }
  std::string room;
  for (const Value& value : values) {
    for (const EntryComparison& it : comparisons) {
      INFO(to_text(value) << ", relation " << static_cast<int>(it.relation) << " "
                          << it.number.value_or(0) << " '" << it.text << "'");
      const bool has_value = !std::holds_alternative<NoValue>(value);
      const bool recorded =
          has_value ? it.holds_for_text(to_text(value)) : it.holds_without_value();
      CHECK(it.holds_for(value, room) == recorded);
    }
  }
}

TEST_CASE("a node is named by its path or an end of it that no other has") {
  const PropertyNames names{.paths = {"Main", "Main/left", "Main/left/arm", "Main/right",
                                      "Main/right/arm", "Main/right/arm#2", "Main/pick up"},
                            .entries = {}};
  const auto node = [&](const std::string& name) {
    return parsed("never " + name + ".running", names).nodes()[0];
  };
  CHECK(node("Main") == 0);
  CHECK(node("left") == 1);
  CHECK(node("left/arm") == 2);
  CHECK(node("Main/right/arm") == 4);
  CHECK(node("arm#2") == 5);
  CHECK(node("'pick up'") == 6);
  CHECK(node("\"Main/pick up\"") == 6);
}

TEST_CASE("a path that is the end of another means itself") {
  const PropertyNames names{.paths = {"arm", "Main/arm"}, .entries = {}};
  CHECK(parsed("never arm.running", names).nodes()[0] == 0);
  CHECK(parsed("never Main/arm.running", names).nodes()[0] == 1);
}

TEST_CASE("a property has a name, or is its own") {
  const PropertyNames names{.paths = {"Main", "Main/a"}, .entries = {}};
  const Property named = parsed(" grip :  never a.running ", names);
  CHECK(named.name() == "grip");
  CHECK(named.text() == "never a.running");
  CHECK(parsed("'no grip': never a.running", names).name() == "no grip");
  CHECK(parsed("never a.running", names).name() == "never a.running");
}

TEST_CASE("verify learns which nodes a property names and which progress it compares") {
  const PropertyNames names{.paths = {"Main", "Main/a", "Main/b"}, .entries = {}};
  const Property it =
      parsed("b.progress < 0.25 and a.held leads to b.progress >= 0.5 within 300 ticks", names);
  CHECK(std::vector<std::uint32_t>(it.nodes().begin(), it.nodes().end()) ==
        std::vector<std::uint32_t>{2, 1});
  const auto cuts = it.progress_comparisons();
  REQUIRE(cuts.size() == 2);
  CHECK(cuts[0].node == 2);
  CHECK(cuts[0].constant == 0.25);
  CHECK(cuts[1].relation == Relation::GreaterEqual);
  CHECK(it.needs_progress(0));
  CHECK_FALSE(it.needs_progress(1));
}

TEST_CASE("a state has as few bytes as its largest number") {
  const PropertyNames names{.paths = {"Main", "Main/a"}, .entries = {}};
  const std::pair<const char*, std::size_t> kSizes[] = {
      {"never a.running", 0},
      {"sometimes a.running", 1},
      {"finally a.running", 1},
      {"a.running until a.failure", 1},
      {"a.running leads to a.failure", 1},
      {"a.running leads to a.failure within 0 ticks", 1},
      {"a.running leads to a.failure within 255 ticks", 2},
      {"a.running leads to a.failure within 256 ticks", 2},
      {"a.held at most 255 ticks", 1},
      {"a.held at most 1000000000 ticks", 4}};
  for (const auto& [text, size] : kSizes) {
    INFO(text);
    CHECK(parsed(text, names).state_size() == size);
  }
}

TEST_CASE("a limit is exact, whatever its size") {
  for (const std::size_t limit : {1u, 255u, 256u, 70'000u}) {
    const std::string text = "a.held at most " + std::to_string(limit) + " ticks";
    const Trace just{{{kA, std::string(limit, 'h') + "r"}}};
    const Trace more{{{kA, std::string(limit + 1, 'h')}}};
    CHECK(verdict(text, just) == "holds");
    CHECK(verdict(text, more) == "violated " + std::to_string(limit));
    const std::string within = "a.failure leads to a.success within " + std::to_string(limit);
    const Trace paid{{{kA, "f" + std::string(limit - 1, 'r') + "s"}}};
    const Trace late{{{kA, "f" + std::string(limit, 'r') + "s"}}};
    CHECK(verdict(within + " ticks", paid) == "holds");
    CHECK(verdict(within + " ticks", late) == "violated " + std::to_string(limit));
  }
}

TEST_CASE("where ticks are missing, what is open stays open") {
  const Trace trace{{{kA, "r"}}};
  PropertyChecks checks(
      {parsed("never a.failure", trace.names()), parsed("sometimes a.running", trace.names())});
  checks.seen()[0] = checks.seen()[1] = {.status = Status::Running, .ticked = true};
  checks.step(0);
  checks.give_up();
  checks.seen()[0].status = Status::Failure;
  CHECK(checks.step(5).empty());
  checks.end(RunIsOver::ByItself);
  CHECK(checks.verdict(0) == PropertyVerdict::Open);
  CHECK(checks.verdict(1) == PropertyVerdict::Holds);
}

}  // namespace lockstep::host::test
