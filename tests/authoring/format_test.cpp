// The canonical layout: what it is, that it is stable, and that nothing else changes.
#include <algorithm>
#include <catch2/catch.hpp>

#include "author/edit/unified_diff.h"
#include "author/format/format.h"
#include "authoring/element_model.h"
#include "language/document/scanner.h"
#include "property/random_source.h"

namespace lockstep::host::test {
namespace {

std::string formatted(const std::string& text, const FormatOptions& options = {}) {
  const auto document = parsed(text);
  REQUIRE(document != nullptr);
  const auto edit = format(*document, options);
  REQUIRE(edit.has_value());
  return edit->apply(document->source()->text());
}

std::string tree(const std::string& nodes) {
  return "<root lockstep=\"1\">\n" + nodes + "</root>\n";
}

struct Row {
  const char* what;
  std::string before, after;
};

std::vector<Row> rows() {
  const std::string wide(50, 'w');
  return {
      {"one line", "<root lockstep='1'><a><b/><c x = '1'></c></a></root>",
       "<root lockstep='1'>\n  <a>\n    <b/>\n    <c x='1'></c>\n  </a>\n</root>\n"},
      {"tabs and blanks", tree("\t<a \t>\t\n\t\t<b   /></a >  \n"),
       tree("  <a>\n    <b/>\n  </a>\n")},
      {"of empty lines, one", tree("\n\n\n  <a/>\n\n  <b/>\n \n\n\n"),
       tree("\n  <a/>\n\n  <b/>\n\n")},
      {"a comment moves with its lines", tree("<!-- one\n     two\n\n-->\n<a/><!-- b -->\n"),
       tree("  <!-- one\n       two\n\n  -->\n  <a/> <!-- b -->\n")},
      {"wide attributes are below the first one",
       tree("  <a x=\"" + wide + "\" y=\"" + wide + "\" z=\"1\"/>\n"),
       tree("  <a x=\"" + wide + "\"\n     y=\"" + wide + "\" z=\"1\"/>\n")},
      {"attributes that fit are in one line", tree("  <a x=\"1\"\n     y=\"2\"/>\n"),
       tree("  <a x=\"1\" y=\"2\"/>\n")},
      {"line ends in a value are the value's", tree("<a x=\"1\n\t 2\" y='3'/>\n"),
       tree("  <a x=\"1\n\t 2\" y='3'/>\n")},
      {"references and quotes stay", tree("<a x='&lt; \"q\" &#x41;'/>\n"),
       tree("  <a x='&lt; \"q\" &#x41;'/>\n")},
      {"a text stays as it is", tree("<property name=\"p\">\n never\n\ta  </property>\n"),
       tree("  <property name=\"p\">\n never\n\ta  </property>\n")},
      {"so does a CDATA section", tree("<property><![CDATA[ a < b ]]></property>\n"),
       tree("  <property><![CDATA[ a < b ]]></property>\n")},
      {"in front of the root", "<?xml version='1.0'?><!DOCTYPE root><!--c--><root lockstep=\"1\"/>",
       "<?xml version='1.0'?>\n<!DOCTYPE root> <!--c-->\n<root lockstep=\"1\"/>\n"},
      {"what only BehaviorTree.CPP reads",
       "<root BTCPP_format=\"4\"><A x=\"a<b\"y=\"&&\"/>\n<!-- a -- b --></root>",
       "<root BTCPP_format=\"4\">\n  <A x=\"a<b\" y=\"&&\"/>\n  <!-- a -- b -->\n</root>\n"},
      {"a text that BehaviorTree.CPP ignores is in a separate line",
       "<root BTCPP_format=\"4\"> a\nb <A>c </A><M><P> d </P></M></root>",
       "<root BTCPP_format=\"4\">\n  a\nb\n  <A>c </A>\n  <M>\n    <P> d </P>\n  "
       "</M>\n</root>\n"},
      {"the first line says the line end", "<root lockstep=\"1\">\r\n<a/>\n\n\n<b/></root>",
       "<root lockstep=\"1\">\r\n  <a/>\r\n\r\n  <b/>\r\n</root>\r\n"},
      {"one in a comment does not", "<root\nlockstep=\"1\"><!-- a\r\n b --><a/></root>",
       "<root lockstep=\"1\"> <!-- a\r\n b -->\n  <a/>\n</root>\n"},
      {"but where there is no other", "<root lockstep=\"1\"><!-- a\r\n b --><a/></root>",
       "<root lockstep=\"1\"> <!-- a\r\n b -->\r\n  <a/>\r\n</root>\r\n"},
  };
}

// Some line ends at random, wherever they are: a value and a comment keep theirs.
std::string with_other_line_ends(const std::string& text, RandomSource& random) {
  std::string result;
  for (const char c : text) {
    if (c == '\n' && random.one_in(3) && !result.ends_with('\r')) result += '\r';
    result += c;
  }
  return result;
}

// Other blanks at random, where they have no meaning.
std::string with_other_blanks(const std::string& text, RandomSource& random) {
  const auto document = parsed(text);
  const bool is_lenient = document->rules().lenient_xml;
  static const std::vector<std::string> kBlanks{"",  "\n", "\n\n",    "\n\n\n  ",
                                                " ", "\t", "  \n \t", " \r\n"};
  std::string result;
  Scanner scanner(text, is_lenient ? Grammar::Lenient : Grammar::Strict);
  std::size_t done = 0;
  for (TokenKind before = TokenKind::End;;) {
    const XmlToken token = scanner.next();
    const bool is_between_tags = before != TokenKind::Text && token.kind != TokenKind::Text;
    const bool is_tag = token.kind == TokenKind::OpenTag || token.kind == TokenKind::CloseTag;
    if (is_tag && is_between_tags && done > 0 && random.one_in(2)) {
      std::size_t blank = token.begin;
      while (blank > done && is_xml_blank(text[blank - 1])) --blank;
      result += text.substr(done, blank - done) + random.pick(kBlanks);
      done = token.begin;
    } else if (token.kind == TokenKind::Attribute && random.one_in(2)) {
      result += text.substr(done, token.begin - done) + random.pick(kBlanks);
      done = token.begin;
    }
    if (done == 0 && token.kind == TokenKind::OpenTag) {
      result = text.substr(0, token.begin);
      done = token.begin;
    }
    if (token.kind == TokenKind::End || token.kind == TokenKind::Fault) break;
    before = token.kind;
  }
  return result + text.substr(done);
}

ElementModel with_sorted(ElementModel model) {
  std::ranges::sort(model.attributes);
  for (ElementModel& child : model.children) child = with_sorted(std::move(child));
  return model;
}

}  // namespace

TEST_CASE("format: the layout") {
  for (const Row& row : rows()) {
    INFO(row.what);
    CHECK(formatted(row.before) == row.after);
    CHECK(formatted(row.after) == row.after);
  }
}

TEST_CASE("format: attributes are sorted when that is asked for") {
  const std::string before = tree("  <A b='2' name=\"n\" a=\"1\" ID=\"x\"/>\n");
  CHECK(formatted(before) == before);
  CHECK(formatted(before, {.sort_attributes = true}) ==
        tree("  <A ID=\"x\" name=\"n\" a=\"1\" b='2'/>\n"));
}

TEST_CASE("format: elements and comments stay, and the second time nothing changes") {
  RandomSource random(35);
  const auto texts = texts_of_trees();
  REQUIRE(texts.size() > 50);
  for (const std::string& original : texts) {
    if (has_errors(original)) continue;
    for (int i = 0; i < 20; ++i) {
      std::string text = i == 0 ? original : with_other_blanks(original, random);
      if (i > 10) text = with_other_line_ends(text, random);
      const FormatOptions options{.width = static_cast<std::size_t>(random.between(20, 120)),
                                  .sort_attributes = random.one_in(3)};
      const auto document = parsed(text);
      INFO(text);
      REQUIRE(document != nullptr);
      const std::string once = formatted(text, options);
      INFO("--- formatted\n" << once);
      REQUIRE(with_sorted(model_of(*parsed(once))) == with_sorted(model_of(*document)));
      REQUIRE(comments_in(once) == comments_in(text));
      REQUIRE(formatted(once, options) == once);
    }
  }
}

TEST_CASE("format: a diff has the lines that change") {
  const auto diff = [](std::string_view text, const std::vector<Patch>& patches) {
    TextEdit edit;
    for (const Patch& it : patches) edit.replace(it.begin, it.end, it.text);
    return unified_diff("t.xml", text, edit);
  };
  const std::string head = "--- t.xml\n+++ t.xml\n";
  CHECK(diff("a\n", {{0, 1, "a"}}).empty());
  CHECK(diff("a\nb\nc\n", {{2, 3, "B"}}) == head + "@@ -1,3 +1,3 @@\n a\n-b\n+B\n c\n");
  CHECK(diff("a\nb\n", {{2, 2, "x\n"}}) == head + "@@ -1,2 +1,3 @@\n a\n+x\n b\n");
  CHECK(diff("a\nb\n", {{2, 4, ""}}) == head + "@@ -1,2 +1 @@\n a\n-b\n");
  CHECK(diff("a", {{1, 1, "\n"}}) == head + "@@ -1 +1 @@\n-a\n\\ No newline at end of file\n+a\n");
  CHECK(diff("a\nb\nc\nd\ne\nf\ng\nh\ni\nj\n", {{0, 1, "A"}, {18, 19, "J"}}) ==
        head + "@@ -1,4 +1,4 @@\n-a\n+A\n b\n c\n d\n@@ -7,4 +7,4 @@\n g\n h\n i\n-j\n+J\n");
}

}  // namespace lockstep::host::test
