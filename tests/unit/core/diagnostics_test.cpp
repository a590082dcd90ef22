#include "base/core/diagnostics.h"

#include <catch2/catch.hpp>

using namespace lockstep::host;

namespace {

Diagnostic error(SourceLocation location, std::string excerpt, std::string hint = {}) {
  return {Severity::Error, std::move(location), "unknown node 'Sequnce'", std::move(hint),
          Excerpt{std::move(excerpt)}};
}

std::vector<std::string> messages(const Diagnostics& diagnostics) {
  std::vector<std::string> list;
  for (const auto& d : diagnostics.all()) list.push_back(d.message);
  return list;
}

}  // namespace

TEST_CASE("a diagnostic shows its place, the line, a caret and the hint") {
  CHECK(render(error({"a.xml", 4, 3}, "  <Sequnce/>", "did you mean 'Sequence'?"), false) ==
        "a.xml:4:3: error: unknown node 'Sequnce'\n"
        "    <Sequnce/>\n"
        "    ^\n"
        "  hint: did you mean 'Sequence'?\n");
}

TEST_CASE("a message ends with its code") {
  Diagnostics diagnostics;
  diagnostics.error("unknown-node"_code, {"a.xml", 4, 3}, "unknown node 'Sequnce'", "a hint");
  CHECK(render(diagnostics.all()[0], false) ==
        "a.xml:4:3: error: unknown node 'Sequnce' [unknown-node]\n"
        "  hint: a hint\n");
}

TEST_CASE("what is not known of a place is not shown") {
  CHECK(render(error({"a.xml", 4, 0}, "<a/>"), false) ==
        "a.xml:4: error: unknown node 'Sequnce'\n  <a/>\n");
  CHECK(render(error({"a.xml"}, ""), false) == "a.xml: error: unknown node 'Sequnce'\n");
  CHECK(render(error({}, ""), false) == "error: unknown node 'Sequnce'\n");
}

TEST_CASE("the caret stands below its character") {
  struct Row {
    std::string law, excerpt;
    std::uint32_t column;
    std::string shown, caret;
  };
  const Row rows[] = {
      {"first column", "<a>", 1, "<a>", "^"},
      {"tabs are repeated, whatever their width", "\t\t<a>", 3, "\t\t<a>", "\t\t^"},
      {"a tab in the middle", "<a\tb>", 4, "<a\tb>", "  \t^"},
      {"a character of several bytes is one", "é€x", 6, "é€x", "  ^"},
      {"a wide character is two", "é抓😀x", 10, "é抓😀x", "     ^"},
      {"a mark on a letter is none", "e\u0301x", 4, "e\u0301x", " ^"},
      {"an escaped byte is as long as it is shown", "\x1bx", 2, "\\x1Bx", "    ^"},
      {"a backslash is one", "\\x", 2, "\\x", " ^"},
      {"just past the end", "ab", 3, "ab", "  ^"},
  };
  for (const auto& row : rows) {
    INFO(row.law);
    CHECK(render(error({"f", 1, row.column}, row.excerpt), false) ==
          "f:1:" + std::to_string(row.column) + ": error: unknown node 'Sequnce'\n  " + row.shown +
              "\n  " + row.caret + "\n");
  }
}

TEST_CASE("of a long line the part around the column is shown, and that something is before it") {
  Diagnostic diagnostic = error({"f", 1, 103}, "<Sequnce/>");
  diagnostic.excerpt.column = 101;
  CHECK(render(diagnostic, false) ==
        "f:1:103: error: unknown node 'Sequnce'\n  ...<Sequnce/>\n     "
        "  ^\n");
}

TEST_CASE("no caret where the line was cut before the column") {
  CHECK(render(error({"f", 1, 300}, "abc"), false) ==
        "f:1:300: error: unknown node 'Sequnce'\n  abc\n");
}

TEST_CASE("color changes no text") {
  const auto diagnostic = error({"a.xml", 4, 3}, "  <a/>", "a hint");
  auto text = render(diagnostic, true);
  CHECK(text.find("\x1b[") != std::string::npos);
  for (auto begin = text.find('\x1b'); begin != std::string::npos; begin = text.find('\x1b'))
    text.erase(begin, text.find('m', begin) - begin + 1);
  CHECK(text == render(diagnostic, false));
}

TEST_CASE("nothing raw reaches a terminal") {
  using namespace std::string_literals;
  const std::pair<std::string, std::string> rows[] = {
      {"plain é 漢", "plain é 漢"},
      {"\x1b[2J", "\\x1B[2J"},
      {"a\nb\tc\x7f", "a\\x0Ab\\x09c\\x7F"},
      {"\0"s, "\\x00"},
      {"\u009b", "\\u009B"},  // CSI in one code point
      {"a\u202egpj.x\u2066\u2069", "a\\u202Egpj.x\\u2066\\u2069"},
      {"\xff", "\\xFF"},                             // never in UTF-8
      {"\xc3", "\\xC3"},                             // cut
      {"\xc0\xaf", "\\xC0\\xAF"},                    // overlong
      {"\xed\xa0\x80", "\\xED\\xA0\\x80"},           // surrogate
      {"\xf4\x90\x80\x80", "\\xF4\\x90\\x80\\x80"},  // beyond the last code point
  };
  for (const auto& [text, shown] : rows) CHECK(printable(text) == shown);

  const Diagnostic hostile{Severity::Error, {"\x1b", 1, 1}, "\x1b", "\x1b", "\x1b"};
  CHECK(render(hostile, false).find('\x1b') == std::string::npos);
}

TEST_CASE("sorting is by file as first mentioned, then line, then column") {
  Diagnostics diagnostics;
  diagnostics.error({}, {"main.xml", 9, 1}, "1");
  diagnostics.error({}, {"a.xml", 1, 1}, "2");
  diagnostics.error({}, {"main.xml", 2, 8}, "3");
  diagnostics.error({}, {"main.xml", 2, 3}, "4");
  diagnostics.error({}, {"main.xml"}, "5");
  diagnostics.sort();
  CHECK(messages(diagnostics) == std::vector<std::string>{"5", "4", "3", "1", "2"});
}

TEST_CASE("equal entries are one") {
  Diagnostics diagnostics;
  for (const auto* message : {"b", "a", "b", "c", "a"}) diagnostics.error({}, {"f", 1, 1}, message);
  diagnostics.add({Severity::Warning, {"f", 1, 1}, "a", {}, {}});
  diagnostics.sort();
  CHECK(messages(diagnostics) == std::vector<std::string>{"b", "a", "c", "a"});
}

TEST_CASE("at one place the order of reporting stays") {
  Diagnostics diagnostics;
  std::vector<std::string> reported;
  for (int i = 100; i > 0; --i) {
    reported.push_back(std::to_string(i));
    diagnostics.error({}, {"f", 1, 1}, reported.back());
  }
  diagnostics.sort();
  CHECK(messages(diagnostics) == reported);
}

TEST_CASE("only errors are errors") {
  Diagnostics diagnostics;
  diagnostics.add({Severity::Warning, {}, "w", {}, {}});
  diagnostics.add({Severity::Note, {}, "n", {}, {}});
  CHECK_FALSE(diagnostics.has_errors());
  diagnostics.error({}, {}, "e");
  CHECK(diagnostics.has_errors());
  CHECK(diagnostics.count(Severity::Warning) == 1);
  CHECK(render(diagnostics.all()[0], false) == "warning: w\n");
  CHECK(render(diagnostics.all()[1], false) == "note: n\n");
}

TEST_CASE("diagnostics beyond the thousandth of a severity are counted, not kept") {
  Diagnostics diagnostics;
  for (std::uint32_t line = 1; line <= 1500; ++line) {
    diagnostics.add({Severity::Warning, {"a.xml", line, 1}, "unused", "", ""});
  }
  CHECK_FALSE(diagnostics.has_errors());
  for (std::uint32_t line = 1; line <= 1002; ++line) {
    diagnostics.error({}, {"a.xml", line, 1}, "wrong");
  }
  diagnostics.sort();
  CHECK(diagnostics.all().size() == 2000);
  CHECK(diagnostics.count(Severity::Warning) == 1500);
  CHECK(diagnostics.count(Severity::Error) == 1002);
}
