#include "property/plan_document.h"

#include <fmt/format.h>

#include <map>

namespace lockstep::host::test {
namespace {

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char letter : text) {
    if (letter == '<')
      safe += "&lt;";
    else if (letter == '>')
      safe += "&gt;";
    else
      safe += letter;
  }
  return safe;
}

std::string attribute(const std::string& name, const std::string& value) {
  return fmt::format(" {}=\"{}\"", name, escaped(value));
}

class DocumentWriter {
 public:
  explicit DocumentWriter(const Plan& plan) {
    const std::string tree = element(plan, 2);
    text_ = "<root lockstep=\"1\" main_tree_to_execute=\"Test\">\n";
    for (const Plan& group : plan.beside) text_ += element(group, 1);
    text_ += fmt::format("  <BehaviorTree ID=\"Test\">\n{}  </BehaviorTree>\n", tree);
    for (const auto& [inside, id] : trees_) {
      text_ += fmt::format("  <BehaviorTree ID=\"{}\">\n{}  </BehaviorTree>\n", id, inside);
    }
    text_ += "</root>\n";
  }
  std::string text() && { return std::move(text_); }

 private:
  static std::string tag(const Plan& plan) {
    if (plan.kind == "action") return "Scripted";
    if (plan.kind == "condition") return "ScriptedCondition";
    return plan.kind == "bare" ? "Bare" : plan.kind;
  }

  std::string element(const Plan& plan, std::size_t depth) {
    std::string text(2 * depth, ' ');
    text += '<' + tag(plan);
    if (!plan.script.empty()) text += attribute("name", plan.name);
    for (const auto& [name, value] : attributes_of(plan)) text += attribute(name, value);
    if (plan.kind == "SubTree") return text + reference(plan);
    if (plan.children.empty()) return text + "/>\n";
    text += ">\n";
    for (const Plan& child : plan.children) text += element(child, depth + 1);
    return text + std::string(2 * depth, ' ') + "</" + tag(plan) + ">\n";
  }

  // Subtrees with the same content are one tree. Entries are those of the main tree everywhere.
  std::string reference(const Plan& plan) {
    const std::string inside = element(plan.children[0], 2);
    const auto tree = trees_.try_emplace(inside, fmt::format("Tree{}", trees_.size())).first;
    std::string text = attribute("ID", tree->second) + " _autoremap=\"true\"";
    for (const auto& [name, outside] : plan.renames) text += attribute(name, outside);
    return text + "/>\n";
  }

  std::map<std::string, std::string> trees_;  // by content: the IDs
  std::string text_;
};

}  // namespace

std::string document_text(const Plan& plan) {
  return DocumentWriter(plan).text();
}

}  // namespace lockstep::host::test
