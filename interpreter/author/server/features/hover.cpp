#include "author/server/features/hover.h"

#include <fmt/format.h>

#include "author/server/features/entries.h"
#include "author/server/features/site.h"
#include "author/server/features/vocabulary.h"
#include "describe/node_reference.h"

namespace lockstep::host {
namespace {

class Hover {
 public:
  explicit Hover(const Question& question)
      : question_(question),
        tree_(question.file.tree()),
        byte_(question.byte()),
        site_(site_at(tree_, byte_)),
        kind_(kind_of_file(question.file.path)) {}

  Json answer() {
    const std::string text = this->text();
    if (text.empty()) return {};
    Json contents{{"kind", question_.client.has_markdown ? "markdown" : "plaintext"},
                  {"value", text}};
    return {{"contents", std::move(contents)}, {"range", question_.file.positions().json(range_)}};
  }

 private:
  std::string text() {
    if (site_.element == nullptr || site_.part == Site::Part::Content) return {};
    range_ = site_.word;
    type_ = kind_ == FileKind::Tree
                ? type_of(tree_, *site_.element, question_.file.analysis->catalog)
                : nullptr;
    if (site_.part == Site::Part::Tag || site_.part == Site::Part::EndTag) return of_tag();
    if (site_.attribute == nullptr) return {};
    if (site_.part == Site::Part::AttributeName) return of_attribute();
    const std::string name = kind_ == FileKind::Tree ? of_name() : "";
    return name.empty() ? of_attribute() : name;
  }

  std::string code(const std::string& text) const {
    return question_.client.has_markdown ? fmt::format("```text\n{}```", text) : text;
  }

  std::string of_tag() const {
    if (type_ != nullptr) return code(node_as_text(*type_));
    const auto* const word = tag_named(vocabulary_of(kind_), site_.element->tag);
    return word == nullptr ? "" : std::string(word->doc);
  }

  std::string of_attribute() const {
    const std::string_view name = site_.attribute->name;
    if (const Parameter* it = parameter_of(type_, name))
      return fmt::format("{}: {}\n\n{}", name, facts_text(*it), it->doc);
    for (const leaf_words::Word& it : words_of(vocabulary_of(kind_), site_.element->tag))
      if (it.name == name) return fmt::format("{}\n\n{}", name, it.doc);
    if (type_ == nullptr) return {};
    for (const CommonAttribute& it : common_attributes())
      if (it.name == name) return fmt::format("{}\n\n{}", name, it.doc);
    if (has_action_attributes(*type_) && is_of_actions(name, rules_of(question_))) {
      const bool is_commit = name == rules_of(question_).commit;
      return fmt::format("{}\n\n{}", name, action_attributes()[is_commit ? 1 : 0].doc);
    }
    if (const auto hook = hook_named(name, rules_of(question_)))
      return fmt::format("{}\n\n{}", name,
                         script_attributes()[static_cast<std::size_t>(*hook)].doc);
    return {};
  }

  std::string of_name() {
    const Names names(question_);
    const NamePlace* const place = names.at(byte_);
    if (place == nullptr) return {};
    range_ = place->range;
    const auto same = names.same_as(*place);
    const NamePlace* const declared = same.front()->is_declaration ? same.front() : nullptr;
    if (place->kind == NameKind::Entry) return of_entry(names, *place);
    if (declared == nullptr) return {};
    const auto value = [&](std::string_view name) {
      return declared->text->tree->value_of(*declared->element, name);
    };
    const auto with = [](std::string text, std::string_view more) {
      return more.empty() ? text : fmt::format("{}\n\n{}", text, more);
    };
    if (place->kind == NameKind::Tree)
      return with(fmt::format("BehaviorTree {}", place->name), value("_description"));
    if (place->kind == NameKind::Group) return fmt::format("{} {}", declared->group, place->name);
    const std::string_view default_text = value("default");
    return with(fmt::format("argument {}{}", place->name,
                            default_text.empty() ? ", must be given"
                                                 : fmt::format(", default {}", default_text)),
                value("doc"));
  }

  std::string of_entry(const Names& names, const NamePlace& place) const {
    for (const EntryFacts& it : entries_of(names, place.scope)) {
      if (it.name != place.name) continue;
      std::string text = fmt::format("entry {}: {}", it.name, it.type_text());
      const auto add = [&](bool writes, std::string_view verb) {
        for (const NamePlace* user : it.places) {
          if (user->is_declaration != writes) continue;
          const std::string_view name = tree_.value_of(*user->element, "name");
          text += fmt::format("\n- {} by {}{}, line {}", verb, user->element->tag,
                              name.empty() ? "" : fmt::format(" '{}'", name),
                              user->text->positions.position_of(user->range.begin).line + 1);
        }
      };
      text += "\n";
      add(true, "written");
      add(false, "read");
      return text;
    }
    return {};
  }

  const Question& question_;
  const TolerantTree& tree_;
  std::size_t byte_;
  Site site_;
  FileKind kind_;
  const NodeType* type_ = nullptr;
  ByteRange range_;
};

}  // namespace

Json hover(const Question& question) {
  return Hover(question).answer();
}

}  // namespace lockstep::host
