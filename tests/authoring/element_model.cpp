#include "authoring/element_model.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/core/pre_order.h"
#include "support/paths.h"

namespace lockstep::host::test {
namespace {

ElementModel* find(ElementModel& model, std::uint32_t& left) {
  if (left == 0) return &model;
  --left;
  for (ElementModel& child : model.children)
    if (ElementModel* const found = find(child, left)) return found;
  return nullptr;
}

}  // namespace

ElementModel model_of(const Document& document, std::uint32_t element) {
  const auto elements = document.elements();
  ElementModel model{std::string(elements[element].tag)};
  for (const Attribute& it : document.attributes(element)) {
    if (!it.name.empty()) model.attributes.emplace_back(it.name, it.value);
  }
  for (const std::uint32_t child : children_in(elements, element))
    model.children.push_back(model_of(document, child));
  return model;
}

ElementModel& part_of(ElementModel& model, std::uint32_t element) {
  return *find(model, element);
}

std::unique_ptr<Document> parsed(std::string text) {
  Diagnostics diagnostics;
  return Document::parse("tree.xml", std::move(text), diagnostics);
}

bool has_errors(const std::string& text) {
  Diagnostics diagnostics;
  return Document::parse("tree.xml", text, diagnostics) == nullptr || diagnostics.has_errors();
}

std::vector<std::string> texts_of_trees() {
  namespace fs = std::filesystem;
  std::vector<std::string> texts;
  for (const char* folder : {"trees", "tests/trees"}) {
    for (const auto& file :
         fs::recursive_directory_iterator(fs::path(LOCKSTEP_SOURCE_DIR) / folder)) {
      if (file.path().extension() != ".xml") continue;
      std::ifstream stream(file.path(), std::ios::binary);
      std::string text{std::istreambuf_iterator<char>(stream), {}};
      if (parsed(text) != nullptr) texts.push_back(std::move(text));
    }
  }
  std::sort(texts.begin(), texts.end());  // in the same order everywhere
  return texts;
}

std::vector<std::string> comments_in(std::string_view text) {
  std::vector<std::string> comments;
  for (auto at = text.find("<!--"); at != std::string_view::npos; at = text.find("<!--", at + 4)) {
    std::string& comment = comments.emplace_back();
    for (const char c : text.substr(at, text.find("-->", at) - at))
      if (c != ' ' && c != '\t' && c != '\r' && c != '\n') comment += c;
  }
  return comments;
}

}  // namespace lockstep::host::test
