// The lines of a recording: each key that one may have, its type and what it means. Whoever writes
// or reads a line in C++ takes its keys from here: another key does not compile. From this table
// `./dev generate` makes the tables of docs/recording.md, schema/recording.schema.json and the
// types of the page, show/web/page/src/model/recording.ts; a test fails when one of them is stale.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <variant>

#include "record/header_and_end.h"

namespace lockstep::host {

constexpr int kRecordingVersion = 1;

namespace lines {

// A value by itself: what TypeScript calls it, and what it is in a JSON Schema.
struct Value {
  std::string_view name, typescript, schema;
};

constexpr Value kValues[] = {
    {"Text", "string", R"("type": "string")"},
    {"Texts", "Record<string, string>",
     R"("type": "object", "additionalProperties": {"type": "string"})"},
    {"Version", "number", R"("const": 1)"},
    {"Whole", "number", R"("type": "integer", "minimum": 0)"},
    {"Index", "number", R"("type": "integer", "minimum": 0)"},
    {"Real", "number", R"("type": "number")"},
    {"Seconds", "number", R"("type": "number", "minimum": 0)"},
    {"Progress", "number", R"("type": "number", "minimum": 0, "maximum": 1)"},
    {"Bit", "number", R"("enum": [0, 1])"},
    {"Yes", "boolean", R"("const": true)"},
    {"Clock", R"("wall" | "virtual")", R"("enum": ["wall", "virtual"])"},
    {"TickMode", R"("exactly-once")", R"("const": "exactly-once")"},
    {"IdleMembers", R"("ignore" | "wait")", R"("enum": ["ignore", "wait"])"},
    {"Level", "string", R"("enum": ["debug", "info", "warning"])"},
};

// Values that come in this order, as a list.
struct Tuple {
  struct Part {
    std::string_view name, type;
  };
  std::string_view name;
  std::array<Part, 7> parts;  // without a name: there are no more
};

// Also of the statuses, whose names are in base/core/status.h: "StatusName".
constexpr Tuple kTuples[] = {
    {"NodeChange",
     {{{"index", "Index"},
       {"status", "StatusName"},
       {"progress", "Progress"},
       {"ticked", "Bit"},
       {"held", "Bit"}}}},
    {"MomentNode",
     {{{"index", "Index"}, {"status", "StatusName"}, {"ticked", "Bit"}, {"held", "Bit"}}}},
    {"Moment", {{{"times", "Whole"}, {"nodes", "MomentNode[]"}}}},
    {"LimitChange", {{{"index", "Index"}, {"limit", "Real | null"}}}},
    {"RoundChange", {{{"index", "Index"}, {"number", "Whole"}, {"of", "Whole"}}}},
    {"FactorChange", {{{"index", "Index"}, {"factor", "Real"}}}},
    {"ReasonChange", {{{"index", "Index"}, {"reason", "Text"}}}},
    {"GivenAnswer", {{{"index", "Index"}, {"answer", "Text"}, {"who", "Text"}}}},
    {"Fault", {{{"index", "Index"}, {"message", "Text"}}}},
    {"EntryValue", {{{"index", "Index"}, {"value", "Text | null"}}}},
    {"LogLine", {{{"who", "Text"}, {"level", "Level"}, {"text", "Text"}}}},
    {"NodeCounts",
     {{{"index", "Index"},
       {"succeeded", "Whole"},
       {"failed", "Whole"},
       {"skipped", "Whole"},
       {"halted", "Whole"},
       {"held", "Whole"},
       {"faults", "Whole"}}}},
    {"EntryCount", {{{"index", "Index"}, {"values", "Whole"}}}},
    {"HeardWord", {{{"index", "Index"}, {"run", "Whole"}, {"word", "Whole"}}}},
    {"LeafProgress", {{{"moment", "Whole"}, {"index", "Index"}, {"progress", "Progress"}}}},
};

// Where a header or an end keeps the value; none: the value has a separate reader and writer.
using Member =
    std::variant<std::monostate, std::string RecordingHeader::*, std::uint64_t RecordingHeader::*,
                 double RecordingHeader::*, std::optional<double> RecordingHeader::*,
                 std::map<std::string, std::string, std::less<>> RecordingHeader::*,
                 std::vector<ShapeNode> RecordingHeader::*,
                 std::vector<ShapeEntry> RecordingHeader::*, std::string RecordedEnd::*,
                 std::uint64_t RecordedEnd::*, std::optional<std::uint64_t> RecordedEnd::*,
                 double RecordedEnd::*, std::vector<std::string> RecordedEnd::*,
                 std::vector<LeafLine> RecordedEnd::*>;

struct Field {
  enum class Has { Always, Maybe };
  std::string_view key;
  std::string_view type;  // one of the names above or below; "[]": a list of these
  Has has;
  std::string_view meaning;
  Member member = {};
};

struct Object {
  std::string_view name;
  std::span<const Field> fields;

  // The key, which the object has.
  consteval std::string_view operator[](std::string_view key) const {
    for (const Field& it : fields) {
      if (it.key == key) return it.key;
    }
    throw "no such key: record/lines.h has the table";
  }
};

constexpr auto kAlways = Field::Has::Always, kMaybe = Field::Has::Maybe;

constexpr Field kHeaderFields[] = {
    {"lockstep_recording", "Version", kAlways,
     "version of this format: 1. A reader refuses any other number, and skips keys that it does "
     "not know"},
    {"tree", "Text", kAlways, "ID of the tree that runs", &RecordingHeader::id},
    {"file", "Text", kAlways, "the tree file as it was named on the command line",
     &RecordingHeader::file},
    {"version", "Text", kAlways, "the version of lockstep", &RecordingHeader::version},
    {"law", "Whole", kMaybe,
     "the [version of the semantics](nodes-and-attributes.md#versions-of-the-semantics) that the "
     "run followed; 1 when it is absent",
     &RecordingHeader::law},
    {"rate_hz", "Real", kAlways, "ticks per second", &RecordingHeader::rate_hz},
    {"clock", "Clock", kAlways, "`wall` or `virtual`", &RecordingHeader::clock},
    {"seed", "Whole", kAlways, "the seed of the random numbers", &RecordingHeader::seed},
    {"arguments", "Texts", kAlways, "the values of the load-time arguments, as strings",
     &RecordingHeader::arguments},
    {"values", "Texts", kMaybe,
     "only if there are any: the start values of blackboard entries that the run was given, as "
     "strings, such as by `--set`",
     &RecordingHeader::values},
    {"nodes", "HeaderNode[]", kAlways,
     "every node in pre-order, and behind the nodes of the tree what is outside the trees: "
     "barriers and pools of resources",
     &RecordingHeader::nodes},
    {"entries", "HeaderEntry[]", kMaybe,
     "only if there are any: the blackboard entries in the recording. `--record-entries` chooses "
     "them",
     &RecordingHeader::entries},
    {"first_tick", "Whole", kMaybe,
     "only in a part of a recording that is [not the first](#parts): the number of its first tick, "
     "whose line has the whole state",
     &RecordingHeader::first_tick},
    {"resumed_after_s", "Real", kMaybe,
     "only in the first part after a [cut](resume.md#recordings): for how long there was no run, "
     "in seconds",
     &RecordingHeader::resumed_after},
    {"verify", "Text", kMaybe,
     "of a run that `lockstep verify` has found: the finding, and from which tick on it repeats",
     &RecordingHeader::verify},
    {"tick", "TickMode", kMaybe,
     "only of a run with `--tick exactly-once`: a node of a tree for BehaviorTree.CPP that "
     "requests "
     "another tick gets it in the next period",
     &RecordingHeader::tick},
    {"run", "Whole", kMaybe,
     "only of a robot in a [team](team.md): a random number, by which `heard` in the recordings of "
     "the other robots names this run",
     &RecordingHeader::run},
};
constexpr Object kHeader{"Header", kHeaderFields};

constexpr Field kHeaderNodeFields[] = {
    {"index", "Index", kAlways, "its place in the list"},
    {"path", "Text", kAlways, "its path"},
    {"kind", "Text", kAlways, "its tag"},
    {"name", "Text", kAlways, "its name"},
    {"parent", "Index | null", kAlways,
     "an index; `null` for the root and for what is outside the trees"},
    {"barriers", "Progress[] | null", kMaybe,
     "of a ParallelAbsolute and of a barrier outside the trees; `null` if the value is a "
     "blackboard entry"},
    {"delta", "Progress | null", kMaybe,
     "of a ParallelRelative; `null` if the value is a blackboard entry"},
    {"idle", "IdleMembers", kMaybe, "`ignore` for a barrier that leaves out idle members"},
    {"resources", "Text[]", kMaybe, "of a pool of resources: their names"},
    {"members", "Index[]", kMaybe,
     "of what is outside the trees: the nodes that the SyncProgress nodes of a barrier hold, or "
     "the children of the UseResources nodes of a pool"},
    {"pace", "Yes", kMaybe, "for a node that [paces](pacing.md) what it holds"},
    {"condition", "Text", kMaybe, "of a node that a script decides: the script"},
    {"reads", "Text[]", kMaybe, "with `condition`: the keys of the entries that it reads"},
    {"ports", "Texts", kMaybe,
     "only if there are any: its ports or parameters with their values, as strings; `{key}` for a "
     "blackboard entry. Values of more than 256 bytes and objects are left out"},
    {"options", "Text[]", kMaybe,
     "of an [Ask](people.md): the answers that it takes. The text of its question is its reason "
     "while it is running"},
    {"default", "Text", kMaybe, "with `options`: the answer when the time is over"},
    {"timeout_s", "Seconds", kMaybe, "with `options`: that time, unless an entry gives it"},
    {"severity", "Text", kMaybe,
     "with `options`: `info`, `warning` or `critical`, unless an entry gives it"},
    {"guard", "Yes", kMaybe,
     "for a child of a parallel, and for the child of a SyncProgress, that contains no action: it "
     "is a [guard](language.md#guards), and part of no measure"},
};
constexpr Object kHeaderNode{"HeaderNode", kHeaderNodeFields};

constexpr Field kHeaderEntryFields[] = {
    {"key", "Text", kAlways, "its key"},
    {"type", "Text", kAlways, "its type"},
    {"strict", "Yes", kMaybe,
     "for an entry that holds values of its type only. Absent where an entry may have a value of "
     "another type, as in a tree for BehaviorTree.CPP, and in recordings of earlier versions"},
    {"writers", "Index[]", kMaybe,
     "only if there are any: the nodes with a port or a script that may write it"},
};
constexpr Object kHeaderEntry{"HeaderEntry", kHeaderEntryFields};

constexpr Field kTickFields[] = {
    {"tick", "Whole", kAlways, "number of the tick: 0, 1, 2, …"},
    {"time_s", "Seconds", kAlways,
     "seconds from the start of the run to the start of this tick, exact to the nanosecond"},
    {"nodes", "NodeChange[]", kAlways,
     "{} for each node with a change since the line before. A node that no line has named yet is "
     "`idle, 0, 0, 0`"},
    {"limits", "LimitChange[]", kMaybe,
     "only if there are any: {} for each synchronized node whose limit differs from the line "
     "before. For a ParallelAbsolute "
     "it is the barrier at which this tick holds its children, `null` when none is left; for a "
     "ParallelRelative it is delta. For a UseResources, it is the sum of 2^i over the resources "
     "that it owns in this tick, i being their places in the pool's `resources`; negative: over "
     "those that it waits for; 0: neither. One that waits while it owns others has the negative "
     "sum of 2^52, of 2^26 times the sum of what it owns, and of the sum of what it waits for"},
    {"rounds", "RoundChange[]", kMaybe,
     "only if there are any: {} for each Retry or Repeat whose round differs from the line before: "
     "the number counts from 1, "
     "and is 0 when the node is not running; `of` is 0 for an endless one"},
    {"factors", "FactorChange[]", kMaybe,
     "only if there are any: {} for each node that is [paced](pacing.md) and whose factor differs "
     "from the line before. Until then it is 1"},
    {"reasons", "ReasonChange[]", kMaybe,
     "only if there are any: {} for each leaf and each Ask whose [reason](why.md) differs from the "
     "line before. "
     "`\"\"`: it gives none any more"},
    {"answers", "GivenAnswer[]", kMaybe,
     "only if there are any: {} for each answer that a person or program has given to an "
     "[Ask](people.md) "
     "since the line before: `who` is the terminal, a user of the page, or another client"},
    {"heard", "HeardWord[]", kMaybe,
     "only of a robot in a [team](team.md): {} for each node that stands for another robot and has "
     "heard a new word since the line before. That robot sent it after `word` ticks of the run "
     "that its header calls `run`. `word` 0, after a cut: none has been heard since"},
    {"succeeded", "Index[]", kMaybe,
     "only if there are any: the synchronized nodes, the children of parallels and the children of "
     "SyncProgress nodes that succeeded in this tick and are idle after it, because an ancestor "
     "ended in the same tick"},
    {"moments", "Moment[]", kMaybe,
     "only of a tick in which nodes that had completed were ticked again or reset, or held nodes "
     "were halted: {} for each of its [moments](#moments), in their order. `times`: how many in a "
     "row are equal. `nodes`: "
     "`[index, status, ticked, held]` of each node that differs from the moment after it; in the "
     "last moment, from the state after the tick"},
    {"leaf_progress", "LeafProgress[]", kMaybe,
     "of a tick with `moments`: {} for each leaf whose progress at the start of a moment differs "
     "from that at the start of the moment before it. The first moment is 0; before that, it is 0. "
     "Of a tick without `moments`: with moment 0, each running leaf whose progress differs from "
     "the "
     "number in `nodes`"},
    {"more", "NodeCounts[]", kMaybe,
     "only of a tick with more moments than there is room for: {} for each node, how often this "
     "happened to it after the `moments`"},
    {"faults", "Fault[]", kMaybe,
     "only if there are any: {} for each fault of a leaf that counted as its Failure, so that the "
     "run continued. A message has at most 4096 bytes"},
    {"entries", "EntryValue[]", kMaybe,
     "only if there are any: {} for each entry whose value differs from the line before, and for "
     "each of `given`. The value is text, as in a tree. "
     "`null`: a value longer than 256 bytes was written"},
    {"set", "Index[]", kMaybe,
     "only if there are any: those of `entries` that were written between the tick before and this "
     "one, such as by `<set>` of a scenario, in the monitor or by a program that embeds lockstep. "
     "The tree may have written them again in the tick"},
    {"given", "EntryValue[]", kMaybe,
     "only if there are any: {} for each of `set` that the tick has written again, with what came "
     "from outside; `entries` has the value after the tick"},
    {"logs", "LogLine[]", kMaybe,
     "only if there are any: {} for each line that a leaf logged since the line before: the path "
     "of the leaf or the name of its plugin (of a stall that is reported or ended in this tick: "
     "the path of the node; of a property that the tick violates: `property` and its name), "
     "`debug`, `info` or `warning`, the text. At most 64 KiB for each tick; the closing `notes` "
     "count the rest. `--log-level` has no effect"},
    {"whole", "EntryValue[]", kMaybe,
     "only in a line each few thousand ticks: {} for each entry that has a value. The `nodes`, "
     "`limits`, `rounds` and `factors` of that line are the whole state, also what has not "
     "changed. A reader "
     "may begin with it"},
    {"counts", "NodeCounts[]", kMaybe,
     "only in a line with `full`: {} for each node, how often this happened to it until then"},
    {"written", "EntryCount[]", kMaybe,
     "only in a line with `full`: {} for each entry, how many it had until then"},
    {"full", "Yes", kMaybe,
     "only in what [the monitor](monitor.md#for-programs) sends: the line has the whole state, and "
     "nothing before it counts"},
};
constexpr Object kTick{"TickLine", kTickFields};

constexpr Field kLostFields[] = {
    {"ticks", "Whole", kAlways,
     "how many ticks in a row have no line, because the queue to the disk was full"},
    {"from", "Whole", kAlways, "the first of them"},
};
constexpr Object kLost{"Lost", kLostFields};

constexpr Field kContinuedFields[] = {
    {"ticks", "Whole", kAlways, "how many ticks the run had until then"},
};
constexpr Object kContinued{"Continued", kContinuedFields};

constexpr Field kEndFields[] = {
    {"result", "Text", kAlways,
     "the result of the root: `success`, `failure`, `skipped`, or `stopped` when it was still "
     "running; `fault` when a leaf failed as a program",
     &RecordedEnd::result},
    {"reason", "Text", kAlways,
     "`completed`, `fault`, `timeout`, `max_ticks`, `signal`, `overrun` (with `--overrun fail`), "
     "`recording` (with `--on-record-error stop`), `property` (with `--on-violation end`) or "
     "`stopped` (by the program that embeds lockstep)",
     &RecordedEnd::reason},
    {"fault", "Text", kMaybe,
     "only after a fault: the path of the leaf and what it did, in a tick or when it was created",
     &RecordedEnd::fault},
    {"signal", "Whole", kMaybe, "only after a signal: its number", &RecordedEnd::signal},
    {"ticks", "Whole", kAlways, "how many ticks there were", &RecordedEnd::ticks},
    {"time_s", "Seconds", kAlways,
     "how long they took. On the virtual clock the last one also lasts until the next would begin: "
     "ticks / rate",
     &RecordedEnd::time},
    {"overruns", "Whole", kAlways, "ticks that ended too late", &RecordedEnd::overruns},
    {"skipped", "Whole", kAlways, "the deadlines that were skipped because of them",
     &RecordedEnd::skipped},
    {"lost", "Whole", kMaybe, "only if there are any: how many ticks have no line",
     &RecordedEnd::lost},
    {"notes", "Text[]", kMaybe,
     "only if there are any, as texts, of which a reader keeps 1000: other leaves than that of "
     "`fault` that could not be halted, leaves that reported a progress outside [0, 1]",
     &RecordedEnd::notes},
    {"logs", "LogLine[]", kMaybe,
     "only if there are any: what leaves logged after the last tick, for example when they were "
     "halted",
     &RecordedEnd::logs},
};
constexpr Object kEnd{"End", kEndFields};

// Lines that consist of one object under this key.
constexpr Field kLostLineFields[] = {
    {"lost", "Lost", kAlways, "instead of the lines of ticks for which there was no room"},
};
constexpr Object kLostLine{"LostLine", kLostLineFields};
constexpr Field kContinuedLineFields[] = {
    {"continued", "Continued", kAlways,
     "the last line of a [part](#parts): the run continues in the next one"},
};
constexpr Object kContinuedLine{"ContinuedLine", kContinuedLineFields};
constexpr Field kEndLineFields[] = {
    {"end", "End", kAlways, "how the run ended"},
};
constexpr Object kEndLine{"EndLine", kEndLineFields};

// Each line is one of the first five; the others are in them.
constexpr Object kObjects[] = {kHeader,     kTick,        kLostLine, kContinuedLine, kEndLine,
                               kHeaderNode, kHeaderEntry, kLost,     kContinued,     kEnd};
constexpr std::size_t kKinds = 5;

// Visits the members that the table names, in its order. (const Field&, value&)
template <class Record, class Visit>
void each_member(const Object& object, Record& record, Visit visit) {
  for (const Field& field : object.fields) {
    std::visit(
        [&](auto member) {
          if constexpr (requires { record.*member; }) visit(field, record.*member);
        },
        field.member);
  }
}

}  // namespace lines
}  // namespace lockstep::host
