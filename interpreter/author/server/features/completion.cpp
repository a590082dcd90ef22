#include "author/server/features/completion.h"

#include <fmt/format.h>

#include <cctype>

namespace lockstep::host {
namespace {

class ListWriter {
 public:
  ListWriter(const Question& question, ByteRange replaced)
      : has_snippets_(question.client.has_snippets),
        has_markdown_(question.client.has_markdown),
        range_(question.file.positions().json(replaced)) {}

  Json write(const std::vector<CompletionItem>& items) const {
    std::vector<Json> all;
    for (const CompletionItem& it : items) all.push_back(json(it));
    return {{"isIncomplete", false}, {"items", Json::array(std::move(all))}};
  }

 private:
  Json json(const CompletionItem& it) const {
    const bool is_plain = it.insert.empty() || (it.is_snippet && !has_snippets_);
    Json edit{{"range", range_}, {"newText", is_plain ? it.label : it.insert}};
    Json item{{"label", it.label},
              {"kind", static_cast<int>(it.kind)},
              {"sortText", fmt::format("{}{}", it.rank, it.label)},
              {"filterText", it.filter.empty() ? it.label : it.filter},
              {"textEdit", std::move(edit)}};
    if (it.is_snippet && !is_plain) item["insertTextFormat"] = 2;
    if (!it.detail.empty()) item["detail"] = it.detail;
    if (!it.documentation.empty()) {
      item["documentation"] =
          Json{{"kind", has_markdown_ ? "markdown" : "plaintext"}, {"value", it.documentation}};
    }
    return item;
  }

  bool has_snippets_, has_markdown_;
  Json range_;
};

// The letters before the position, where no '<' was typed.
ByteRange word_before(std::string_view text, std::size_t byte) {
  std::size_t begin = byte;
  while (begin > 0 && std::isalnum(static_cast<unsigned char>(text[begin - 1])) != 0) --begin;
  return {begin, byte};
}

void complete_end_tag(const Site& site, std::vector<CompletionItem>& items) {
  if (site.element == nullptr) return;
  CompletionItem item{std::string(site.element->tag), ItemKind::Keyword};
  item.insert = item.label + ">";
  items.push_back(std::move(item));
}

}  // namespace

std::string snippet_text(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '$' || c == '}' || c == '\\') safe += '\\';
    safe += c;
  }
  return safe;
}

Json completion(const Question& question) {
  const TolerantTree& tree = question.file.tree();
  const std::size_t byte = question.byte();
  const Site site = site_at(tree, byte);
  const Names names(question);
  const FileKind kind = kind_of_file(question.file.path);
  const CompletionSite at{question,
                          names,
                          tree,
                          site,
                          byte,
                          question.file.analysis->catalog,
                          rules_of(question),
                          vocabulary_of(kind),
                          kind};
  std::vector<CompletionItem> items;
  ByteRange replaced = site.word;
  switch (site.part) {
    case Site::Part::Nothing:
      break;
    case Site::Part::Content:
      replaced = word_before(tree.text, byte);
      if (site.element != nullptr && site.element->tag == "property") {
        complete_property(at, items, replaced);
      } else {
        complete_elements(at, items);
      }
      break;
    case Site::Part::Tag:
      complete_elements(at, items);
      break;
    case Site::Part::EndTag:
      complete_end_tag(site, items);
      break;
    case Site::Part::AttributeName:
      complete_attributes(at, items);
      break;
    case Site::Part::AttributeValue:
      complete_values(at, items, replaced);
      break;
  }
  return ListWriter(question, replaced).write(items);
}

}  // namespace lockstep::host
