#include "author/server/features/vocabulary.h"

#include <algorithm>
#include <vector>

#include "scenario/scenario_words.h"

namespace lockstep::host {
namespace {

using leaf_words::Tag;
using leaf_words::Word;

constexpr Word kRoot[] = {
    {"lockstep", "1", "The version of the tree language.", true},
    {"main_tree_to_execute", "", "The BehaviorTree to run; default: the only one of the file."},
};
constexpr Word kBehaviorTree[] = {
    {"ID", "", "The name of the tree, by which a SubTree takes it.", true},
    {"_description", "", "A remark for readers of the file."},
};
constexpr Word kArgument[] = {
    {"name", "", "What stands for it in the file: ${name}.", true},
    {"default", "", "Its value where none is given; without one it must be given.", false, true},
    {"doc", "", "A remark for readers of the file.", false, true},
};
constexpr Word kInclude[] = {
    {"path", "", "The file, from the directory of this one.", true},
    {"as", "", "A name for the file: with \"truck\" its trees are truck.ID here."},
};
constexpr Word kPlugin[] = {
    {"name", "", "The name of the plugin; files are searched, never named by their paths.", true},
    {"isolate", "true|false", "true: it lives in a separate process."},
    {"program", "", "The file of a process plugin."},
    {"hold", "signal|message|none", "How a program is held."},
};
constexpr Word kProperty[] = {
    {"name", "", "What messages call it.", true},
};
constexpr Tag kScenario{"scenario", scenario_words::kScenario,
                        "What the leaves do, and the expected results."};
constexpr Tag kTree[] = {
    {"BehaviorTree", kBehaviorTree, "A tree, with one node in it."},
    {"plugin", kPlugin, "The nodes of a plugin can be used in the file."},
    {"include", kInclude, "The trees of another file can be used in this one."},
    {"arg", kArgument, "A value that is given when the tree is loaded."},
    {"property", kProperty, "What every run must have, as text: never arm.failure"},
    kScenario,
};

std::span<const Tag> scenario_tags() {
  static const std::vector<Tag> kAll = [] {
    std::vector<Tag> all{kScenario};
    all.insert(all.end(), std::begin(scenario_words::kTags), std::end(scenario_words::kTags));
    return all;
  }();
  return kAll;
}

}  // namespace

const Vocabulary& vocabulary_of(FileKind kind) {
  static const Vocabulary kTrees{"root", kRoot, kTree};
  static const Vocabulary kScenarios{"scenarios", scenario_words::kScenarios, scenario_tags()};
  static const Vocabulary kLeaves{"leaves", leaf_words::kRoot, leaf_words::kTags};
  if (kind == FileKind::Scenarios) return kScenarios;
  return kind == FileKind::Leaves ? kLeaves : kTrees;
}

const Tag* tag_named(const Vocabulary& words, std::string_view name) {
  const auto it = std::ranges::find(words.tags, name, &Tag::name);
  return it == words.tags.end() ? nullptr : &*it;
}

std::span<const Word> words_of(const Vocabulary& words, std::string_view tag) {
  if (tag == words.root) return words.root_words;
  const Tag* const known = tag_named(words, tag);
  return known == nullptr ? std::span<const Word>() : known->words;
}

}  // namespace lockstep::host
