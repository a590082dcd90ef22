// Command lines that are wrong: the word that is named, what was meant, and the help that is named.
#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>

#include "support/program.h"

using namespace lockstep::host::test;

namespace {

struct Row {
  std::vector<std::string> arguments;
  std::string message, hint;
};

}  // namespace

TEST_CASE("a wrong command line names the word that is wrong, and the help of its command") {
  const Row rows[] = {
      {{}, "`lockstep` needs a command", "commands: 'new', 'run', "},
      {{"chekc"}, "unknown command 'chekc'", "did you mean 'check'?"},
      {{"chekc", "--help"}, "unknown command 'chekc'", "did you mean 'check'?"},
      {{"frobnicate", "x"}, "unknown command 'frobnicate'", "commands: 'new', 'run', "},
      {{"--verison"},
       "unknown option '--verison'",
       "did you mean '--version'? see `lockstep --help`"},
      {{"run", "--recrod", "x", "t.xml"},
       "unknown option '--recrod'",
       "did you mean '--record'? see `lockstep run --help`"},
      {{"run", "t.xml", "--recrod=x"}, "unknown option '--recrod'", "did you mean '--record'?"},
      {{"run", "t.xml", "--frobnicate"},
       "unknown option '--frobnicate'",
       "see `lockstep run --help`"},
      {{"run", "t.xml", "--virtual"},
       "unknown option '--virtual'",
       "did you mean '--clock virtual'? see `lockstep run --help`"},
      {{"--record", "x", "run", "t.xml"},
       "unknown option '--record'",
       "it stands behind the command: `lockstep run --record`; see `lockstep run --help`"},
      {{"check", "t.xml", "--tick-budget", "3"},
       "unknown option '--tick-budget'",
       "`lockstep run` has that option; see `lockstep check --help`"},
      {{"show", "t.xml", "--seed", "3"},
       "unknown option '--seed'",
       "`lockstep run`, `lockstep study` and 1 more have that option; see `lockstep show --help`"},
      {{"run", "--seed", "1", "-x", "t.xml"}, "unknown option '-x'", "see `lockstep run --help`"},
      {{"run", "--rate", "fast", "t.xml"},
       "--rate: 'fast' is not a number from 0.001 to 100000",
       "see `lockstep run --help`"},
      {{"run", "a.xml", "b.xml"}, "unexpected argument 'b.xml'", "see `lockstep run --help`"},
      {{"run", "a.xml", "--", "-b.xml"},
       "unexpected argument '-b.xml'",
       "see `lockstep run --help`"},
      {{"run"}, "tree is required", "see `lockstep run --help`"},
      {{"run", "t.xml", "--seed"}, "'--seed' needs a value", "see `lockstep run --help`"},
      {{"run", "--rate", "nan", "t.xml"}, "--rate: 'nan' is not a number from 0.001", "see `"},
      {{"run", "--rate", "0.0009", "t.xml"}, "--rate: '0.0009' is not a number from", "see `"},
      {{"run", "--cpu", "4096", "t.xml"},
       "--cpu: '4096' is not a list of processors, as 3 or 0-1,3",
       ""},
      {{"run", "--timeout", "1e10", "t.xml"}, "--timeout: '1e10' is not a number from 0 to", ""},
      {{"run", "--clock", "virtaul", "t.xml"},
       "--clock: 'virtaul' is not one of wall, virtual, ros; did you mean 'virtual'?",
       "see `lockstep run --help`"},
      {{"run", "--overrun", "skp", "t.xml"},
       "--overrun: 'skp' is not one of skip, catch-up, fail; did you mean 'skip'?",
       "see `lockstep run --help`"},
      {{"run", "t.xml", "--timeout="}, "'--timeout' needs a value", "see `lockstep run --help`"},
      {{"replay", "x", "--speed", "0"}, "--speed: '0' is not a number from 0.001 to 1000000", ""},
      {{"log", "diff", "x", "y", "--tolerance", "nan"},
       "--tolerance: 'nan' is not a number from 0 to 1",
       "see `lockstep log diff --help`"},
      {{"check", "--format", "xml", "t.xml"},
       "--format: 'xml' is not one of text, json, github",
       "see `lockstep check --help`"},
      {{"check", "--format", "sarif", "t.xml"},
       "--format: 'sarif' is no longer written: github annotates the files in a workflow, and json "
       "is for others",
       "see `lockstep check --help`"},
      {{"verify", "--format", "sarif", "t.xml"},
       "--format: 'sarif' is no longer written: junit is for a workflow, and json for other "
       "programs",
       "see `lockstep verify --help`"},
      {{"log"}, "`lockstep log` needs a command", "commands: 'csv', "},
      {{"log", "inf", "x"},
       "unknown command 'log inf'",
       "did you mean 'info'? see `lockstep log --help`"},
      {{"log", "measure", "x", "--mesure", "duration"},
       "unknown option '--mesure'",
       "did you mean '--measure'? see `lockstep log measure --help`"},
      {{"study", "mrege", "a", "b"}, "unknown command 'study mrege'", "did you mean 'merge'?"},
      {{"study", "a.xml", "b.xml"}, "unexpected argument 'b.xml'", "see `lockstep study --help`"},
      {{"help", "rnu"}, "unknown command 'rnu'", "did you mean 'run'?"},
      {{"help", "log", "inf"}, "unknown command 'log inf'", "did you mean 'info'?"},
  };
  for (const Row& row : rows) {
    const Outcome outcome = run_lockstep(row.arguments);
    INFO(row.message << "\n" << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.starts_with("lockstep: error: " + row.message));
    CHECK(contains(outcome.err, "\n  hint: " + row.hint));
    CHECK(lines(outcome.err).size() == 2);
  }
}

TEST_CASE("a word of a command line reaches the terminal short and harmless") {
  const Outcome control = run_lockstep({"run", "--\x1b[2J", "t.xml"});
  CHECK(contains(control.err, "unknown option '--\\x1B[2J'"));
  const Outcome endless = run_lockstep({"run", "--" + std::string(100'000, 'x'), "t.xml"});
  CHECK(endless.err.size() < 1000);
}

TEST_CASE("what is right is not blamed for a likeness") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", tree_text("<AlwaysSuccess/>"));
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", tree, "--clock=virtual", "--view", "none"},
        {"run", "--timeout", "1", "--clock", "virtual", "--", tree},
        {"study", tree, "-n2", "--measure", "duration", "--no-plots", "--out",
         directory.path("study")},
        {"help"},
        {"--help"},
        {"help", "help"}}) {
    const Outcome outcome = run_lockstep(arguments);
    INFO(outcome.err);
    CHECK(outcome.code == 0);
  }
}

TEST_CASE("help fits into 80 columns where there is no terminal") {
  for (const std::vector<std::string>& command : {std::vector<std::string>{},
                                                  {"run"},
                                                  {"check"},
                                                  {"show"},
                                                  {"nodes"},
                                                  {"schema"},
                                                  {"convert"},
                                                  {"fmt"},
                                                  {"lsp"},
                                                  {"mcp"},
                                                  {"plugin"},
                                                  {"plugin", "check"},
                                                  {"log"},
                                                  {"log", "info"},
                                                  {"log", "csv"},
                                                  {"log", "diff"},
                                                  {"log", "measure"},
                                                  {"log", "page"},
                                                  {"log", "plot"},
                                                  {"replay"},
                                                  {"study"},
                                                  {"study", "merge"},
                                                  {"study", "compare"},
                                                  {"monitor"}}) {
    std::vector<std::string> words = {"help"};
    words.insert(words.end(), command.begin(), command.end());
    std::istringstream lines(run_lockstep(words).out);
    std::size_t longest = 0;
    for (std::string line; std::getline(lines, line);) longest = std::max(longest, line.size());
    INFO((command.empty() ? "lockstep" : command.back()));
    CHECK(longest > 40);
    CHECK(longest <= 80);
  }
}

TEST_CASE("the help of each command fits on two screens, and --help-all has every option") {
  const auto count = [](const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
  };
  for (const char* command : {"run", "check", "test", "verify", "study", "show", "replay", "log"}) {
    INFO(command);
    CHECK(count(run_lockstep({command, "--help"}).out) <= 100);
  }
  const std::string usual = run_lockstep({"run", "--help"}).out;
  const std::string all = run_lockstep({"run", "--help-all"}).out;
  CHECK(contains(usual, " more options: --help-all\n"));
  CHECK_FALSE(contains(usual, "--spin US"));
  CHECK_FALSE(contains(usual, "\n\n\n"));
  CHECK(contains(all, "Time, more:\n"));
  for (const char* option : {"--rate HZ", "--spin US", "--record-keep N", "--notify"}) {
    CHECK(contains(all, option));
  }
}

TEST_CASE("help COMMAND is COMMAND --help") {
  const std::vector<std::vector<std::string>> commands = {
      {}, {"run"}, {"check"}, {"log"}, {"log", "info"}, {"study", "merge"}};
  for (const auto& command : commands) {
    std::vector<std::string> with_word = {"help"}, with_option = command;
    with_word.insert(with_word.end(), command.begin(), command.end());
    with_option.emplace_back("--help");
    const Outcome outcome = run_lockstep(with_word);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK(contains(outcome.out, "Usage: lockstep"));
    CHECK(outcome.out == run_lockstep(with_option).out);
  }
  CHECK(contains(run_lockstep({"help"}).out, "\n  help "));
}
