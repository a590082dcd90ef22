// The elements of a file that are no nodes, with their attributes: of trees, scenarios and leaf
// files.
#pragma once

#include <span>
#include <string_view>

#include "author/server/analysis.h"
#include "leaves/leaf_words.h"

namespace lockstep::host {

struct Vocabulary {
  std::string_view root;  // the element around all
  std::span<const leaf_words::Word> root_words;
  std::span<const leaf_words::Tag> tags;  // in it; of scenarios: in a scenario, too
};

const Vocabulary& vocabulary_of(FileKind kind);
// Null: there is no such element.
const leaf_words::Tag* tag_named(const Vocabulary& words, std::string_view name);
// The attributes of an element that is no node.
std::span<const leaf_words::Word> words_of(const Vocabulary& words, std::string_view tag);

}  // namespace lockstep::host
