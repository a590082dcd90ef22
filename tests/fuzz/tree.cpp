// Any text as a tree file: ends in errors with a place, or in a tree that ticks a hundred times.
// And what a Document says of a text is what tinyxml2 says of it.
#include <tinyxml2.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "engine/compile.h"
#include "language/document/language_of.h"
#include "language/document/scanner.h"
#include "run/loading/plugins.h"
#include "run/run.h"
#include "tree/check/plugin_requests.h"
#include "tree/resolve.h"

namespace fuzz_tree_target {
namespace {

using namespace lockstep::host;

void tick(const Tree& tree) {
  Run run(tree, {});
  for (int i = 0; i < 100; ++i) {
    const Status status = run.tick(i * run.period());
    if (status == Status::Idle || run.fault() != nullptr) std::abort();  // no leaf here may fail
  }
}

void check(bool holds) {
  if (!holds) std::abort();
}

// The text of an element, which is an attribute without a name.
bool has_text(const tinyxml2::XMLElement& element, std::string_view text) {
  for (const auto* child = element.FirstChild(); child != nullptr; child = child->NextSibling()) {
    const bool is_it = child->ToText() != nullptr &&
                       std::string_view(child->Value()).find(text) != std::string_view::npos;
    if (is_it) return true;
  }
  return false;
}

// Compares the elements from `element` on, in pre-order, and returns the first after `from`.
std::uint32_t compare(const Document& document, std::uint32_t element,
                      const tinyxml2::XMLElement& from) {
  check(element < document.elements().size() && document.elements()[element].tag == from.Name());
  const auto* next = from.FirstAttribute();
  for (const Attribute& attribute : document.attributes(element)) {
    if (attribute.name.empty()) {
      check(has_text(from, attribute.value));
      continue;
    }
    check(next != nullptr && attribute.name == next->Name() && attribute.value == next->Value());
    next = next->Next();
  }
  check(next == nullptr);
  auto end = element + 1;
  for (const auto* child = from.FirstChildElement(); child; child = child->NextSiblingElement())
    end = compare(document, end, *child);
  check(document.elements()[element].end == end);
  return end;
}

void compare_with_reader(std::string text) {
  Diagnostics diagnostics;
  const auto document = Document::parse("tree.xml", text, diagnostics);
  // Documents for BehaviorTree.CPP may be less than XML, and are read with other rules.
  if (document == nullptr || &document->rules() != &kLockstepRules) return;
  // What tinyxml2 does not take everywhere: instructions, DOCTYPE.
  std::string taken(document->source()->text());
  Scanner scanner(document->source()->text());
  for (auto it = scanner.next(); it.kind != TokenKind::End; it = scanner.next()) {
    if (it.kind != TokenKind::Doctype && (it.kind != TokenKind::Instruction || it.begin == 0))
      continue;
    std::fill_n(taken.begin() + static_cast<std::ptrdiff_t>(it.begin), it.value.size(), ' ');
  }
  tinyxml2::XMLDocument xml;
  const auto error = xml.Parse(taken.data(), taken.size());
  if (error == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED) return;
  check(error == tinyxml2::XML_SUCCESS);
  check(compare(*document, 0, *xml.RootElement()) == document->elements().size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  compare_with_reader(text);
  Diagnostics diagnostics;
  const auto project = load_project_text("/nowhere/tree.xml", text, {}, diagnostics);
  if (project == nullptr) {
    if (!diagnostics.has_errors()) std::abort();
    return 0;
  }
  requested_plugins(*project, diagnostics);
  const auto definition = resolve(*project, make_catalog({}, language_of(text)), {}, diagnostics);
  if (definition.has_value() == diagnostics.has_errors()) std::abort();
  diagnostics.sort();
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    if (render(diagnostic, false).empty()) std::abort();
  }
  if (definition && definition->nodes.size() < 10'000) tick(compile(*definition));
  return 0;
}

}  // namespace fuzz_tree_target
