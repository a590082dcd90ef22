#include "core/suggest.h"

#include <array>
#include <catch2/catch.hpp>

using namespace lockstep;

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
}

TEST_CASE("a suggestion is a question, or no text at all") {
  constexpr std::array<std::string_view, 1> kWords = {"delta"};
  CHECK(did_you_mean("dleta", kWords) == "did you mean 'delta'?");
  CHECK(did_you_mean("memory", kWords).empty());
}

TEST_CASE("a word that is too long to be a typing error is near nothing") {
  const std::string word(257, 'a');
  const std::array<std::string_view, 1> words = {word};
  CHECK(nearest(word, words).empty());
  CHECK(nearest(std::string_view(word).substr(1), words) == word);
}
