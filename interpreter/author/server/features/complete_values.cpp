#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include "author/server/features/completion.h"
#include "author/server/features/entries.h"
#include "language/expression/reading.h"
#include "leaves/plugin/open/plugin_path.h"
#include "leaves/remote/json_lines/leaves_file.h"
#include "run/loading/plugin_directories.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

bool is_part_of_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '@' ||
         static_cast<unsigned char>(c) >= 0x80;
}

class ValueItems {
 public:
  ValueItems(const CompletionSite& at, std::vector<CompletionItem>& items, ByteRange& replaced)
      : at_(at),
        items_(items),
        replaced_(replaced),
        element_(*at.site.element),
        attribute_(*at.site.attribute),
        type_(at.kind == FileKind::Tree ? type_of(at.tree, element_, at.catalog) : nullptr),
        parameter_(parameter_of(type_, attribute_.name)) {}

  void add() {
    if (is_in_argument()) return add_arguments();
    if (at_.kind == FileKind::Tree && is_script(type_, attribute_.name, at_.rules))
      return add_script();
    if (is_tree_name()) return add_names(NameKind::Tree, "BehaviorTree");
    if (type_ == nullptr) add_words();
    if (parameter_ != nullptr) add_parameter();
    const bool is_node = tree_around(at_.tree, element_) != nullptr && at_.kind == FileKind::Tree;
    const bool takes_key = parameter_ == nullptr || !parameter_->constant;
    if (is_node && takes_key && attribute_.name != "name") add_keys();
    if (at_.kind == FileKind::Tree && at_.site.word.begin == at_.site.word.end) add_arguments();
  }

 private:
  // "${a": from there on it is replaced.
  bool is_in_argument() {
    const std::string_view before =
        at_.tree.text.substr(at_.site.word.begin, at_.byte - at_.site.word.begin);
    const auto sign = before.rfind("${");
    const bool is_end = before.ends_with('$');
    if (is_end) replaced_.begin = at_.byte - 1;
    if (is_end || sign == before.npos || before.find('}', sign) != before.npos) {
      if (is_end) cut_behind_name();
      return is_end;
    }
    replaced_.begin = at_.site.word.begin + sign;
    cut_behind_name();
    return true;
  }

  // The replaced text ends behind the name that is begun, and its brace.
  void cut_behind_name() {
    std::size_t end = at_.byte;
    while (end < at_.site.word.end && is_part_of_name(at_.tree.text[end])) ++end;
    if (end < at_.site.word.end && at_.tree.text[end] == '}') ++end;
    replaced_.end = end;
  }

  void add_arguments() {
    for (const NamePlace* it : at_.names.declarations(NameKind::Argument)) {
      CompletionItem item{fmt::format("${{{}}}", it->name), ItemKind::Variable};
      const TolerantTree& tree = *it->text->tree;
      const std::string_view value = tree.value_of(*it->element, "default");
      item.detail = value.empty() ? "argument" : fmt::format("argument, default {}", value);
      item.documentation = tree.value_of(*it->element, "doc");
      item.rank = 2;
      items_.push_back(std::move(item));
    }
  }

  void add_script() {
    std::size_t begin = at_.byte;
    while (begin > at_.site.word.begin && is_part_of_name(at_.tree.text[begin - 1])) --begin;
    std::size_t end = at_.byte;
    while (end < at_.site.word.end && is_part_of_name(at_.tree.text[end])) ++end;
    replaced_ = {begin, end};
    for (const EntryFacts& it : entries_of(at_.names, tree_around(at_.tree, element_))) {
      const bool is_here = it.places.size() == 1 && it.places.front()->range == replaced_;
      if (!is_here) add_item({std::string(it.name), ItemKind::Variable, it.type_text()});
    }
    for (const ReadingRow& row : kReadings) {
      add_item({fmt::format("{}()", row.name), ItemKind::Function, std::string(row.doc)});
    }
    if (const auto& words = at_.catalog.words()) {
      for (const auto& [word, number] : *words)
        add_item({word, ItemKind::EnumMember, fmt::format("{}", number)});
    }
  }

  bool is_tree_name() const {
    const bool is_id = is_sub_tree(element_.tag) && attribute_.name == "ID";
    return is_id || attribute_.name == "main_tree_to_execute";
  }

  void add_names(NameKind kind, std::string_view what, std::string_view group = {}) {
    for (const NamePlace* it : at_.names.declarations(kind)) {
      if (it->group != group) continue;
      CompletionItem item{std::string(it->name), ItemKind::Module};
      item.detail = what;
      item.documentation = it->text->tree->value_of(*it->element, "_description");
      item.rank = 0;
      items_.push_back(std::move(item));
    }
  }

  void add_words() {
    for (const leaf_words::Word& it : words_of(at_.words, element_.tag)) {
      if (it.name == attribute_.name) add_choices(it.pattern);
    }
    const bool is_file = attribute_.name == "path" && element_.tag == "include";
    const bool is_scenario_file = at_.kind == FileKind::Scenarios &&
                                  (attribute_.name == "tree" || attribute_.name == "leaves");
    if (is_file || is_scenario_file) add_files();
    if (element_.tag == "plugin" && attribute_.name == "name") add_plugins();
    if (element_.tag == "plugin" && attribute_.name == "program") add_programs();
  }

  // "never|freely|rises" of words, not a pattern.
  void add_choices(std::string_view pattern) {
    if (pattern.find_first_of("[](){}*+?\\") != pattern.npos) return;
    while (!pattern.empty()) {
      const auto end = std::min(pattern.find('|'), pattern.size());
      add_item({std::string(pattern.substr(0, end)), ItemKind::EnumMember});
      pattern.remove_prefix(std::min(end + 1, pattern.size()));
    }
  }

  void add_files() {
    const fs::path typed(at_.tree.text.substr(at_.site.word.begin, at_.byte - at_.site.word.begin));
    const fs::path directory = fs::path(at_.question.file.path).parent_path() / typed.parent_path();
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(directory, error)) {
      const std::string name = entry.path().filename().string();
      const bool is_directory = entry.is_directory(error);
      if (name.starts_with('.') || (!is_directory && !name.ends_with(".xml"))) continue;
      const std::string path = (typed.parent_path() / name).string();
      if (!is_directory && entry.path() == fs::path(at_.question.file.path)) continue;
      add_item({is_directory ? path + "/" : path, ItemKind::File});
    }
  }

  void add_plugins() {
    std::set<std::string> seen;
    for_each_plugin_file([&](const fs::path& path) {
      const std::string name = path.stem().string();
      const bool is_program = path.extension() != ".so";
      if (is_program && !is_program_with_leaves(path)) return;
      if (!seen.insert(name).second) return;
      CompletionItem item{name, ItemKind::Module, path.parent_path().string()};
      if (is_program) item.insert = name + program_behind_name(path.filename().string());
      add_item(std::move(item));
    });
  }

  void add_programs() {
    std::set<std::string> seen;
    for_each_plugin_file([&](const fs::path& path) {
      const std::string file = path.filename().string();
      if (is_program_with_leaves(path) && seen.insert(file).second)
        add_item({file, ItemKind::File, path.parent_path().string()});
    });
  }

  template <class Visit>
  void for_each_plugin_file(Visit visit) const {
    for (const std::string& directory : plugin_directories(at_.question.settings.plugins)) {
      std::error_code error;
      for (const auto& entry : fs::directory_iterator(directory, error)) visit(entry.path());
    }
  }

  // Other files may be executable too, so one counts that has said which leaves it has.
  static bool is_program_with_leaves(const fs::path& path) {
    std::error_code error;
    return path.extension() != ".so" && is_executable(path) &&
           fs::exists(leaves_file_of(path), error);
  }

  // A plugin that is a program is named with its file.
  std::string program_behind_name(std::string_view file) const {
    const auto attributes = at_.tree.attributes_of(element_);
    if (std::ranges::count(attributes, "program", &TolerantAttribute::name) != 0) return {};
    const char quote = at_.tree.text[at_.site.word.begin - 1];
    return fmt::format("{0} program={0}{1}", quote, file);
  }

  void add_parameter() {
    if (parameter_->type == ValueType::Bool) {
      for (const char* word : {"true", "false"}) add_item({word, ItemKind::EnumMember});
    }
    for (const std::string_view word : parameter_->choices)
      add_item({std::string(word), ItemKind::EnumMember});
    if (!parameter_->group.empty())
      add_names(NameKind::Group, parameter_->group, parameter_->group);
    if (parameter_->of_pool) add_resources();
    if (parameter_->default_text && !parameter_->default_text->empty() &&
        parameter_->choices.empty() && parameter_->type != ValueType::Bool)
      add_item({std::string(*parameter_->default_text), ItemKind::Constant, "the default"});
  }

  // Those that the pool declares; the last of the list that is begun is replaced.
  void add_resources() {
    const std::string_view typed =
        at_.tree.text.substr(at_.site.word.begin, at_.byte - at_.site.word.begin);
    const auto sign = typed.find_last_of("; ,(");
    if (sign != typed.npos) replaced_.begin = at_.site.word.begin + sign + 1;
    for (const Parameter& it : type_->parameters) {
      if (it.group.empty()) continue;
      const std::string_view pool = at_.tree.value_of(element_, it.name);
      for (const NamePlace* place : at_.names.declarations(NameKind::Group)) {
        if (place->name != pool || place->group != it.group) continue;
        std::string_view list = place->text->tree->value_of(*place->element, "resources");
        while (!list.empty()) {
          const auto end = std::min(list.find_first_of("; ,"), list.size());
          if (end > 0) add_item({std::string(list.substr(0, end)), ItemKind::EnumMember});
          list.remove_prefix(std::min(end + 1, list.size()));
        }
      }
    }
  }

  void add_keys() {
    for (const EntryFacts& it : entries_of(at_.names, tree_around(at_.tree, element_))) {
      const bool is_here =
          it.places.size() == 1 && at_.site.word.has(it.places.front()->range.begin);
      if (is_here || !it.may_be(parameter_)) continue;
      CompletionItem item{fmt::format("{{{}}}", it.name), ItemKind::Variable, it.type_text()};
      const bool is_output = parameter_ != nullptr && parameter_->direction != Direction::Input;
      item.rank = is_output ? 0 : 1;
      items_.push_back(std::move(item));
    }
  }

  void add_item(CompletionItem item) {
    item.rank = 0;
    items_.push_back(std::move(item));
  }

  const CompletionSite& at_;
  std::vector<CompletionItem>& items_;
  ByteRange& replaced_;
  const TolerantElement& element_;
  const TolerantAttribute& attribute_;
  const NodeType* type_;
  const Parameter* parameter_;
};

}  // namespace

void complete_values(const CompletionSite& at, std::vector<CompletionItem>& items,
                     ByteRange& replaced) {
  ValueItems(at, items, replaced).add();
}

}  // namespace lockstep::host
