// The list of what may be written at a position.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "author/server/features/names.h"
#include "author/server/features/site.h"
#include "author/server/features/vocabulary.h"

namespace lockstep::host {

// As the protocol numbers them.
enum class ItemKind : int {
  Text = 1,
  Function = 3,
  Variable = 6,
  Class = 7,
  Module = 9,
  Property = 10,
  Constant = 12,
  Keyword = 14,
  File = 17,
  EnumMember = 20,
  Struct = 22,
  Event = 23
};

struct CompletionItem {
  std::string label;
  ItemKind kind = ItemKind::Text;
  std::string detail = {};
  std::string documentation = {};  // Markdown
  std::string insert = {};         // "": the label
  bool is_snippet = false;
  int rank = 1;             // lower ones come first
  std::string filter = {};  // "": the label
};

struct CompletionSite {
  const Question& question;
  const Names& names;
  const TolerantTree& tree;
  const Site& site;
  std::size_t byte;
  const Catalog& catalog;
  const LanguageRules& rules;
  const Vocabulary& words;
  FileKind kind;
};

// Adds what may stand there; the text that it stands for may become smaller than the word there.
void complete_elements(const CompletionSite& at, std::vector<CompletionItem>& items);
void complete_attributes(const CompletionSite& at, std::vector<CompletionItem>& items);
void complete_values(const CompletionSite& at, std::vector<CompletionItem>& items,
                     ByteRange& replaced);

// In the text of a property.
void complete_property(const CompletionSite& at, std::vector<CompletionItem>& items,
                       ByteRange& replaced);

// Without the characters that mean something in a snippet.
std::string snippet_text(std::string_view text);

Json completion(const Question& question);

}  // namespace lockstep::host
