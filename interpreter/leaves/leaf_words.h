// The words of a leaf file, once: for its reader and for the XSD.
#pragma once

#include <span>
#include <string_view>

#include "base/core/behavior.h"

namespace lockstep::host::leaf_words {

struct Word {
  std::string_view name;
  std::string_view pattern;  // of its value, in XSD; "": any text that is not empty
  std::string_view doc;
  bool required = false;
  bool may_be_empty = false;
};

inline constexpr Word kRoot[] = {
    {"lockstep", "1", "The version of the leaf model.", true},
    {"rate", R"([0-9]*\.?[0-9]+)", "Ticks per second."},
};
inline constexpr Word kFact[] = {
    {"name", "[A-Za-z_][A-Za-z0-9_]*", "What leaves call it.", true},
    {"changes", "never|freely|rises|falls",
     "How it changes by itself: never (it is unknown, but constant), freely (the default), rises "
     "(from false to true at most), falls."},
    {"starts", "true|false", "What it is at the start; unknown when absent."},
    {"chance", R"([0-9]*\.?[0-9]+([eE]-[0-9]+)?)",
     "The probability that it is true whenever it is looked at and may be both."},
};
inline constexpr Word kLeaf[] = {
    {"of", "", "The leaves of this type. Or give 'path'."},
    {"path", "", "The leaves with this path; * stands for any part of it."},
    {"result",
     R"((success|failure|skipped|fault)(:[0-9]*\.?[0-9]+([eE]-[0-9]+)?)?)"
     R"((;(success|failure|skipped|fault)(:[0-9]*\.?[0-9]+([eE]-[0-9]+)?)?)*)",
     "The results that may come, or each with its chance: success:0.7;failure:0.3."},
    {"ticks", R"([0-9]+(\.\.([0-9]+|inf))?)",
     "Ticks that an activation gets until it completes; 1..inf when absent."},
    {"ends", "yes|no",
     "yes: an activation that is ticked again and again ends some time, which is assumed; no: it "
     "may run indefinitely."},
    {"progress", "none|cuts|grid:[1-9][0-9]*",
     "Which values are distinguished: cuts (what the barriers and properties compare it with) or "
     "parts of the same size."},
    {"step", R"(-?[0-9]+(\.\.(-?[0-9]+|inf))?)",
     "How far a tick may take the progress, in cuts or parts."},
    {"finish", "full|any", "full: it succeeds only by reaching 1."},
    {"held", R"(still|-?[0-9]+\.\.-?[0-9]+)",
     "How far its progress goes in each tick that is withheld, in cuts or parts."},
    {"fact", "[A-Za-z_][A-Za-z0-9_]*", "Its result is this fact."},
    {"sets", "[A-Za-z_][A-Za-z0-9_]*=(true|false)(;[A-Za-z_][A-Za-z0-9_]*=(true|false))*",
     "Facts that its success makes true or false."},
    {"sets_on_failure",
     "[A-Za-z_][A-Za-z0-9_]*=(true|false)(;[A-Za-z_][A-Za-z0-9_]*=(true|false))*",
     "Facts that its failure makes true or false."},
    {"on_resume", "(restart|continue|failure|success)(;(restart|continue|failure|success))*",
     "What it may do when it ran at a cut of the process: start again, continue, or return a "
     "result."},
    {"writes", "success|start|tick|any",
     "When it writes its outputs: with its success, at its start, in each tick, or any (the "
     "default): in any of its ticks or not."},
};
// A leaf also has "out.PORT".
inline constexpr std::string_view kOutput = kOutputWord;
inline constexpr Word kAccept[] = {
    {"finding", "", "The name of a finding, as verify gives it.", true},
    {"because", "", "Why it is as it should be.", true},
};
inline constexpr Word kTree[] = {
    {"ends", "yes|no",
     "no: the tree is meant to run indefinitely, so a run without an end is not a finding.", true},
};

struct Tag {
  std::string_view name;
  std::span<const Word> words;
  std::string_view doc;
};
inline constexpr Tag kTags[] = {
    {"tree", kTree, "What is expected of the whole tree."},
    {"fact", kFact, "Something about the world that leaves look at or change."},
    {"leaf", kLeaf, "What some leaves may do. Later rows win."},
    {"accept", kAccept, "A finding that is as it should be."},
};

}  // namespace lockstep::host::leaf_words
