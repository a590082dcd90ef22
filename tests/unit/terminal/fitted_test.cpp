#include "base/terminal/fitted.h"

#include <catch2/catch.hpp>

#include "base/terminal/text_table.h"

using namespace lockstep::host;

TEST_CASE("a line that is too long goes on below, further to the right") {
  CHECK(fitted("one two three\n", 13) == "one two three\n");
  CHECK(fitted("one two three\n", 12) == "one two\n    three\n");
  CHECK(fitted("  one two three four\nshort\n", 14) ==
        "  one two\n      three\n      four\nshort\n");
  CHECK(fitted("two  blanks   stay", 80) == "two  blanks   stay");
  CHECK(fitted("aaaaaaaaaaaaaaaaaaaa b", 10) == "aaaaaaaaaaaaaaaaaaaa\n    b");
  CHECK(fitted("a\n\nb", 10) == "a\n\nb");
  CHECK(fitted("", 10).empty());
}

TEST_CASE("a color needs no column, a wide character two") {
  const std::string red = "\x1b[31mone\x1b[0m two";
  CHECK(fitted(red, 7) == red);
  CHECK(fitted(red, 6) == "\x1b[31mone\x1b[0m\n   two");
  CHECK(fitted("日本 x", 6) == "日本 x");
  CHECK(fitted("日本 x", 5) == "日本\n  x");
}

TEST_CASE("a table that is too wide goes on below, with its first columns again") {
  const std::vector<TableRow> rows{{"name", "a", "bb", "c"}, {"x", "1", "2", "3"}};
  CHECK(text_table(rows, 1) == "name  a  bb  c\nx     1   2  3\n");
  CHECK(text_table(rows, 1, 14) == text_table(rows, 1));
  CHECK(text_table(rows, 1, 12) == "name  a  bb\nx     1   2\n\nname  c\nx     3\n");
  CHECK(text_table(rows, 1, 1) == "name  a\nx     1\n\nname  bb\nx      2\n\nname  c\nx     3\n");
  CHECK(text_table(rows, 4, 1) == "name  a  bb  c\nx     1  2   3\n");
  CHECK(text_table({}, 2).empty());
}
