#include "base/core/suggest.h"
#include "base/core/typo.h"

#include <array>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

using namespace lockstep::host;

TEST_CASE("the nearest word is one that a typing error could have come from") {
  constexpr std::array<std::string_view, 6> kWords = {"Sequence",         "Fallback", "Parallel",
                                                      "ParallelAbsolute", "Wait",     "arm"};
  struct Row {
    std::string_view law, word, nearest;
  };
  const Row rows[] = {
      {"a letter is missing", "Sequnce", "Sequence"},
      {"a letter is too many", "Sequuence", "Sequence"},
      {"a letter is another", "Fallbeck", "Fallback"},
      {"neighbors are swapped: one edit, the limit of three letters", "amr", "arm"},
      {"case does not count", "PARALLEL", "Parallel"},
      {"the nearest of several", "ParallelAbsolut", "ParallelAbsolute"},
      {"a third of four, rounded up, is two", "Wxyt", "Wait"},
      {"three of four are too many", "Wxyz", ""},
      {"two of three are too many", "axx", ""},
      {"nothing is near nothing", "", ""},
      {"nothing like it", "GoToKitchen", ""},
  };
  for (const auto& row : rows) {
    INFO(row.law);
    CHECK(nearest(row.word, kWords) == row.nearest);
  }
}

TEST_CASE("of words equally near the first is suggested") {
  constexpr std::array<std::string_view, 2> kWords = {"cart", "cars"};
  CHECK(nearest("carx", kWords) == "cart");
  CHECK(did_you_mean("carx", kWords) == "did you mean 'cart' or 'cars'?");
}

TEST_CASE("a suggestion is a question, or no text at all") {
  constexpr std::array<std::string_view, 1> kWords = {"delta"};
  CHECK(did_you_mean("dleta", kWords) == "did you mean 'delta'?");
  CHECK(did_you_mean("memory", kWords).empty());
}

TEST_CASE("without a near word the candidates are listed, if there are some") {
  constexpr std::array<std::string_view, 2> kWords = {"delta", "seconds"};
  CHECK(suggest("dleta", kWords, "parameters") == "did you mean 'delta'?");
  CHECK(suggest("memory", kWords, "parameters") == "parameters: 'delta', 'seconds'");
  CHECK(suggest("memory", {}, "parameters").empty());
}

TEST_CASE("a long word is near to one with eight typing errors, not to one with nine") {
  const std::string word(60, 'a');
  for (const bool at_the_end : {false, true}) {
    for (const std::size_t edits : {8u, 9u}) {
      std::string replaced = word;
      for (std::size_t i = 0; i < edits; ++i) replaced[at_the_end ? 59 - i : i * 7] = 'b';
      const std::string inserted =
          at_the_end ? word + std::string(edits, 'b') : std::string(edits, 'b') + word;
      const std::string dropped = word.substr(edits);
      for (const std::string_view other : {replaced, inserted, dropped}) {
        INFO(other);
        const std::array<std::string_view, 1> words = {other};
        CHECK(nearest(word, words) == (edits == 8 ? other : ""));
      }
    }
  }
}

TEST_CASE("swaps of neighbors count where the words have shifted, too") {
  constexpr std::array<std::string_view, 1> kWords = {"navigate_to_the_charging_station"};
  CHECK(nearest("xnavigate_to_hte_charigng_sattion", kWords) == kWords[0]);
}

TEST_CASE("of very many words only the first are looked at") {
  std::vector<std::string_view> words(10'000, "something else");
  words.back() = "delta";
  CHECK(nearest("dleta", words) == "delta");
  words.insert(words.begin(), "something else");
  CHECK(nearest("dleta", words).empty());
}

TEST_CASE("a word that is too long to be a typing error is near nothing") {
  const std::string word(257, 'a');
  const std::array<std::string_view, 1> words = {word};
  CHECK(nearest(word, words).empty());
  CHECK(nearest(std::string_view(word).substr(1), words) == word);
}

TEST_CASE("the end of a path reads as a name whose '/' is %2F in it") {
  CHECK(end_that_reads("m/Sequence/go%2Fhome", "go/home") == "go%2Fhome");
  CHECK(end_that_reads("m/Sequence/go%2Fhome", "Sequence/go/home") == "Sequence/go%2Fhome");
  CHECK(end_that_reads("m/Sequence/go%2Fhome", "Sequence/go%2Fhome") == "Sequence/go%2Fhome");
  CHECK(end_that_reads("go%2Fhome", "go/home") == "go%2Fhome");
  CHECK(end_that_reads("m/ago%2Fhome", "go/home").empty());
  CHECK(end_that_reads("home", "go/home").empty());
  CHECK(end_that_reads("%2Fhome", "home").empty());
  constexpr std::array<std::string_view, 2> kPaths = {"m/a", "m/go%2Fhome"};
  CHECK(suggest_path("go/home", kPaths, "its leaves") == "did you mean 'm/go%2Fhome'?");
  CHECK(suggest_path("xyz", kPaths, "its leaves") == "its leaves: 'm/a', 'm/go%2Fhome'");
}
TEST_CASE("a slip is a name that cannot have been meant otherwise") {
  const std::pair<std::string_view, std::string_view> slips[] = {
      {"Sequnce", "Sequence"},         {"Seqeunce", "Sequence"},         {"Sequuence", "Sequence"},
      {"Inverer", "Inverter"},         {"sequence", "Sequence"},         {"fetch-cup", "fetch_cup"},
      {"IsBateryLow", "IsBatteryLow"}, {"AlwaysSucces", "AlwaysSuccess"}};
  for (const auto& [word, known] : slips) {
    INFO(word);
    CHECK(is_slip_of(word, known));
  }
  const std::pair<std::string_view, std::string_view> others[] = {{"OpenGripper", "CloseGripper"},
                                                                  {"IsDoorClosed", "IsDoorOpen"},
                                                                  {"MoveArm2", "MoveArm1"},
                                                                  {"max_force", "min_force"},
                                                                  {"move_x", "move_y"},
                                                                  {"MoveX", "MoveY"},
                                                                  {"ChargeTool", "ChangeTool"},
                                                                  {"EjectPart", "RejectPart"},
                                                                  {"RestArm", "ResetArm"},
                                                                  {"IsDoorLocked", "IsDoorBlocked"},
                                                                  {"UnloadPallet", "UploadPallet"},
                                                                  {"arms", "arm"},
                                                                  {"Charger", "Charge"},
                                                                  {"second", "seconds"},
                                                                  {"GoTo1_11", "GoTo11_1"},
                                                                  {"ContentMap", "ContestMap"},
                                                                  {"lift", "left"}};
  for (const auto& [word, known] : others) {
    INFO(word);
    CHECK_FALSE(is_slip_of(word, known));
    CHECK_FALSE(is_slip_of(known, word));
  }
}
