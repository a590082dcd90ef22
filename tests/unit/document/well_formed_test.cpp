#include "language/document/well_formed.h"

#include <catch2/catch.hpp>

#include "language/document/document.h"
#include "unit/document/told.h"

using namespace lockstep::host;
using namespace std::string_literals;

namespace {

struct WellFormedRow {
  std::string law, text, told;
};

void check(const WellFormedRow& row) {
  Diagnostics diagnostics;
  Document::parse("f", row.text, diagnostics);
  INFO(row.law << ": " << row.text);
  CHECK(told(diagnostics) == std::vector<std::string>{row.told});
}

std::string nested(std::size_t depth) {
  std::string text;
  for (std::size_t i = 0; i < depth; ++i) text += "<a>\n";
  for (std::size_t i = 0; i < depth; ++i) text += "</a>";
  return text;
}

}  // namespace

TEST_CASE("what is not XML is reported with its exact place") {
  const WellFormedRow rows[] = {
      {"mismatch", "<r>\n <A>\n  <B/>\n </C>\n</r>",
       "f:4:2: '</C>' closes '<A>', opened at line 2"},
      {"case counts", "<r></R>", "f:1:4: '</R>' closes '<r>', opened at line 1"},
      {"unclosed element", "<r>\n\t<A>\n", "f:2:2: '<A>' is not closed"},
      {"end tag of nothing", "<r/>\n</r>", "f:2:1: '</r>' closes no element"},
      {"end tag without a name", "<r></></r>",
       "f:1:4: '</' needs the name of the element that it closes"},
      {"unclosed end tag", "<r></r", "f:1:4: the tag '</r' is not closed"},
      {"unclosed start tag", "<r>\n <A x='1'", "f:2:2: the tag '<A' is not closed"},
      {"tag in a tag", "<r>\n <A x='1'\n <B/></r>", "f:3:2: unexpected '<' in the tag '<A'"},
      {"no quotes", "<r a='1' b=2/>", "f:1:12: expected a quote before the value of 'b'"},
      {"no value", "<r a/>", "f:1:4: attribute 'a' has no value"},
      {"quote left open", "<r a='1/>", "f:1:6: the quote of 'a' is not closed"},
      {"quote left open before a tag", "<r><A x='1/>\n<B y='2'/></r>",
       "f:2:1: '<' in the value of 'x'"},
      {"stray < in a value", "<r a='1 < 2'/>", "f:1:9: '<' in the value of 'a'"},
      {"< is no tag", "<r>\n < A/></r>", "f:2:2: '<' does not begin a tag"},
      {"no blank between", "<r a='1'b='2'/>", "f:1:9: expected whitespace before the attribute"},
      {"given twice", "<r a='1'\n   b='2' a='3'/>", "f:2:10: attribute 'a' is given twice"},
      {"second root", "<r/>\n<s/>", "f:2:1: a second root element"},
      {"text after", "<r/>\n x", "f:2:2: text after the root element"},
      {"text before", "x <r/>", "f:1:1: text before the root element"},
      {"CDATA after", "<r/><![CDATA[ ]]>", "f:1:5: text after the root element"},
      {"comment left open", "<r>\n<!-- <a> ->\n</r>", "f:2:1: the comment is not closed"},
      {"CDATA left open", "<r><![CDATA[ </r>", "f:1:4: the CDATA section is not closed"},
      {"instruction left open", "<?xml <r/>", "f:1:1: the processing instruction is not closed"},
      {"instruction without a name", "<?1?><r/>",
       "f:1:1: '<?' needs the name of the processing instruction"},
      {"instruction with a reserved name", "<r/><?XML ?>",
       "f:1:5: a processing instruction cannot be named 'XML'"},
      {"no blank after the name", "<?x+?><r/>", "f:1:4: expected whitespace after '<?x'"},
      {"blank before the declaration", " <?xml version='1.0'?><r/>",
       "f:1:2: the XML declaration must be at the very beginning of the file"},
      {"a second declaration", "<?xml version='1.0'?>\n<?xml version='1.0'?><r/>",
       "f:2:1: the XML declaration must be at the very beginning of the file"},
      {"declaration without a version", "<?xml encoding='UTF-8'?><r/>",
       "f:1:6: the XML declaration is malformed"},
      {"version of the future", "<?xml version='2.0'?><r/>",
       "f:1:16: the XML declaration is malformed"},
      {"declaration in another order",
       "<?xml version='1.0' standalone='yes' encoding='UTF-8'?><r/>",
       "f:1:37: the XML declaration is malformed"},
      {"standalone perhaps", "<?xml version='1.0' standalone='perhaps'?><r/>",
       "f:1:33: the XML declaration is malformed"},
      {"no blank in the declaration", "<?xml version='1.0'encoding='UTF-8'?><r/>",
       "f:1:20: the XML declaration is malformed"},
      {"declaration with an open quote", "<?xml version='1.0?><r/>",
       "f:1:16: the XML declaration is malformed"},
      {"another encoding is declared", "<?xml version='1.0' encoding='UTF-16'?><r/>",
       "f:1:31: the file is UTF-8, but declares 'UTF-16'"},
      {"Latin-1 is declared of what is not ASCII",
       "<?xml version='1.0' encoding='ISO-8859-1'?><r a='é'/>",
       "f:1:31: the file is UTF-8, but declares 'ISO-8859-1'"},
      {"DOCTYPE without a name", "<!DOCTYPE><r/>", "f:1:10: the DOCTYPE is malformed"},
      {"DOCTYPE with a word too many", "<!DOCTYPE r x><r/>", "f:1:13: the DOCTYPE is malformed"},
      {"DOCTYPE that names no file", "<!DOCTYPE r SYSTEM><r/>", "f:1:19: the DOCTYPE is malformed"},
      {"DOCTYPE with half a public name", "<!DOCTYPE r PUBLIC 'a'><r/>",
       "f:1:23: the DOCTYPE is malformed"},
      {"two DOCTYPEs", "<!DOCTYPE r><!DOCTYPE r><r/>", "f:1:13: a second DOCTYPE"},
      {"-- in a comment", "<r>\n<!-- run --seed 1 --></r>", "f:2:10: '--' in a comment"},
      {"a comment that ends in --->", "<r><!-- x ---></r>", "f:1:11: '--' in a comment"},
      {"a sign is no name", "<r><×/></r>", "f:1:4: '<' does not begin a tag"},
      {"a sign ends a name", "<r×/>", "f:1:3: unexpected '×' in the tag '<r'"},
      {"a combining mark begins no name", "<r \u0300='1'/>",
       "f:1:4: unexpected '\u0300' in the tag '<r'"},
      {"late DOCTYPE", "<r/><!DOCTYPE r>", "f:1:5: a DOCTYPE must be before the root element"},
      {"definitions", "<!DOCTYPE r [<!ENTITY x 'y'>]><r/>",
       "f:1:13: definitions in a DOCTYPE are not supported"},
      {"DOCTYPE left open", "<!DOCTYPE r", "f:1:1: the DOCTYPE is not closed"},
      {"only a comment", "<!-- -->\n", "f:2:1: the root element is missing"},
      {"empty", "", "f:1:1: the file is empty"},
      {"blank", "\n \n", "f:1:1: the file is empty"},
  };
  for (const auto& row : rows) check(row);
}

TEST_CASE("what is not text in UTF-8 is reported with its exact place") {
  const WellFormedRow rows[] = {
      {"UTF-16, low byte first", "\xff\xfe<\0r\0"s, "f:1:1: the file is in UTF-16"},
      {"UTF-16, high byte first", "\xfe\xff\0<\0r"s, "f:1:1: the file is in UTF-16"},
      {"NUL", "<r>\n \0</r>"s, "f:2:2: NUL byte: this is not text in UTF-8"},
      {"Latin-1", "<r a='\xe9'/>", "f:1:7: byte \\xE9 is not UTF-8"},
      {"cut character", "<r/>\n\xe2\x82", "f:2:1: byte \\xE2 is not UTF-8"},
      {"control character", "<r a='\x1b'/>", "f:1:7: control character \\x1B in the text"},
      {"U+FFFE", "<r a='\xEF\xBF\xBE'/>",
       "f:1:7: a character that XML does not allow (U+FFFE or U+FFFF)"},
      {"U+FFFF", "<!-- \xEF\xBF\xBF --><r/>",
       "f:1:6: a character that XML does not allow (U+FFFE or U+FFFF)"},
  };
  for (const auto& row : rows) check(row);

  Diagnostics diagnostics;
  Document::parse("f", "\xff\xfe", diagnostics);
  CHECK(hints(diagnostics) == std::vector<std::string>{"save it as UTF-8"});
}

TEST_CASE("text in an element and unknown references leave the document readable") {
  Diagnostics diagnostics;
  const auto document = Document::parse("f",
                                        "<r>\n  hello <a b='1 & 2 &x; &amp; &#0; &#x110000; "
                                        "&#xFFFE; &#99'/>\n<![CDATA[ x]]> &lt;</r>",
                                        diagnostics);
  CHECK(told(diagnostics) == std::vector<std::string>{
                                 "f:2:3: text is not part of the language",
                                 "f:2:17: '&' does not begin a known reference",
                                 "f:2:21: '&' does not begin a known reference",
                                 "f:2:31: '&' does not begin a known reference",
                                 "f:2:36: '&' does not begin a known reference",
                                 "f:2:47: '&' does not begin a known reference",
                                 "f:2:56: '&' does not begin a known reference",
                                 "f:3:11: text is not part of the language",
                                 "f:3:16: text is not part of the language",
                             });
  REQUIRE(document);
  CHECK(document->elements().size() == 2);
}

TEST_CASE("every attribute that is given twice is reported, and the document is refused") {
  Diagnostics diagnostics;
  CHECK_FALSE(Document::parse("f", "<r a='1' a='2'>\n<s b='' c='' b='' b=''/></r>", diagnostics));
  CHECK(told(diagnostics) == std::vector<std::string>{"f:1:10: attribute 'a' is given twice",
                                                      "f:2:14: attribute 'b' is given twice",
                                                      "f:2:19: attribute 'b' is given twice"});
}

TEST_CASE("the depth of elements has a limit that is named") {
  Diagnostics none;
  const auto deepest = Document::parse("f", nested(kMaxElementDepth), none);
  REQUIRE(deepest);
  CHECK(deepest->elements().size() == kMaxElementDepth);

  Diagnostics diagnostics;
  CHECK_FALSE(Document::parse("f", nested(100'000), diagnostics));
  CHECK(told(diagnostics) ==
        std::vector<std::string>{"f:1025:1: elements are nested deeper than 1024 levels"});
}

TEST_CASE("the number of attributes has a limit that is named") {
  std::string text = "<r";
  for (std::size_t i = 0; i < kMaxAttributes; ++i) text += "\na" + std::to_string(i) + "=''";
  Diagnostics diagnostics;
  CHECK(Document::parse("f", text + "/>", diagnostics));
  CHECK(told(diagnostics).empty());
  CHECK_FALSE(Document::parse("f", text + "\nb=''/>", diagnostics));
  CHECK(told(diagnostics) == std::vector<std::string>{"f:258:1: 'r' has more than 256 attributes"});
}

TEST_CASE("the size of a file has a limit that is named") {
  Diagnostics diagnostics;
  CHECK_FALSE(Document::parse("f", std::string(Document::kMaxBytes + 1, ' '), diagnostics));
  CHECK(told(diagnostics) == std::vector<std::string>{"f: the file is larger than 64 MiB"});
}

TEST_CASE("a text full of faults is not read to its end") {
  std::string text = "<r>";
  for (int i = 0; i < 1000; ++i) text += "x<a/>";
  Diagnostics diagnostics;
  CHECK_FALSE(Document::parse("f", text + "</r>", diagnostics));
  CHECK(diagnostics.count(Severity::Error) == 100);
}
