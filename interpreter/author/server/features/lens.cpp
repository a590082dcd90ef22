#include "author/server/features/lens.h"

#include <fmt/format.h>

#include <charconv>
#include <unordered_map>

#include "author/server/features/names.h"
#include "author/server/features/site.h"

namespace lockstep::host {
namespace {

class Lenses {
 public:
  explicit Lenses(const Question& question) : question_(question), tree_(question.file.tree()) {}

  Json all() {
    const FileKind kind = kind_of_file(question_.file.path);
    for (const TolerantElement& it : tree_.elements) {
      if (kind == FileKind::Tree && it.tag == "BehaviorTree" && !tree_.value_of(it, "ID").empty()) {
        add(it, "run on the virtual clock", "lockstep.run", "ID");
        add(it, "verify", "lockstep.verify", "ID");
      }
      if (it.tag != "scenario") continue;
      if (kind != FileKind::Leaves) add(it, "test", "lockstep.test", "name");
    }
    return Json::array(std::move(lenses_));
  }

 private:
  // The editor executes the command: it has terminals and knows where lockstep is.
  void add(const TolerantElement& element, const char* title, const char* command,
           const char* named_by) {
    Json argument{{"uri", question_.file.uri},
                  {"path", question_.file.path},
                  {"name", std::string(tree_.value_of(element, named_by))}};
    std::vector<Json> arguments;
    arguments.push_back(std::move(argument));
    Json call{
        {"title", title}, {"command", command}, {"arguments", Json::array(std::move(arguments))}};
    const ByteRange range{element.begin, tree_.offset_of(element.tag) + element.tag.size()};
    lenses_.push_back(
        Json{{"range", question_.file.positions().json(range)}, {"command", std::move(call)}});
  }

  const Question& question_;
  const TolerantTree& tree_;
  std::vector<Json> lenses_;
};

class Hints {
 public:
  explicit Hints(const Question& question)
      : question_(question), tree_(question.file.tree()), positions_(question.file.positions()) {
    if (!question.params.range) return;
    range_ = {positions_.byte_at(question.params.range->first),
              positions_.byte_at(question.params.range->second)};
  }

  Json all() {
    if (kind_of_file(question_.file.path) != FileKind::Tree) return Json::array();
    for (std::uint32_t i = 0; i < tree_.elements.size(); ++i) {
      const TolerantElement& it = tree_.elements[i];
      if (it.tag_end < range_.begin || it.begin > range_.end) continue;
      add_values(it);
      add_share(it);
    }
    return Json::array(std::move(hints_));
  }

 private:
  void add(std::size_t byte, std::string label, const char* tooltip, bool pads_left) {
    hints_.push_back(Json{{"position", positions_.json(byte)},
                          {"label", std::move(label)},
                          {"tooltip", tooltip},
                          {"paddingLeft", pads_left}});
  }

  // Values of arguments, as they are in force.
  void add_values(const TolerantElement& element) {
    const auto& project = question_.file.analysis->project;
    if (project == nullptr || element.tag == "arg") return;
    for (const TolerantAttribute& it : tree_.attributes_of(element)) {
      std::string value(it.value);
      bool is_changed = false;
      for (const DeclaredArgument& argument : project->arguments) {
        const std::string written = fmt::format("${{{}}}", argument.name);
        for (auto at = value.find(written); at != value.npos;
             at = value.find(written, at + argument.value.size())) {
          value.replace(at, written.size(), argument.value);
          is_changed = true;
        }
      }
      if (is_changed && it.is_closed)
        add(range_of(tree_, it.value).end + 1, "= " + value, "with the values of the arguments",
            true);
    }
  }

  // How much of its parent's progress a node is, where the language fixes it.
  void add_share(const TolerantElement& element) {
    const TolerantElement* const parent = tree_.parent_of(element);
    if (parent == nullptr || !element.is_tag_closed) return;
    if (tree_around(tree_, element) == nullptr || parent->tag == "BehaviorTree") return;
    const std::uint64_t parts = parts_of(*parent);
    if (parts < 2) return;
    const std::size_t behind_tag = tree_.offset_of(element.tag) + element.tag.size();
    add(behind_tag, fmt::format("1/{}", parts),
        "its fraction of the progress of the node around it", true);
  }

  // The number of equal parts of its progress; 0: there are none.
  std::uint64_t parts_of(const TolerantElement& element) {
    const NodeType* const type = type_of(tree_, element, question_.file.analysis->catalog);
    if (type == nullptr) return 0;
    if (type->progress_share == ProgressShare::EachChild) {
      const auto [known, is_new] = children_.try_emplace(&element);
      if (is_new) known->second = children_of(element);
      return known->second;
    }
    if (type->progress_share != ProgressShare::EachRound) return 0;
    std::uint64_t rounds = 0;
    const std::string_view text = tree_.value_of(element, type->parameters[0].name);
    std::from_chars(text.data(), text.data() + text.size(), rounds);
    return rounds;
  }

  std::uint64_t children_of(const TolerantElement& element) const {
    const auto index = static_cast<std::uint32_t>(&element - tree_.elements.data());
    std::uint64_t count = 0;
    for (auto child = index + 1; child < element.last; child = tree_.elements[child].last) ++count;
    return count;
  }

  const Question& question_;
  const TolerantTree& tree_;
  const Positions& positions_;
  ByteRange range_{0, std::string::npos};
  std::vector<Json> hints_;
  std::unordered_map<const TolerantElement*, std::uint64_t> children_;  // how many each has
};

}  // namespace

Json code_lenses(const Question& question) {
  return Lenses(question).all();
}

Json inlay_hints(const Question& question) {
  return Hints(question).all();
}

}  // namespace lockstep::host
