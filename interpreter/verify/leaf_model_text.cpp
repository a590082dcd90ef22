#include "verify/leaf_model_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <set>

#include "base/core/diagnostics.h"
#include "base/core/value.h"
#include "base/core/wording.h"
#include "language/document/value_text.h"
#include "language/expression/expression.h"
#include "leaves/declared.h"
#include "leaves/models.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kWidth = 98;
constexpr std::size_t kMostPaths = 4;

// A comment cannot have "--" in it.
std::string comment(std::string_view text, std::string_view indent) {
  std::string words = printable(text), all = fmt::format("{}<!-- ", indent);
  for (std::size_t at = 0; (at = words.find("--", at)) != std::string::npos;) {
    words.insert(at + 1, " ");
  }
  std::size_t column = all.size();
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    if (column + end - at > kWidth && column > indent.size() + 5) {
      all += fmt::format("\n{}     ", indent);
      column = indent.size() + 5;
    }
    all.append(words, at, end - at).append(end < words.size() ? " " : "");
    column += end - at + 1;
    at = end + 1;
  }
  while (all.ends_with(' ')) all.pop_back();
  std::string::size_type blank = 0;
  while ((blank = all.find(" \n")) != std::string::npos) all.erase(blank, 1);
  return all + " -->\n";
}

// The numbers, or the texts in quotes, of a script.
struct Literals {
  std::set<double> numbers;
  std::set<std::string> texts;
  std::vector<std::string> initial;  // start values of entries

  void add(const std::string& script) {
    for (std::size_t i = 0; i < script.size();) {
      const char c = script[i];
      if (c == '\'' || c == '"') {
        const auto end = std::min(script.find(c, i + 1), script.size());
        texts.insert(script.substr(i + 1, end - i - 1));
        i = end + 1;
      } else if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
        double number = 0;
        const auto read = std::from_chars(script.data() + i, script.data() + script.size(), number);
        if (read.ec == std::errc()) numbers.insert(number);
        i = std::max<std::size_t>(i + 1, static_cast<std::size_t>(read.ptr - script.data()));
      } else if (std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_') {
        while (i < script.size() &&
               (std::isalnum(static_cast<unsigned char>(script[i])) != 0 || script[i] == '_')) {
          ++i;
        }
      } else {
        ++i;
      }
    }
  }
};

class Writer {
 public:
  Writer(const Tree& tree, const std::vector<std::uint32_t>& observed)
      : tree_(tree), matters_(entries_of_engine(tree)) {
    for (const std::uint32_t slot : observed) matters_[slot] = true;
    for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
      const NodeCategory category = tree.leaves[i].type->category;
      if (category == NodeCategory::Control || category == NodeCategory::Decorator) continue;
      const std::string id(tree.leaves[i].type->id);
      if (!of_type_.contains(id)) ids_.push_back(id);
      of_type_[id].push_back(i);
    }
  }

  std::string text(const std::string& tree_file) const {
    std::string text = comment(
        fmt::format("What the leaves of {} may do, for `lockstep verify` and `lockstep run`: "
                    "option leaves. "
                    "As it is, the model allows all that a leaf may do which keeps its contract. "
                    "The less a row allows, the more is proved; allow nothing less than the robot "
                    "does: `lockstep log check` compares a recording with the model. "
                    "docs/verify.md has all attributes.",
                    tree_file),
        "");
    text += fmt::format("<leaves lockstep=\"1\" rate=\"{}\">\n", kModelRate);
    text += comment(fmt::format("Ticks per second: {}. Times in seconds are so many ticks, and a "
                                "lower rate needs less time.",
                                kModelRate),
                    "  ");
    text += comment(
        "The tree is meant to end. If it is meant to run until it is stopped, add the element "
        "tree with ends=\"no\" here.",
        "  ");
    for (const std::string& id : ids_) text += '\n' + row(id);
    if (ids_.empty()) text += '\n' + comment("The tree has no leaves of plugins.", "  ");
    return text + "</leaves>\n";
  }

 private:
  std::string paths(const std::vector<std::size_t>& leaves) const {
    return some_of(leaves, kMostPaths,
                   [&](std::size_t leaf) { return tree_.path(tree_.leaves[leaf].node); });
  }

  std::string row(const std::string& id) const {
    const auto& leaves = of_type_.at(id);
    const NodeType& type = *tree_.leaves[leaves.front()].type;
    const auto declared = declared_behavior(type);
    if (!declared.empty()) {
      std::string said;
      for (const Statement& it : declared) said += fmt::format(" {}=\"{}\"", it.word, it.value);
      return comment(fmt::format("{} ({}): plugin '{}' declares{}. A row here overrides that, "
                                 "attribute by attribute.",
                                 id, paths(leaves), type.plugin, said),
                     "  ");
    }
    return type.can_run ? action(id, type, leaves) : condition(id, type, leaves);
  }

  std::string condition(const std::string& id, const NodeType& type,
                        const std::vector<std::size_t>& leaves) const {
    std::string about = fmt::format(
        "{} ({}) returns Success or Failure in each tick, whatever it returned before. If it "
        "observes something that other leaves observe or change, declare a fact, and give it "
        "here.",
        id, paths(leaves));
    std::string words;
    add_outputs(type, leaves, about, words);
    return comment(about, "  ") +
           fmt::format("  <leaf of=\"{}\" result=\"success;failure\"{}/>\n", escaped(id), words);
  }

  std::string action(const std::string& id, const NodeType& type,
                     const std::vector<std::size_t>& leaves) const {
    std::string about = fmt::format(
        "{} ({}) succeeds or fails, after any number of ticks from 1 on, and ends some time if it "
        "is ticked again and again.",
        id, paths(leaves));
    std::string words = " result=\"success;failure\" ticks=\"1..inf\" ends=\"yes\"";
    if (type.has_progress) {
      about +=
          " A tick may take its progress as far as it likes, but not back. It does not move while "
          "it is held. It may succeed before its progress is 1; finish=\"full\": it does not.";
      words += " step=\"0..inf\" held=\"still\" finish=\"any\"";
    }
    add_outputs(type, leaves, about, words);
    return comment(about, "  ") + fmt::format("  <leaf of=\"{}\"{}/>\n", escaped(id), words);
  }

  // The outputs that the tree itself reads.
  void add_outputs(const NodeType& type, const std::vector<std::size_t>& leaves, std::string& about,
                   std::string& words) const {
    bool has_any = false;
    for (std::uint32_t port = 0; port < type.parameters.size(); ++port) {
      const Parameter& parameter = type.parameters[port];
      if (parameter.direction == Direction::Input) continue;
      Literals literals;
      bool is_read = false;
      for (const std::size_t leaf : leaves) {
        const std::uint32_t slot = tree_.ports[tree_.leaves[leaf].first_port + port].slot;
        if (slot == PortBinding::kUnbound || !matters_[slot]) continue;
        is_read = true;
        literals.initial.push_back(to_text(tree_.slots[slot].initial));
        for (const Script& it : tree_.scripts) {
          if (std::ranges::count(it.slots, slot) != 0) literals.add(it.code->text());
        }
      }
      if (!is_read) continue;
      has_any = true;
      const std::string values = values_of(parameter, literals);
      about += fmt::format(" It writes {} to '{}'{}.", listed_values(values), parameter.name,
                           parameter.type == ValueType::Bool
                               ? ""
                               : ", and no other values: a guess from the scripts; write all that "
                                 "it may write");
      words += fmt::format(" out.{}=\"{}\"", parameter.name, escaped(values));
    }
    if (!has_any) return;
    about += " It writes in any of its ticks or not; writes=\"success\": with its success only.";
    words += " writes=\"any\"";
  }

  static std::string listed_values(std::string values) {
    std::ranges::replace(values, '|', ',');
    return values;
  }

  // Around each number that scripts compare with, so that all comparisons come out in both ways.
  static std::string values_of(const Parameter& parameter, const Literals& literals) {
    std::vector<std::string> values;
    const auto add = [&](std::string text) {
      const bool is_one = parameter.is_generic || parse_value(parameter.type, text).has_value();
      if (is_one && text.find('|') == std::string::npos && std::ranges::count(values, text) == 0)
        values.push_back(std::move(text));
    };
    for (const std::string_view it : parameter.choices) add(std::string(it));
    if (parameter.type == ValueType::Bool) {
      add("false");
      add("true");
    }
    for (const std::string& it : literals.initial) {
      if (!it.empty()) add(it);
    }
    if (parameter.type == ValueType::String) {
      for (const std::string& it : literals.texts) add(it);
      if (parameter.choices.empty()) add("other");
    }
    if (parameter.type != ValueType::String && parameter.type != ValueType::Bool) {
      for (const double number : literals.numbers) {
        for (const double around : {number - 1, number, number + 1}) add(fmt::format("{}", around));
      }
    }
    for (const char* it : {"0", "1", "0;1", "other"}) {
      if (values.size() < 2) add(it);
    }
    return joined(values, "|");
  }

  const Tree& tree_;
  std::vector<bool> matters_;  // by slot
  std::vector<std::string> ids_;
  std::map<std::string, std::vector<std::size_t>> of_type_;
};

}  // namespace

std::string leaf_model_text(const Tree& tree, const std::string& tree_file,
                            const std::vector<std::uint32_t>& observed) {
  return Writer(tree, observed).text(tree_file);
}

}  // namespace lockstep::host
