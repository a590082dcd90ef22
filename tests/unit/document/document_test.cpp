#include "language/document/document.h"

#include <catch2/catch.hpp>

#include "unit/document/told.h"

using namespace lockstep::host;

namespace {

std::unique_ptr<Document> parse(std::string text) {
  Diagnostics diagnostics;
  auto document = Document::parse("f", std::move(text), diagnostics);
  CHECK(told(diagnostics).empty());
  REQUIRE(document);
  return document;
}

std::string place(const SourceLocation& at) {
  return std::to_string(at.line) + ":" + std::to_string(at.column);
}

// Where an element or one of its attributes, which it has, is written.
std::string element_place(const Document& document, std::uint32_t element) {
  return place(document.source()->locate(document.elements()[element].place));
}

std::string name_place(const Document& document, std::uint32_t element, std::string_view name) {
  return place(document.source()->locate(document.find_attribute(element, name)->place));
}

std::string value_place(const Document& document, std::uint32_t element, std::string_view name,
                        std::size_t byte = 0) {
  const Place attribute = document.find_attribute(element, name)->place;
  return place(document.source()->locate_value(attribute, byte));
}

// "tag[end](attribute=value …) …"
std::string outline(const Document& document) {
  std::string text;
  for (std::uint32_t i = 0; i < document.elements().size(); ++i) {
    const auto& element = document.elements()[i];
    text += std::string(element.tag) + "[" + std::to_string(element.end) + "]";
    for (const auto& attribute : document.attributes(i))
      text += "(" + std::string(attribute.name) + "=" + std::string(attribute.value) + ")";
    text += " ";
  }
  return text;
}

}  // namespace

TEST_CASE("elements stand in pre-order, each with the end of its subtree") {
  CHECK(outline(*parse("<r><a x='1' y=\"2\"><b/></a><c><d><e z=''/></d></c><f></f></r>")) ==
        "r[7] a[3](x=1)(y=2) b[3] c[6] d[6] e[6](z=) f[7] ");
  CHECK(outline(*parse("<r/>")) == "r[1] ");
}

TEST_CASE("what is not an element does not count") {
  CHECK(outline(*parse("<?xml version='1.0'?><?x-model y='<z>'?>\n<!DOCTYPE r>\n<!-- <no/> -->"
                       "<r><!-- <a b='c'> --><![CDATA[ \n ]]><a/><!----></r>\n<!-- -->")) ==
        "r[2] a[2] ");
}

TEST_CASE("processing instructions and a DOCTYPE may stand wherever XML allows them") {
  CHECK(outline(*parse("<?xml version='1.0' encoding='us-ascii' standalone='no' ?><?a?>\n"
                       "<!-- --><!DOCTYPE r PUBLIC '-//x' \"a>b\"><?b c='<?'?>\n"
                       "<r><?c &lt;?><a x='&lt;'><?d <x/> ?></a></r>\n<?e ?\?><!-- --><?f?>")) ==
        "r[2] a[2](x=<) ");
  CHECK(outline(
            *parse("\xEF\xBB\xBF<?xml version=\"1.1\" encoding = \"utf-8\"?><!DOCTYPE r><é·/>")) ==
        "é·[1] ");
}

TEST_CASE("references in values are resolved") {
  CHECK(outline(*parse("<r a='&lt;&gt;&amp;&quot;&apos;&#65;&#x20AC;&amp;lt;'/>")) ==
        "r[1](a=<>&\"'A€&lt;) ");
  CHECK(outline(*parse("<r a='&#00000000000000000065;&#x00000000000000000020AC;'/>")) ==
        "r[1](a=A€) ");
}

TEST_CASE("elements and attributes are found in the original bytes") {
  struct Row {
    std::string law, text, element, name, value;  // of element 1 and its attribute x
  };
  const Row rows[] = {
      {"one line", "<r><a x='1'/></r>", "1:4", "1:7", "1:10"},
      {"a tab is one column", "<r>\n\t\t<a\tx='1'/></r>", "2:3", "2:6", "2:9"},
      {"CRLF", "<r>\r\n  <a\r\n  x='1'/>\r\n</r>", "2:3", "3:3", "3:6"},
      {"columns are bytes", "<r><!-- é€ --><a x='1'/></r>", "1:18", "1:21", "1:24"},
      {"a byte order mark is no column", "\xEF\xBB\xBF<r><a x='1'/></r>", "1:4", "1:7", "1:10"},
      {"references before", "<r y='&lt;&#65;'><a x='1'/></r>", "1:18", "1:21", "1:24"},
      {"lines in a value before", "<r y='\n\n'><a x='1'/></r>", "3:3", "3:6", "3:9"},
      {"several lines", "<r>\n<a\n  y='2'\n  x\n  =\n  '1'\n/></r>", "2:1", "4:3", "6:4"},
      {"the other quotes", "<r><a y='\"' x=\"'\"/></r>", "1:4", "1:13", "1:16"},
      {"> in a value", "<r y='/>'><a y='>' x='1'/></r>", "1:11", "1:20", "1:23"},
      {"tags in comments", "<r><!-- <a x='0'/>\n <a> --><a x='1'/></r>", "2:9", "2:12", "2:15"},
      {"tags in CDATA and instructions", "<?i <a x='0'>?><r><![CDATA[  ]]>\n<a x='1'/></r>", "2:1",
       "2:4", "2:7"},
      {"x in the name of another", "<r><a xx='x' x='1'/></r>", "1:4", "1:14", "1:17"},
      {"a name of several bytes", "<é><a x='1'/></é>", "1:5", "1:8", "1:11"},
  };
  for (const auto& row : rows) {
    INFO(row.law << ": " << row.text);
    const auto document = parse(row.text);
    CHECK(element_place(*document, 1) == row.element);
    CHECK(name_place(*document, 1, "x") == row.name);
    CHECK(value_place(*document, 1, "x") == row.value);
  }
}

TEST_CASE("a byte of a value is found behind what is written longer than it is read") {
  const auto document = parse("<r x='&lt;é&#x20AC;&#xE9;&#x1F600;.\r\n&#65;z'/>");
  const auto value = std::string(document->find_attribute(0, "x")->value);
  REQUIRE(value == "<é€é😀.\nAz");
  const std::pair<std::string, std::string> rows[] = {{"<", "1:7"},  {"é", "1:11"}, {"€", "1:13"},
                                                      {"😀", "1:27"}, {".", "1:36"}, {"\n", "1:37"},
                                                      {"A", "2:1"},  {"z", "2:6"}};
  for (const auto& [part, expected] : rows) {
    INFO(part);
    CHECK(value_place(*document, 0, "x", value.find(part)) == expected);
  }
  CHECK(value_place(*document, 0, "x", 1000) == "2:7");
}

TEST_CASE("an attribute that is not there is not found") {
  CHECK(parse("<r>\n <a x='1'/></r>")->find_attribute(1, "y") == nullptr);
}

TEST_CASE("the excerpt is the whole line") {
  const auto document = parse("<r>\r\n\t<a/> <b/>\r\n</r>");
  const Source& source = *document->source();
  CHECK(source.excerpt(source.locate(document->elements()[2].place).line).text == "\t<a/> <b/>");
  CHECK(source.excerpt(3).text == "</r>");
  CHECK(source.excerpt(0).text.empty());
  CHECK(source.excerpt(99).text.empty());
}

TEST_CASE("a long line is cut to 200 bytes, not inside of a character") {
  const auto document = parse("<r x='" + std::string(193, 'a') + "é'/>");
  CHECK(document->source()->excerpt(1).text == "<r x='" + std::string(193, 'a'));
  CHECK(document->source()->excerpt(1, 140).column == 1);
  const Excerpt far = document->source()->excerpt(1, 180);
  CHECK(far.column == 80);
  CHECK(far.text.size() <= 200);
}

TEST_CASE("a value that is set stays, and places stay where they are written") {
  const auto document = parse("<r x='1' y='2'/>");
  document->set_value(*document->find_attribute(0, "x"), std::string(1000, 'z'));
  document->set_value(*document->find_attribute(0, "y"), "3");
  CHECK(document->find_attribute(0, "x")->value == std::string(1000, 'z'));
  CHECK(document->find_attribute(0, "y")->value == "3");
  CHECK(value_place(*document, 0, "y") == "1:13");
}

TEST_CASE("a tree of a hundred thousand elements has all its places") {
  std::string text = "<r>\n";
  constexpr std::uint32_t kCount = 100'000;
  for (std::uint32_t i = 0; i < kCount; ++i) text += "  <a x='&amp;'/>\n";
  const auto document = parse(text + "</r>");
  REQUIRE(document->elements().size() == kCount + 1);
  CHECK(value_place(*document, kCount, "x") == "100001:9");
}
