// The words of scenarios, once: for their reader and for the XSD.
#pragma once

#include <string_view>

#include "leaves/leaf_words.h"

namespace lockstep::host::scenario_words {

using leaf_words::Tag;
using leaf_words::Word;

inline constexpr std::string_view kRate = R"([0-9]*\.?[0-9]+)", kCount = "[0-9]+",
                                  kRange = R"([0-9]*\.?[0-9]+(\.\.([0-9]*\.?[0-9]+|inf))?)";
inline constexpr std::string_view
    kResults = "(success|failure|skipped|fault|running)(;(success|failure|skipped|fault|running))*",
    kTick = "once|exactly-once",
    kTickDoc = "exactly-once: the tree is ticked once a period, as with `run --tick`.";

// The attributes of the file hold for all of its scenarios that do not say otherwise.
inline constexpr Word kScenarios[] = {
    {"lockstep", "1", "The version of scenarios.", true},
    {"tree", "", "The tree file, from the directory of this file."},
    {"main", "", "The BehaviorTree to run."},
    {"leaves", "", "A leaf model: leaves without a row do what it allows, by chance."},
    {"rate", kRate, "Ticks per second; 10 when absent."},
    {"tick", kTick, kTickDoc},
};
inline constexpr Word kScenario[] = {
    {"name", "", "What it is about, in a few words. No other in the file has this name.", true},
    {"tree", "", "The tree file, from the directory of this file."},
    {"main", "", "The BehaviorTree to run."},
    {"leaves", "", "A leaf model: leaves without a row do what it allows, by chance."},
    {"rate", kRate, "Ticks per second; 10 when absent."},
    {"tick", kTick, kTickDoc},
    {"max-ticks", kCount,
     "The run ends after so many ticks. When absent, a run that does not end within 10000 is a "
     "failure."},
    {"seed", kCount, "Of the random numbers of the first run; each run after it has the next."},
    {"runs", kCount, "The number of runs, each of which must be as expected."},
    {"verify", "yes|no", "yes: all behaviors that the leaf model allows, as `lockstep verify`."},
};
inline constexpr Word kArgument[] = {
    {"name", "", "An argument of the tree.", true},
    {"value", "", "Its value.", true, true},
};
inline constexpr Word kSet[] = {
    {"key", "", "An entry of the blackboard.", true},
    {"value", "", "Its value from then on, until it is written.", true, true},
    {"tick", kCount, "Before this tick, counted from 0; before the first when absent."},
    {"time", kRate, "Before the first tick at this time or after it, in seconds."},
};
inline constexpr Word kAnswer[] = {
    {"path", "", "The nodes that ask, with this path or this end of it; * stands for any part.",
     true},
    {"value", "", "One of their options.", true},
    {"tick", kCount, "Before this tick, counted from 0; when absent, whenever it is asked."},
    {"time", kRate, "Before the first tick at this time or after it, in seconds."},
};
inline constexpr Word kLate[] = {
    {"tick", kCount, "The tick that takes long, counted from 0.", true},
    {"by", kRate, "So many seconds: deadlines that pass meanwhile are skipped.", true},
};
inline constexpr Word kLeaf[] = {
    {"of", "", "The leaves of this type. Or give 'path'."},
    {"path", "", "The leaves with this path or this end of it; * stands for any part."},
    {"does", "", "What it does in each tick that it gets: R.25 R.5 S. The last word stays."},
    {"each", "", "The same, from the first word on in each activation."},
    {"result", "success|failure|skipped|fault|running", "How each activation ends."},
    {"ticks", kCount,
     "After so many ticks that it gets, its progress rising evenly; 1 when absent."},
    {"seconds", kRate, "After so many seconds of such ticks."},
    {"from", "", "plugin: it is the plugin's; or a recording, in which it does the same."},
};
inline constexpr Word kSubstitutions[] = {
    {"from", "", "A file of JSON with TestNodeConfigs and SubstitutionRules.", true},
};
inline constexpr Word kExpect[] = {
    {"result", kResults, "How the run ends. One of several: success;failure"},
    {"ticks", kRange, "How many ticks it takes: 3, 2..10, 5..inf."},
    {"time", kRange, "How long it takes, in seconds."},
    {"node", "", "The node that has the fault."},
    {"of", "", "With in.PORT: the leaves of this type."},
    {"path", "", "With in.PORT: the leaves with this path or this end of it."},
    {"order", "", "What comes true in this order, with ; between: reach.success; grasp.success"},
    {"same-as", "", "A recording that the run repeats. `lockstep test --update` writes it."},
    {"tolerance", kRate, "How far progress may differ from that."},
};

inline constexpr Tag kTags[] = {
    {"arg", kArgument, "The value of an argument of the tree."},
    {"set", kSet, "The value of an entry."},
    {"answer", kAnswer, "What a person answers to an Ask. Without one, there is no answer."},
    {"leaf", kLeaf, "What some leaves do. Later rows win. Leaves without a row succeed at once."},
    {"late", kLate, "A tick that takes longer than its period."},
    {"substitutions", kSubstitutions,
     "The substitution rules of BehaviorTree.CPP: what leaves do, by name, ID or path."},
    {"expect", kExpect,
     "What is expected. As text: a property, as 'never arm.failure' or 'finally {n} == 3', or a "
     "measure with its limit, as 'spread < 0.1'."},
};
// An expect may also have "in.PORT".
inline constexpr std::string_view kInput = "in.";
// Only in a scenario: a run for each row, whose attributes stand for ${NAME} in it.
inline constexpr std::string_view kRow = "row";

}  // namespace lockstep::host::scenario_words
