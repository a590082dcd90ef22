#include "author/server/features/names.h"

#include <algorithm>
#include <optional>

#include "author/edit/entry_uses.h"
#include "author/server/features/site.h"
#include "base/core/element_types.h"
#include "base/core/language.h"
#include "language/document/references.h"
#include "language/expression/token.h"

namespace lockstep::host {
namespace {

class NameVisitor {
 public:
  NameVisitor(const ProjectText& text, const Catalog& catalog, const LanguageRules& rules,
              std::vector<NamePlace>& places)
      : text_(text), tree_(*text.tree), catalog_(catalog), rules_(rules), places_(places) {}

  void run() {
    for (const TolerantElement& element : tree_.elements) visit(element);
  }

 private:
  void visit(const TolerantElement& element) {
    const NodeType* const type = type_of(tree_, element, catalog_);
    for (const TolerantAttribute& it : tree_.attributes_of(element)) {
      if (!it.has_quote) continue;
      add_arguments(element, it);
      if (add_declared(element, type, it)) continue;
      if (tree_around(tree_, element) != nullptr || names_group(type, it))
        add_used(element, type, it);
    }
  }

  // A pool, which is in no tree, names its team, too.
  static bool names_group(const NodeType* type, const TolerantAttribute& attribute) {
    const Parameter* const parameter = parameter_of(type, attribute.name);
    return parameter != nullptr && !parameter->group.empty() && !key_in(attribute.value);
  }

  void add(NamePlace place) {
    if (place.name.empty()) return;
    place.text = &text_;
    places_.push_back(place);
  }

  NamePlace place(NameKind kind, const TolerantElement& element, std::string_view name) const {
    return {kind, name, &text_, range_of(tree_, name), &element};
  }

  // "${name}"; "$${" is a text.
  void add_arguments(const TolerantElement& element, const TolerantAttribute& attribute) {
    const std::string_view value = attribute.value;
    for (auto at = value.find("${"); at != value.npos; at = value.find("${", at + 2)) {
      const auto end = value.find('}', at);
      const bool is_text = at > 0 && value[at - 1] == '$';
      if (end == value.npos || is_text) continue;
      add(place(NameKind::Argument, element, value.substr(at + 2, end - at - 2)));
    }
  }

  bool add_declared(const TolerantElement& element, const NodeType* type,
                    const TolerantAttribute& attribute) {
    const auto add_as = [&](NameKind kind, bool is_declaration, std::string_view group = {}) {
      NamePlace it = place(kind, element, attribute.value);
      it.is_declaration = is_declaration;
      it.group = group;
      add(it);
      return true;
    };
    const bool is_id = attribute.name == "ID";
    if (element.tag == "BehaviorTree" && is_id) return add_as(NameKind::Tree, true);
    if (is_sub_tree(element.tag) && is_id) return add_as(NameKind::Tree, false);
    if (attribute.name == "main_tree_to_execute") return add_as(NameKind::Tree, false);
    if (element.tag == "arg" && attribute.name == "name") return add_as(NameKind::Argument, true);
    const bool is_group = type != nullptr && type->category == NodeCategory::Group;
    return is_group && attribute.name == "name" && add_as(NameKind::Group, true, type->id);
  }

  void add_used(const TolerantElement& element, const NodeType* type,
                const TolerantAttribute& attribute) {
    const Parameter* const parameter = parameter_of(type, attribute.name);
    if (names_group(type, attribute)) {
      NamePlace it = place(NameKind::Group, element, attribute.value);
      it.group = parameter->group;
      return add(it);
    }
    NamePlace it = place(NameKind::Entry, element, {});
    it.scope = tree_around(tree_, element);
    it.parameter = parameter;
    it.is_declaration = parameter != nullptr && parameter->writes();
    if (is_script(type, attribute.name, rules_)) return add_script(it, attribute);
    if (parameter != nullptr && parameter->is_template) return add_template(it, attribute);
    const bool takes_names = parameter != nullptr && (parameter->names_entry || parameter->is_key);
    if (const auto key = key_in(attribute.value)) {
      it.name = *key;
    } else if (takes_names && attribute.value.find_first_of("${ ") == std::string_view::npos) {
      it.name = attribute.value;
    }
    it.range = range_of(tree_, it.name);
    add(it);
  }

  void add_template(NamePlace it, const TolerantAttribute& attribute) {
    it.parameter = nullptr;  // of any type
    for (const std::string_view key : keys_in_template(attribute.value)) {
      it.name = key;
      it.range = range_of(tree_, it.name);
      add(it);
    }
  }

  void add_script(NamePlace it, const TolerantAttribute& attribute) {
    const Decoded script = decoded(attribute.value);
    it.parameter = nullptr;  // its type is that of the script
    std::optional<Token> before;
    TokenReader reader;
    for (std::size_t offset = 0;;) {
      const auto token = reader.next(script.text, offset);
      const bool is_assigned =
          token && token->symbol >= Symbol::Make && token->symbol <= Symbol::DivideBy;
      if (before) {
        const std::size_t begin = script.raw[before->offset];
        it.name = attribute.value.substr(begin, before->text.size());
        it.range = range_of(tree_, it.name);
        it.is_declaration = is_assigned;
        add(it);
        before.reset();
      }
      if (!token || token->symbol == Symbol::End) return;
      const bool is_name = token->symbol == Symbol::Name;
      if (is_name && !is_word_of_scripts(token->text, rules_, catalog_)) before = *token;
    }
  }

  const ProjectText& text_;
  const TolerantTree& tree_;
  const Catalog& catalog_;
  const LanguageRules& rules_;
  std::vector<NamePlace>& places_;
};

}  // namespace

Names::Names(const Question& question) {
  const Analysis& analysis = *question.file.analysis;
  add_texts(question);
  for (const ProjectText& it : texts_)
    NameVisitor(it, analysis.catalog, rules_of(question), places_).run();
  find_declared(analysis.project.get());
  for (const ProjectText& it : texts_) add_remappings(it, rules_of(question));
}

// A file that is included twice is one text.
void Names::add_texts(const Question& question) {
  const Analysis& analysis = *question.file.analysis;
  texts_.push_back({question.file.uri, question.file.identity, &question.file.tree(),
                    question.file.positions()});
  for (std::size_t i = 0; i < analysis.included.size(); ++i) {
    const std::string& path = analysis.texts[i + 1]->path();
    std::string identity = file_identity(path);
    if (std::ranges::find(texts_, identity, &ProjectText::identity) != texts_.end()) continue;
    const TolerantTree& tree = analysis.included[i];
    texts_.push_back(
        {question.workspace.uri_of(path), std::move(identity), &tree, Positions(tree.text)});
  }
  const auto& project = analysis.project;
  for (std::size_t i = 0; project && i < project->documents.size(); ++i) {
    const std::string identity = file_identity(project->documents[i]->source()->path());
    const auto text = std::ranges::find(texts_, identity, &ProjectText::identity);
    if (text != texts_.end()) text->prefixes.push_back(project->prefixes[i]);
  }
  for (ProjectText& it : texts_)
    if (it.prefixes.empty()) it.prefixes.emplace_back();
}

void Names::find_declared(const Project* project) {
  for (const NamePlace& it : places_) {
    if (!it.is_declaration || (it.kind != NameKind::Tree && it.kind != NameKind::Group)) continue;
    Declared& all = it.kind == NameKind::Tree ? trees_ : groups_;
    for (const std::string& prefix : it.text->prefixes)
      all.emplace(prefix + std::string(it.name), it.element);
  }
  // The name of a file stands for its main tree.
  for (std::size_t i = 0; project != nullptr && i < project->named.size(); ++i) {
    const Project::NamedFile& file = project->named[i];
    const std::string identity = file_identity(project->documents[file.document]->source()->path());
    const auto text = std::ranges::find(texts_, identity, &ProjectText::identity);
    if (text == texts_.end() || text->tree->elements.empty()) continue;
    std::string_view id =
        text->tree->value_of(text->tree->elements.front(), "main_tree_to_execute");
    const auto is_only = [&](const NamePlace& it) {
      return it.text == &*text && it.kind == NameKind::Tree && it.is_declaration;
    };
    if (id.empty() && std::ranges::count_if(places_, is_only) == 1)
      id = std::ranges::find_if(places_, is_only)->name;
    const auto tree = trees_.find(file.name + '.' + std::string(id));
    if (tree != trees_.end()) trees_.emplace(file.name, tree->second);
  }
  for (NamePlace& it : places_) {
    if (it.kind == NameKind::Tree) it.declared = find(trees_, *it.text, it.name);
    if (it.kind == NameKind::Group) it.declared = find(groups_, *it.text, it.name);
  }
}

const TolerantElement* Names::find(const Declared& all, const ProjectText& text,
                                   std::string_view name) {
  const auto it = all.find(text.prefixes.front() + std::string(name));
  return it == all.end() ? nullptr : it->second;
}

// <SubTree ID="Inner" key="…">: `key` is an entry of Inner, or a barrier or a pool that Inner has
// by that name, for which another one stands here.
void Names::add_remappings(const ProjectText& text, const LanguageRules& rules) {
  for (const TolerantElement& element : text.tree->elements) {
    if (!is_sub_tree(element.tag)) continue;
    const TolerantElement* const tree = find(trees_, text, text.tree->value_of(element, "ID"));
    for (const TolerantAttribute& it : text.tree->attributes_of(element)) {
      const bool is_own = it.name == "ID" || it.name == "name" || it.name.starts_with('_');
      if (tree == nullptr || is_own || hook_named(it.name, rules)) continue;
      const std::size_t begin = text.tree->offset_of(it.name);
      NamePlace place{NameKind::Entry, it.name, &text, {begin, begin + it.name.size()}, &element};
      place.declared = find(groups_, *text_of(*tree), it.name);
      if (place.declared == nullptr) {
        place.scope = tree;
        place.is_declaration = true;
        places_.push_back(place);
        continue;
      }
      place.kind = NameKind::Group;
      places_.push_back(place);
      if (it.value.empty() || key_in(it.value)) continue;
      place.name = it.value;
      place.range = range_of(*text.tree, it.value);
      place.declared = find(groups_, text, it.value);
      places_.push_back(place);
    }
  }
}

const ProjectText* Names::text_of(const TolerantElement& element) const {
  const auto has = [&](const ProjectText& text) {
    const auto& all = text.tree->elements;
    return !all.empty() && &element >= &all.front() && &element <= &all.back();
  };
  const auto it = std::ranges::find_if(texts_, has);
  return it == texts_.end() ? nullptr : &*it;
}

bool Names::has_group(const TolerantElement& beside, std::string_view name) const {
  return find(groups_, *text_of(beside), name) != nullptr;
}

const NamePlace* Names::at(std::size_t byte) const {
  const auto it = std::ranges::find_if(places_, [&](const NamePlace& place) {
    return place.text == &texts_.front() && place.range.has(byte);
  });
  return it == places_.end() ? nullptr : &*it;
}

std::vector<const NamePlace*> Names::same_as(const NamePlace& name) const {
  std::vector<const NamePlace*> same;
  for (const NamePlace& it : places_) {
    const bool is_same = it.declared == name.declared && it.scope == name.scope &&
                         (it.declared != nullptr || it.name == name.name);
    if (it.kind == name.kind && is_same) same.push_back(&it);
  }
  std::stable_partition(same.begin(), same.end(),
                        [](const NamePlace* it) { return it->is_declaration; });
  return same;
}

std::vector<const NamePlace*> Names::declarations(NameKind kind) const {
  std::vector<const NamePlace*> found;
  for (const NamePlace& it : places_)
    if (it.kind == kind && it.is_declaration) found.push_back(&it);
  return found;
}

const TolerantElement* Names::tree_named(std::string_view id) const {
  return find(trees_, texts_.front(), id);
}

std::vector<Question> projects_with(const Question& question, const std::string& identity) {
  std::vector<Question> all{question};
  for (const auto& [uri, file] : question.workspace.files()) {
    if (&file == &question.file || file.analysis == nullptr) continue;
    if (kind_of_file(file.path) != FileKind::Tree) continue;
    const bool has = std::ranges::any_of(file.analysis->texts, [&](const auto& it) {
      return file_identity(it->path()) == identity;
    });
    if (has) {
      all.push_back(
          {question.workspace, file, question.client, question.params, question.settings});
    }
  }
  return all;
}

const TolerantElement* tree_around(const TolerantTree& tree, const TolerantElement& element) {
  const TolerantElement* it = tree.parent_of(element);
  while (it != nullptr && it->tag != "BehaviorTree") it = tree.parent_of(*it);
  return it;
}

const LanguageRules& rules_of(const Question& question) {
  const auto& project = question.file.analysis->project;
  return project ? *project->rules : kLockstepRules;
}

bool is_sub_tree(std::string_view tag) {
  return tag == "SubTree" || tag == "SubTreePlus";
}

bool is_script(const NodeType* type, std::string_view attribute, const LanguageRules& rules) {
  const Parameter* const parameter = parameter_of(type, attribute);
  if (parameter != nullptr) return parameter->is_script && !parameter->is_template;
  return hook_named(attribute, rules).has_value();
}

std::optional<std::string_view> key_in(std::string_view value) {
  const auto first = value.find_first_not_of(" \t\r\n");
  if (first == value.npos || value[first] != '{') return std::nullopt;
  const auto end = std::min(value.find('}', first), value.size());
  return value.substr(first + 1, end - first - 1);
}

Decoded decoded(std::string_view value) {
  Decoded result;
  for (std::size_t at = 0; at < value.size();) {
    const std::string_view rest = value.substr(at);
    const auto unit = rest.front() == '&' ? read_reference(rest) : std::nullopt;
    char c = rest.front();
    if (unit) {
      constexpr std::pair<std::string_view, char> kNamed[] = {
          {"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}};
      c = '_';
      for (const auto& [name, character] : kNamed)
        if (rest.starts_with(name)) c = character;
    }
    result.text += c;
    result.raw.push_back(at);
    at += unit ? unit->raw : 1;
  }
  result.raw.push_back(value.size());
  return result;
}

}  // namespace lockstep::host
