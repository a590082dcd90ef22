// The names in the texts of a project: of trees, arguments, groups and entries, with every place
// where each of them is written. For definition, references, hover and completion.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "author/server/features/feature.h"
#include "base/core/node_type.h"
#include "tree/mend/element_type.h"

namespace lockstep::host {

struct ProjectText {
  std::string uri, identity;  // file_identity()
  const TolerantTree* tree;
  Positions positions;
  // What <include as="truck"> puts before its names, for each time that it is included.
  std::vector<std::string> prefixes = {};
};

enum class NameKind : unsigned char { Tree, Argument, Group, Entry };

struct NamePlace {
  NameKind kind;
  std::string_view name;
  const ProjectText* text;
  ByteRange range;
  const TolerantElement* element;          // in which it is
  const TolerantElement* scope = nullptr;  // of an entry: the BehaviorTree; of a group: none
  bool is_declaration = false;             // of an entry: something writes it here
  const Parameter* parameter = nullptr;    // whose value it is
  std::string_view group = {};             // the type of a group
  // Of a tree and a group: the element that declares it, in whatever file; null: it is not known.
  const TolerantElement* declared = nullptr;
};

class Names {
 public:
  explicit Names(const Question& question);

  const std::vector<ProjectText>& texts() const { return texts_; }  // the file first
  const std::vector<NamePlace>& places() const { return places_; }
  // At this byte of the file.
  const NamePlace* at(std::size_t byte) const;
  // All places of the same name, declarations first.
  std::vector<const NamePlace*> same_as(const NamePlace& name) const;
  std::vector<const NamePlace*> declarations(NameKind kind) const;
  // As the file calls it.
  const TolerantElement* tree_named(std::string_view id) const;
  // In which text it is.
  const ProjectText* text_of(const TolerantElement& element) const;
  // Whether a group beside that one has the name.
  bool has_group(const TolerantElement& beside, std::string_view name) const;

 private:
  using Declared = std::map<std::string, const TolerantElement*, std::less<>>;

  void add_texts(const Question& question);
  void find_declared(const Project* project);
  void add_remappings(const ProjectText& text, const LanguageRules& rules);
  static const TolerantElement* find(const Declared& all, const ProjectText& text,
                                     std::string_view name);

  std::vector<ProjectText> texts_;
  std::vector<NamePlace> places_;
  Declared trees_, groups_;  // as the file calls them
};

// The same question about its file, then about each open one in whose project the text is.
std::vector<Question> projects_with(const Question& question, const std::string& identity);

// The BehaviorTree around an element, or null.
const TolerantElement* tree_around(const TolerantTree& tree, const TolerantElement& element);
const LanguageRules& rules_of(const Question& question);
bool is_sub_tree(std::string_view tag);
// Whether an attribute of a node has a script.
bool is_script(const NodeType* type, std::string_view attribute, const LanguageRules& rules);
// "key" of "{key}", as far as it is written; nothing: it is none.
std::optional<std::string_view> key_in(std::string_view value);

// A text of the file as scripts have it, without references, and where each byte comes from.
struct Decoded {
  std::string text;
  std::vector<std::size_t> raw;  // for each byte, and for the end
};
Decoded decoded(std::string_view value);

}  // namespace lockstep::host
