// Each row of the tables in docs/btcpp.md that says what remains different has a test that shows
// it.
#include <catch2/catch.hpp>

#include <map>

#include "support/program.h"

using namespace lockstep::host::test;

namespace {

const std::string kSource = LOCKSTEP_SOURCE_DIR "/";

// The first cell of each row, without backticks; not of what classes may have.
std::vector<std::string> rows_of_page() {
  std::vector<std::string> rows;
  for (std::string line : lines(read_file(kSource + "docs/btcpp.md"))) {
    std::erase(line, '`');
    if (line.rfind("| ", 0) != 0 || line.rfind("| |", 0) == 0) continue;
    const std::string row = line.substr(2, line.find(" |", 2) - 2);
    const bool is_no_row = row == "There" || row == "Not there" || row == "Surprise" ||
                           row == "Depth of elements below BehaviorTree" ||
                           row.find("() const") != row.npos || row.rfind("void on", 0) == 0;
    if (!is_no_row) rows.push_back(row);
  }
  return rows;
}

// "row: what happens", by the row.
std::map<std::string, std::string> shown_by(const std::string& file) {
  std::map<std::string, std::string> shown;
  for (const std::string& line : lines(read_file(kSource + "tests/btcpp/programs/" + file))) {
    const auto end = line.find(": ");
    REQUIRE(end != std::string::npos);
    shown[line.substr(0, end)] = line.substr(end);
  }
  return shown;
}

struct Elsewhere {
  std::string row, file, text;  // the text is in that file
};
const Elsewhere kElsewhere[] = {
    {"Ports of your own types", "btcpp/leaves_test.cpp", "a port of an own type reads a text"},
    {"Polymorphic casts", "btcpp/programs/casts.cpp", "registerPolymorphicCast"},
    {"Isolation (--isolate)", "btcpp/leaves_test.cpp", "the same from a separate process"},
    {"config().blackboard", "btcpp/leaves_test.cpp", "not in trees of lockstep's own language"},
    {"emitWakeUpSignal", "btcpp/leaves_test.cpp", "ends the wait for the next period"},
    {"JSON (behaviortree_cpp/json_export.h)", "btcpp/programs/nodes.cpp", "BT_JSON_CONVERTER"},
    {"ThreadedAction", "btcpp/leaves/waiting.cpp", "isHaltRequested"},
    {"PortInfo(", "sdk_template/btcpp_mistakes.cpp", "const PortInfo port("},
    {"ExportBlackboardToJSON", "btcpp/programs/boards.cpp", "json_export.h"},
    {"TimeoutNode, DelayNode, SleepNode", "btcpp/programs/hand_made.cpp", "lockstep_seconds"},
    {"AsyncSequence, AsyncFallback", "btcpp/programs/hand_made.cpp", "setWakeUpInstance"},
    {"A node with children that was skipped", "btcpp/programs/hand_made.cpp", "SKIPPED"},
    {"The classes ScriptNode", "sdk_template/btcpp_mistakes.cpp", "registerNodeType<ScriptNode>"},
    {"SqliteLogger", "sdk_template/btcpp_mistakes.cpp", "SqliteLogger table"},
    {"loggers/groot2_protocol.h", "btcpp/library_tests.txt", "as loggers/groot2_protocol.h has"},
    {"IDs of trees with whitespace", "trees/btcpp/good/wide.xml", "ID=\"with a: number\""},
    {"The explicit form below", "trees/btcpp/good/wide.xml", "<Action ID=\"AlwaysSuccess\"/>"},
    {"A start value of a SubTree", "trees/btcpp/good/remapping.xml", "<SubTree"},
    {"Texts in scripts in double", "trees/btcpp/good/wide.xml", "\"double quotes\""},
    {"Number of children of", "trees/btcpp/bad/strict.xml", "'IfThenElse' needs 2 to 3 children"},
    {"Trees that nothing uses", "trees/btcpp/bad/unused_trees.xml", "expect error"},
    {"A tree that is defined twice", "trees/btcpp/bad/strict.xml", "'3x' is only read"},
    {"A text as a condition", "trees/btcpp/good/flags.xml", "_skipIf=\"wanted\""},
    {"Processing instructions", "cli/convert_test.cpp", "'<?x y?>' is left out"},
    {"Attributes of BehaviorTree", "trees/btcpp/bad/tree_attributes.xml", "attribute '_while'"},
    {"An action before another", "trees/btcpp/bad/reactive_actions.xml", "is started again"},
    {"value='{", "trees/btcpp/bad/json_constant.xml", "nothing writes '{"},
    {"More than 256 levels", "cli/convert_test.cpp", "nested deeper than 256 levels"},
    {"An include cycle", "trees/btcpp/bad/include_circle.xml", "include cycle"},
    {"An exception of a leaf", "btcpp/leaves_test.cpp", "what a node does wrong is its fault"},
    {"RetryUntilSuccessful num_attempts=\"-1\"", "cli/btcpp_test.cpp", "times in one period"},
    {"RetryUntilSuccessful num_attempts=\"-2\"", "nodes/btcpp_decorator_laws.h", "num_attempts=-2"},
    {"Switch and scripts differ", "nodes/btcpp_control_laws.h", "16abc"},
    {"4.6 and older", "cli/convert_test.cpp", "nested deeper than 256 levels"},
    {"4.7, 4.8", "cli/convert_test.cpp", "nested deeper than 256 levels"},
    {"4.9, 4.10", "cli/convert_test.cpp", "nested deeper than 256 levels"},
    {"double onPace(double factor)", "btcpp/leaves/faulty.cpp", "double onPace(double factor)"},
};

}  // namespace

TEST_CASE("what remains different from BehaviorTree.CPP: each row of the page has a test") {
  const auto here = shown_by("different.txt"), there = shown_by("different.library");
  std::size_t used = 0;
  for (const std::string& row : rows_of_page()) {
    INFO(row);
    const auto begins = [&row](const std::string& begin) { return row.rfind(begin, 0) == 0; };
    const auto in_program =
        std::find_if(here.begin(), here.end(), [&](const auto& it) { return begins(it.first); });
    const auto elsewhere = std::find_if(std::begin(kElsewhere), std::end(kElsewhere),
                                        [&](const Elsewhere& it) { return begins(it.row); });
    CHECK((in_program == here.end()) != (elsewhere == std::end(kElsewhere)));
    if (in_program != here.end()) {
      ++used;
      CHECK(there.at(in_program->first) != in_program->second);
    } else if (elsewhere != std::end(kElsewhere)) {
      ++used;
      CHECK(contains(read_file(kSource + "tests/" + elsewhere->file), elsewhere->text));
    }
  }
  CHECK(used == here.size() + std::size(kElsewhere));
  CHECK(here.size() == there.size());
}
