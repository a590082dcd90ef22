// What is known of a text that is broken.
#include <catch2/catch.hpp>
#include <filesystem>

#include "language/document/document.h"
#include "language/document/file.h"
#include "language/document/tolerant.h"
#include "support/paths.h"

namespace lockstep::host::test {
namespace {

// "a(b[x=1 y](c) d)": elements with their attributes, '?' for a tag that does not end.
std::string shape(const TolerantTree& tree, std::uint32_t from, std::uint32_t to) {
  std::string text;
  for (auto i = from; i < to; i = tree.elements[i].last) {
    const TolerantElement& it = tree.elements[i];
    text += (text.empty() ? "" : " ") + std::string(it.tag) + (it.is_tag_closed ? "" : "?");
    std::string attributes;
    for (const TolerantAttribute& attribute : tree.attributes_of(it)) {
      attributes += (attributes.empty() ? "" : " ") + std::string(attribute.name);
      if (attribute.has_quote) attributes += "=" + std::string(attribute.value);
      if (attribute.has_quote && !attribute.is_closed) attributes += "?";
    }
    if (!attributes.empty()) text += "[" + attributes + "]";
    if (it.last > i + 1) text += "(" + shape(tree, i + 1, it.last) + ")";
  }
  return text;
}

std::string shape(std::string_view text) {
  const TolerantTree tree = read_tolerantly(text);
  return shape(tree, 0, static_cast<std::uint32_t>(tree.elements.size()));
}

}  // namespace

TEST_CASE("tolerant: what is known of a broken text") {
  struct Row {
    const char *text, *known;
  };
  const Row row = GENERATE(values<Row>({
      {"", ""},
      {"<", "?"},
      {"<a><b x='1'/><c/></a>", "a(b[x=1] c)"},
      {"<a><Seq", "a(Seq?)"},
      {"<a><b sec</a>", "a(b?[sec])"},
      {"<a><b sec\n<c/></a>", "a(b?[sec] c)"},
      {"<a><b sec=\n<c/></a>", "a(b?[sec] c)"},
      {"<a><b sec=\"\n<c x=\"1\"/></a>", "a(b?[sec=?] c[x=1])"},
      {"<a><b sec=\"/>\n<c x=\"1\"/></a>", "a(b[sec=?] c[x=1])"},
      {"<a><b sec=\"{ke/>\n<c x=\"1\"/></a>", "a(b[sec={ke?] c[x=1])"},
      {"<a><b sec=\"{ke/><c x='1'/></a>", "a(b[sec={ke?] c[x=1])"},
      {"<a><b sec=\"{ke > <c x='1'/></b></a>", "a(b[sec={ke?](c[x=1]))"},
      {"<a><b sec=\"${a\n</a>", "a(b?[sec=${a?])"},
      {"<a><b sec=\"{k name=\"n\"/></a>", "a(b[sec={k? name=n])"},
      {"<a><b>", "a(b)"},
      {"<a><b></a><c/>", "a(b) c"},
      {"<a><b></x></b><c/></a>", "a(b c)"},
      {"<a><b></</a>", "a(b)"},
      {"<a><!-- <b/>", "a"},
      {"<a><![CDATA[<b/>]]><c/></a>", "a(c)"},
      {"<a \xC3\x28=\"1\"><b/></a>", "a(b)"},
      {"<a x=1 y='2'/>", "a[x y=2]"},
      {"<a x='<' y='2'/>", "a[x=< y=2]"},
      {"</a></b>", ""},
  }));
  INFO(row.text);
  CHECK(shape(row.text) == row.known);
}

TEST_CASE("tolerant: the places of elements") {
  const TolerantTree tree = read_tolerantly("<a x=''> <b>t</b> <c/></a>");
  const TolerantElement& a = tree.elements[0];
  const TolerantElement& b = tree.elements[1];
  CHECK(a.tag_end == 8);
  CHECK(a.close == 22);
  CHECK(a.end == 26);
  CHECK(b.begin == 9);
  CHECK(b.close == 13);
  CHECK(b.text == "t");
  CHECK(tree.at(0) == nullptr);
  CHECK(tree.at(3) == &a);
  CHECK(tree.at(8) == &a);
  CHECK(tree.at(10) == &b);
  CHECK(tree.at(13) == &b);
  CHECK(tree.at(18) == &a);
}

// Of a text that is not broken, both readers know the same.
TEST_CASE("tolerant: a good text has the elements that the strict reader finds") {
  std::size_t files = 0;
  for (const char* folder : {"trees", "tests/trees/good", "tests/trees/bad"}) {
    const auto directory = std::filesystem::path(LOCKSTEP_SOURCE_DIR) / folder;
    for (const auto& entry : std::filesystem::directory_iterator(directory)) {
      if (entry.path().extension() != ".xml") continue;
      const std::string text = read_file(entry.path().string(), 1u << 20u).value();
      Diagnostics diagnostics;
      const auto document = Document::parse("a.xml", text, diagnostics);
      if (document == nullptr || diagnostics.has_errors()) continue;
      INFO(entry.path());
      ++files;
      const TolerantTree tree = read_tolerantly(document->source()->text());
      REQUIRE(tree.elements.size() == document->elements().size());
      for (std::uint32_t i = 0; i < tree.elements.size(); ++i) {
        CHECK(tree.elements[i].tag == document->elements()[i].tag);
        CHECK(tree.elements[i].last == document->elements()[i].end);
        CHECK(tree.elements[i].begin == document->elements()[i].place.byte);
      }
    }
  }
  CHECK(files > 50);
}

// Any text that is cut anywhere has a tree, and no byte of it is looked at twice for ever.
TEST_CASE("tolerant: a text that is cut anywhere") {
  const std::string text =
      "<root lockstep=\"1\"><!-- x --><a b='c' d=\"{e}\"><f/>t</a><![CDATA[g]]></root>";
  for (std::size_t length = 0; length <= text.size(); ++length) {
    const TolerantTree tree = read_tolerantly(std::string_view(text).substr(0, length));
    for (const TolerantElement& it : tree.elements) {
      CHECK(it.begin < it.end);
      CHECK(it.tag_end <= it.end);
      CHECK(it.end <= length);
      CHECK(it.last <= tree.elements.size());
    }
    for (std::size_t byte = 0; byte <= length; ++byte) tree.at(byte);
  }
}

}  // namespace lockstep::host::test
