// A program that has its own copy of tinyxml2, as one that links BehaviorTree.CPP has. The calls of
// lockstep's library come to that copy, whatever its version: here one whose documents are larger.
#include <array>
#include <catch2/catch.hpp>
#include <cstddef>
#include <lockstep/runtime.hpp>

// The names of tinyxml2 and no more: it is they that count.
// NOLINTBEGIN(misc-use-internal-linkage)
namespace tinyxml2 {
namespace {
int documents = 0;
}

enum Whitespace : int {};

class XMLElement;
class XMLNode {
 public:
  const XMLElement* FirstChildElement(const char* name) const;
  const XMLElement* NextSiblingElement(const char* name) const;
};
class XMLElement : public XMLNode {
 public:
  const char* Attribute(const char* name, const char* value) const;
};
class XMLDocument : public XMLNode {
 public:
  XMLDocument(bool entities, Whitespace whitespace);
  ~XMLDocument();
  int Parse(const char* text, std::size_t length);

 private:
  std::array<char, 3000> larger_;
};

namespace {
const XMLElement element;
}

[[gnu::used]] const XMLElement* XMLNode::FirstChildElement(const char* /*name*/) const {
  return &element;
}
[[gnu::used]] const XMLElement* XMLNode::NextSiblingElement(const char* /*name*/) const {
  return &element;
}
[[gnu::used]] const char* XMLElement::Attribute(const char* /*name*/, const char* /*value*/) const {
  return "read by the other version";
}
[[gnu::used]] XMLDocument::XMLDocument(bool /*entities*/, Whitespace /*whitespace*/) : larger_{} {
  larger_.fill('x');
  ++documents;
}
[[gnu::used]] XMLDocument::~XMLDocument() {
  larger_.fill('y');
}
[[gnu::used]] int XMLDocument::Parse(const char* /*text*/, std::size_t /*length*/) {
  larger_.fill('z');
  return 0;
}

}  // namespace tinyxml2
// NOLINTEND(misc-use-internal-linkage)

#if !defined(__SANITIZE_ADDRESS__)  // with it comes a check of types, which this is meant to break
TEST_CASE("a program may have another version of tinyxml2 in it") {
  lockstep::runtime::Project project;
  project.load_text(
      R"(<root lockstep="1"><BehaviorTree ID="Main"><Wait name="a &quot;b" seconds="1"/></BehaviorTree></root>)");
  CHECK(project.nodes().back().path == "Main/read by the other version");
  CHECK(tinyxml2::documents == 1);
}
#endif
