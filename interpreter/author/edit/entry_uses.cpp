#include "author/edit/entry_uses.h"

#include <fmt/format.h>

#include <algorithm>

#include "author/edit/edits.h"
#include "language/expression/token.h"
#include "tree/check/attribute_layout.h"

namespace lockstep::host {
namespace {

using Way = EntryUse::Way;

// With these a SubTree passes on entries without an attribute.
constexpr std::string_view kPassesOnAll[] = {"_autoremap", "__autoremap", "__shared_blackboard"};

const Parameter* parameter_of(const NodeType* type, std::string_view attribute) {
  if (type == nullptr) return nullptr;
  const auto it = std::ranges::find(type->parameters, attribute, &Parameter::name);
  return it == type->parameters.end() ? nullptr : &*it;
}

class UseFinder {
 public:
  UseFinder(const ProjectTexts& texts, std::set<std::string, std::less<>>& open_trees)
      : texts_(texts), open_trees_(open_trees) {}

  std::vector<EntryUse> find(ElementAt part) {
    const std::uint32_t end = texts_.document(part.document).elements()[part.element].end;
    for (std::uint32_t element = part.element; element < end; ++element)
      visit({part.document, element});
    return std::move(uses_);
  }

 private:
  void visit(ElementAt at) {
    const NodeType* const type = texts_.type_of(at);
    const Document& document = texts_.document(at.document);
    if (document.elements()[at.element].tag == "BehaviorTree") return;
    for (const Attribute& it : document.attributes(at.element)) visit(at, type, it);
    if (texts_.is_sub_tree(at)) {
      visit_sub_tree(at);
    } else if (type != nullptr) {
      visit_defaults(at, *type);
    }
  }

  void visit(ElementAt at, const NodeType* type, const Attribute& attribute) {
    const Parameter* const parameter = parameter_of(type, attribute.name);
    const bool is_script = parameter != nullptr
                               ? parameter->is_script
                               : hook_named(attribute.name, texts_.rules()).has_value();
    EntryUse use{Way::Port, at, {}, &attribute, 0, attribute.value.size(), parameter};
    if (attribute.name == "name" || attribute.name == "_description") return;
    if (parameter != nullptr && parameter->is_template) return visit_template(use);
    if (is_script && !key_in_braces(attribute.value)) return visit_script(use);
    if (attribute.value == "{=}") {
      use.way = Way::SameName;
      use.key = attribute.name;
      uses_.push_back(std::move(use));
    } else if (const auto key = key_in_braces(attribute.value)) {
      use.key = *key;
      use.begin = 1;
      use.end = 1 + key->size();
      uses_.push_back(std::move(use));
    } else if (parameter != nullptr && (parameter->is_key || parameter->names_entry)) {
      use.key = attribute.value;
      uses_.push_back(std::move(use));
    }
  }

  // Digits in place of ${argument}, which are a part of a name or a number.
  static std::string without_arguments(std::string_view text) {
    std::string script(text);
    for (auto at = script.find("${"); at != std::string::npos; at = script.find("${", at)) {
      const auto end = std::min(script.find('}', at), script.size() - 1) + 1;
      script.replace(at, end - at, end - at, '0');
    }
    return script;
  }

  void visit_script(EntryUse use) {
    const std::string script = without_arguments(use.attribute->value);
    use.way = Way::Script;
    TokenReader reader;
    for (std::size_t offset = 0;;) {
      const auto token = reader.next(script, offset);
      if (!token || token->symbol == Symbol::End) return;
      if (token->symbol != Symbol::Name) continue;
      if (is_word_of_scripts(token->text, texts_.rules(), texts_.catalog())) continue;
      use.key = token->text;
      use.begin = token->offset;
      use.end = token->offset + token->text.size();
      uses_.push_back(use);
    }
  }

  void visit_template(EntryUse use) {
    use.way = Way::Script;  // a name in a text
    for (const std::string_view key : keys_in_template(use.attribute->value)) {
      use.key = key;
      use.begin = static_cast<std::size_t>(key.data() - use.attribute->value.data());
      use.end = use.begin + key.size();
      uses_.push_back(use);
    }
  }

  void visit_defaults(ElementAt at, const NodeType& type) {
    for (const Parameter& it : type.parameters) {
      const bool is_left_out =
          texts_.document(at.document).find_attribute(at.element, it.name) == nullptr;
      if (!it.default_key.empty() && is_left_out) {
        uses_.push_back({Way::Default, at, std::string(it.default_key), nullptr, 0, 0, &it,
                         std::string(it.name)});
      }
    }
  }

  // Adds the entries that the tree inside uses and no attribute binds.
  void visit_sub_tree(ElementAt at) {
    const std::string id = texts_.full_id(at, "ID");
    for (const ElementAt port : texts_.modeled_ports(id)) {
      const std::string name(texts_.value(port, "name"));
      const auto key = key_in_braces(texts_.value(port, "default"));
      const bool is_left_out =
          texts_.document(at.document).find_attribute(at.element, name) == nullptr;
      if (key && is_left_out)
        uses_.push_back({Way::Default, at, std::string(*key), nullptr, 0, 0, nullptr, name});
    }
    const auto inner = texts_.find_tree(id);
    if (!passes_on_all(texts_, at) || !inner || !open_trees_.insert(id).second) return;
    std::set<std::string> keys;
    for (EntryUse& use : UseFinder(texts_, open_trees_).find(*inner)) keys.insert(use.key);
    open_trees_.erase(id);
    for (const std::string& key : keys) {
      const bool is_own = texts_.rules().marked_keys && key.starts_with('_');
      const bool is_bound = texts_.document(at.document).find_attribute(at.element, key) != nullptr;
      if (!is_own && !is_bound && !key.starts_with('@')) {
        uses_.push_back({Way::Automatic, at, key});
      }
    }
  }

  const ProjectTexts& texts_;
  std::set<std::string, std::less<>>& open_trees_;  // a tree that contains itself is an error
  std::vector<EntryUse> uses_;
};

}  // namespace

bool is_word_of_scripts(std::string_view name, const LanguageRules& rules, const Catalog& catalog) {
  const auto& words = catalog.words();
  const bool is_sign = rules.strict_scripts && (name == "and" || name == "or");
  return is_sign || name == "true" || name == "false" ||
         (words != nullptr && words->find(std::string(name)) != words->end());
}

std::vector<EntryUse> entry_uses(const ProjectTexts& texts, ElementAt part) {
  std::set<std::string, std::less<>> open_trees;
  return UseFinder(texts, open_trees).find(part);
}

std::set<std::string> keys_in(const ProjectTexts& texts, ElementAt part) {
  std::set<std::string> keys;
  for (EntryUse& use : entry_uses(texts, part)) keys.insert(std::move(use.key));
  return keys;
}

std::optional<Problem> names_at_run_time(const ProjectTexts& texts) {
  std::optional<Problem> found;
  texts.for_each_element([&](ElementAt at) {
    const NodeType* const type = texts.type_of(at);
    for (const Attribute& it : texts.document(at.document).attributes(at.element)) {
      const Parameter* const parameter = parameter_of(type, it.name);
      const bool is_name = parameter != nullptr && (parameter->is_script || parameter->is_key);
      if (found || !is_name || !key_in_braces(it.value)) continue;
      found = Problem{fmt::format("'{}' is read from the entry '{}' during the run", it.name,
                                  *key_in_braces(it.value)),
                      "which entries it is about is known then only: change them by hand"};
    }
  });
  return found;
}

bool passes_on_all(const ProjectTexts& texts, ElementAt sub_tree) {
  return std::ranges::any_of(kPassesOnAll, [&](std::string_view name) {
    const std::string_view value = texts.value(sub_tree, name);
    return value == "true" || value == "1";
  });
}

std::optional<std::string_view> binding_of(const ProjectTexts& texts, ElementAt sub_tree,
                                           std::string_view key) {
  const Document& document = texts.document(sub_tree.document);
  if (const Attribute* it = document.find_attribute(sub_tree.element, key)) return it->value;
  for (const ElementAt port : texts.modeled_ports(texts.full_id(sub_tree, "ID"))) {
    const Attribute* const value =
        texts.document(port.document).find_attribute(port.element, "default");
    if (value != nullptr && texts.value(port, "name") == key) return value->value;
  }
  return std::nullopt;
}

bool is_of_sub_trees(const ProjectTexts& texts, std::string_view attribute) {
  return attribute == "ID" || is_common_attribute(attribute) ||
         std::ranges::count(kPassesOnAll, attribute) != 0 ||
         hook_named(attribute, texts.rules()).has_value();
}

bool is_remapping(const ProjectTexts& texts, std::string_view attribute) {
  return !attribute.starts_with('_') && !is_of_sub_trees(texts, attribute);
}

void rename_use(TextEdit& edit, const ProjectTexts& texts, const EntryUse& use,
                std::string_view new_key) {
  const Document& document = texts.document(use.at.document);
  if (use.attribute == nullptr) {
    const std::string name(use.way == Way::Default ? use.port : use.key);
    if (auto added =
            set_attribute(document, use.at.element, name, fmt::format("{{{}}}", new_key))) {
      edit.add(std::move(*added));
    }
  } else if (use.way == Way::SameName) {
    replace_in_value(edit, document, *use.attribute, 0, use.end, fmt::format("{{{}}}", new_key));
  } else {
    replace_in_value(edit, document, *use.attribute, use.begin, use.end, new_key);
  }
}

}  // namespace lockstep::host
