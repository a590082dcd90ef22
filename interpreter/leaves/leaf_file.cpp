#include "leaves/leaf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/core/suggest.h"
#include "base/core/value.h"
#include "base/core/wording.h"
#include "language/document/document.h"
#include "language/document/file.h"
#include "language/document/reporter.h"
#include "leaves/leaf_script.h"
#include "leaves/leaf_words.h"
#include "leaves/word_check.h"

namespace lockstep::host {
namespace {

using leaf_words::Tag;
using leaf_words::Word;

class Reader {
 public:
  Reader(const Document& document, LeafFile& file, Diagnostics& diagnostics)
      : document_(document), file_(file), report_(file.sources, diagnostics) {}

  bool read() {
    const Element& root = document_.elements()[0];
    if (root.tag != "leaves") {
      report_.at("wrong-root"_code, root.place,
                 fmt::format("'{}' is not a leaf model", brief(root.tag)),
                 "it begins with <leaves lockstep=\"1\">");
      return false;
    }
    check_words(0, "leaves", leaf_words::kRoot);
    if (const Attribute* version = document_.find_attribute(0, "lockstep");
        version != nullptr && version->value != "1") {
      report_.at_value("unknown-version"_code, version->place,
                       fmt::format("unknown version '{}'", brief(version->value)),
                       "this lockstep knows version 1");
    }
    if (const Attribute* rate = document_.find_attribute(0, "rate")) {
      file_.rate = parse_double(rate->value);
      if (!file_.rate || *file_.rate < 0.001 || *file_.rate > 100000) {
        report_.at_value("bad-value"_code, rate->place,
                         "'rate' must be a number from 0.001 to 100000");
      }
    }
    for (std::uint32_t at = 1; at < root.end; at = document_.elements()[at].end) read_element(at);
    return true;
  }

 private:
  void read_element(std::uint32_t at) {
    const Element& element = document_.elements()[at];
    const auto* const tag = std::ranges::find(leaf_words::kTags, element.tag, &Tag::name);
    if (tag == std::end(leaf_words::kTags)) {
      std::vector<std::string_view> names;
      for (const Tag& it : leaf_words::kTags) names.push_back(it.name);
      report_.at("unknown-element"_code, element.place,
                 fmt::format("unknown element '{}'", brief(element.tag)),
                 suggest(element.tag, names, "elements of 'leaves'"));
      return;
    }
    if (element.end > at + 1) {
      report_.at("unexpected-element"_code, document_.elements()[at + 1].place,
                 fmt::format("'{}' cannot contain elements", element.tag));
    }
    if (!check_words(at, tag->name, tag->words)) return;
    if (tag->name == "tree") file_.tree_ends = document_.find_attribute(at, "ends")->value == "yes";
    if (tag->name == "fact") read_fact(at);
    if (tag->name == "leaf") read_leaf(at);
    if (tag->name == "accept") {
      const Attribute& finding = *document_.find_attribute(at, "finding");
      file_.accepted.push_back({std::string(finding.value),
                                std::string(document_.find_attribute(at, "because")->value),
                                finding.place});
    }
  }

  bool check_words(std::uint32_t at, std::string_view tag, std::span<const Word> words) {
    const std::string_view open = tag == "leaf" ? leaf_words::kOutput : std::string_view();
    return host::check_words(document_, at, open, words, report_);
  }

  void read_fact(std::uint32_t at) {
    FactRow fact;
    const Attribute& name = *document_.find_attribute(at, "name");
    fact.name = name.value;
    fact.place = name.place;
    if (std::ranges::find(file_.facts, fact.name, &FactRow::name) != file_.facts.end()) {
      report_.at_value("duplicate-name"_code, name.place,
                       fmt::format("fact '{}' is declared twice", brief(name.value)));
    }
    if (const Attribute* changes = document_.find_attribute(at, "changes")) {
      constexpr std::array<std::string_view, 4> kWords{"never", "freely", "rises", "falls"};
      fact.changes =
          static_cast<Changes>(std::ranges::find(kWords, changes->value) - kWords.begin());
    }
    if (const Attribute* starts = document_.find_attribute(at, "starts")) {
      fact.starts = starts->value == "true";
      if (fact.changes == Changes::Freely) {
        report_.at_value("bad-leaf-model"_code, starts->place,
                         "'starts' has no effect on a fact that changes freely",
                         "add changes=\"never\": then only leaves that set it change it");
      }
    }
    if (const Attribute* chance = document_.find_attribute(at, "chance")) {
      fact.chance = parse_double(chance->value);
      if (!fact.chance || !(*fact.chance > 0 && *fact.chance < 1)) {
        report_.at_value("bad-value"_code, chance->place,
                         "'chance' must be a number between 0 and 1");
      } else if (fact.changes == Changes::Never && fact.starts) {
        report_.at_value("bad-leaf-model"_code, chance->place,
                         "'chance' has no effect on a fact that is known from its start on");
      }
    }
    file_.facts.push_back(std::move(fact));
  }

  void read_leaf(std::uint32_t at) {
    LeafRow row;
    row.place = document_.elements()[at].place;
    for (const Attribute& it : document_.attributes(at)) read_leaf(it, row);
    if (row.of.empty() == row.path.empty()) {
      report_.at("bad-attributes"_code, document_.elements()[at].place,
                 "give exactly one of 'of' and 'path'");
      return;
    }
    file_.leaves.push_back(std::move(row));
  }

  void read_leaf(const Attribute& it, LeafRow& row) {
    const std::string_view name = it.name, value = it.value;
    if (name == "of" || name == "path") {
      (name == "of" ? row.of : row.path) = value;
      row.place = it.place;
    } else if (name == "fact") {
      row.fact = LeafRow::Named{std::string(value), "", it.place};
    } else if (name == "sets") {
      for (const std::string_view part : split(value, ";")) read_set(it, part, row.sets);
    } else if (name == "sets_on_failure") {
      for (const std::string_view part : split(value, ";")) read_set(it, part, row.sets_on_failure);
    } else if (name == "on_resume") {
      read_after_cut(it, row);
    } else if (is_behavior_word(name)) {
      const auto wrong = add_statement(name, value, row);
      if (wrong) report_.at_value("bad-leaf-model"_code, it.place, wrong->message, wrong->hint);
      if (name.starts_with(kOutputWord)) row.outputs.back().place = it.place;
    }
  }

  void read_after_cut(const Attribute& it, LeafRow& row) {
    for (const std::string_view part : split(it.value, ";")) {
      const auto does = part == kContinues ? AfterCut::Continues : after_cut_named(part);
      if (does) {
        row.after_cut.push_back(*does);
        continue;
      }
      report_.at_value("bad-leaf-model"_code, it.place,
                       fmt::format("'{}' is nothing that a leaf does after a cut", brief(part)),
                       "there are restart, continue, failure and success");
    }
    std::ranges::sort(row.after_cut);
    row.after_cut.erase(std::unique(row.after_cut.begin(), row.after_cut.end()),
                        row.after_cut.end());
  }

  void read_set(const Attribute& it, std::string_view part, std::vector<LeafRow::Named>& sets) {
    const auto sign = part.find('=');
    const std::string_view to = sign == std::string_view::npos ? "" : part.substr(sign + 1);
    if (to == "true" || to == "false") {
      sets.push_back({std::string(part.substr(0, sign)), std::string(to), it.place});
    } else {
      report_.at_value("bad-leaf-model"_code, it.place,
                       fmt::format("'{}' does not set a fact", brief(part)),
                       "write charged=true, or charged=true;seen=false");
    }
  }

  const Document& document_;
  LeafFile& file_;
  const Reporter report_;
};

}  // namespace

std::unique_ptr<LeafFile> read_leaf_file(std::string path, std::string text,
                                         Diagnostics& diagnostics) {
  const auto document = Document::parse(std::move(path), std::move(text), diagnostics);
  if (document == nullptr) return nullptr;
  auto file = std::make_unique<LeafFile>();
  file->sources.add(document->source());
  return Reader(*document, *file, diagnostics).read() ? std::move(file) : nullptr;
}

std::unique_ptr<LeafFile> load_leaf_file(const std::string& path, Diagnostics& diagnostics) {
  constexpr std::size_t kMost = std::size_t{16} << 20u;
  auto text = read_file(path, kMost);
  if (text) return read_leaf_file(path, std::move(*text), diagnostics);
  diagnostics.error("unreadable-file"_code, {path}, "cannot be read: " + text.error().message,
                    text.error().hint);
  return nullptr;
}

}  // namespace lockstep::host
