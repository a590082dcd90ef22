#include "scenario/scenario_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <span>

#include "base/core/pre_order.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "language/document/document.h"
#include "language/document/file.h"
#include "language/document/reporter.h"
#include "leaves/word_check.h"
#include "record/header_and_end.h"
#include "scenario/binding_reader.h"
#include "scenario/expectation_reader.h"
#include "scenario/row_values.h"
#include "scenario/scenario_words.h"
#include "scenario/substitutions.h"

namespace lockstep::host {
namespace {

using scenario_words::Tag;

class Reader {
 public:
  Reader(Document& document, ScenarioFile& file, Diagnostics& diagnostics)
      : document_(document),
        elements_(document.elements()),
        file_(file),
        report_(file.sources, diagnostics),
        reader_(document, file.path, report_),
        expectations_(document, file.path, reader_, report_) {}

  bool read() {
    const Element& root = elements_[0];
    if (root.tag == "root") return read_tree();
    if (root.tag != "scenarios") {
      report_.at("wrong-root"_code, root.place,
                 fmt::format("'{}' is not a file of scenarios", brief(root.tag)),
                 "it begins with <scenarios lockstep=\"1\">");
      return false;
    }
    check_words(document_, 0, "", scenario_words::kScenarios, report_);
    if (const Attribute* version = attribute(0, "lockstep");
        version != nullptr && version->value != "1") {
      report_.at_value("unknown-version"_code, version->place,
                       fmt::format("unknown version '{}'", brief(version->value)),
                       "this lockstep knows version 1");
    }
    read_head(0, common_);
    for (const std::uint32_t child : children_in(elements_, 0)) {
      if (elements_[child].tag == "scenario") continue;
      read_part(child, common_, "elements of 'scenarios'");
    }
    for (Expectation& it : common_.expectations) it.is_for_all = true;
    read_all();
    return true;
  }

 private:
  const Attribute* attribute(std::uint32_t element, std::string_view name) const {
    return document_.find_attribute(element, name);
  }

  // Its scenarios are about itself.
  bool read_tree() {
    common_.tree = file_.path;
    if (!document_.rules().lenient_xml) {  // texts in elements are kept
      read_all();
      return true;
    }
    for (const std::uint32_t child : children_in(elements_, 0)) {
      if (elements_[child].tag != "scenario") continue;
      report_.at("bad-scenario"_code, elements_[child].place,
                 fmt::format("a file for {} has no scenarios", document_.rules().title),
                 "put them into a file next to it, NAME.test.xml");
    }
    return true;
  }

  void read_all() {
    for (const std::uint32_t child : children_in(elements_, 0)) {
      if (elements_[child].tag == "scenario") read_scenario(child);
    }
  }

  // Once for each row.
  void read_scenario(std::uint32_t at) {
    RowValues rows(document_, at, report_);
    if (!rows.are_good()) return;
    const Attribute* const name = attribute(at, "name");
    const bool is_in_name = name != nullptr && name->value.find("${") != std::string_view::npos;
    for (std::size_t row = 0; row < rows.count(); ++row) {
      rows.choose(row);
      read_scenario(at, is_in_name ? std::string() : rows.text(row));
    }
  }

  void read_scenario(std::uint32_t at, const std::string& row) {
    if (!check_words(document_, at, "", scenario_words::kScenario, report_)) return;
    Scenario scenario = common_;
    const Attribute& name = *attribute(at, "name");
    scenario.place = name.place;
    scenario.name = name.value;
    scenario.changes_of_file = common_.changes.size();
    scenario.late_of_file = common_.late.size();
    scenario.answers_of_file = common_.answers.size();
    if (!row.empty()) scenario.name += fmt::format(" [{}]", row);
    check_name(scenario, name);
    read_head(at, scenario);
    bool says_expect = false;
    std::optional<Place> one_run;  // the first row that is about one
    for (const std::uint32_t child : children_in(elements_, at)) {
      says_expect |= elements_[child].tag == "expect";
      if (elements_[child].tag == scenario_words::kRow) continue;
      const std::size_t before = rows_of_one_run(scenario);
      read_part(child, scenario, "elements of 'scenario'");
      if (!one_run && rows_of_one_run(scenario) > before) one_run = elements_[child].place;
    }
    if (scenario.tree.empty()) {
      report_.at("bad-scenario"_code, elements_[at].place, "the scenario has no tree",
                 "write tree=\"FILE.xml\", here or in <scenarios>");
    }
    if (scenario.is_verified && one_run) {
      report_.at("bad-scenario"_code, *one_run,
                 "a scenario with verify=\"yes\" is about all behaviors, not about one run",
                 "declare what leaves may do in a leaf model: leaves=\"NAME.leaves.xml\"; only "
                 "values before the first tick can be set");
    }
    if (scenario.expectations.empty() && !scenario.is_verified && !says_expect) {
      report_.at("bad-scenario"_code, elements_[at].place, "the scenario expects nothing",
                 "write <expect result=\"success\"/>");
    }
    file_.scenarios.push_back(std::move(scenario));
  }

  // All behaviors may start with a value.
  static std::size_t rows_of_one_run(const Scenario& it) {
    const auto later = std::ranges::count_if(it.changes, std::not_fn(&SetEntry::is_start));
    return it.bindings.size() + it.answers.size() + it.late.size() +
           static_cast<std::size_t>(later);
  }

  void check_name(const Scenario& scenario, const Attribute& name) {
    const auto same = std::ranges::find(file_.scenarios, scenario.name, &Scenario::name);
    if (same == file_.scenarios.end()) return;
    report_.at_value("duplicate-name"_code, name.place,
                     fmt::format("a scenario '{}' exists already", brief(scenario.name)),
                     fmt::format("the first is at {}", to_text(file_.sources.locate(same->place))));
  }

  // A file and a scenario may both have these attributes.
  void read_head(std::uint32_t at, Scenario& into) {
    for (const Attribute& it : document_.attributes(at)) {
      if (it.name == "tree") {
        into.tree = beside(file_.path, it.value);
        into.tree_place = it.place;
      } else if (it.name == "main") {
        into.main = it.value;
      } else if (it.name == "leaves") {
        into.leaves = beside(file_.path, it.value);
        into.leaves_place = it.place;
      } else if (it.name == "rate") {
        into.rate = reader_.number(it, 0.001, 100000);
        into.is_rate_given = true;
      } else if (it.name == "tick") {
        into.exactly_once = it.value == kExactlyOnce;
      } else if (it.name == "max-ticks") {
        into.max_ticks = reader_.count(it, 1);
      } else if (it.name == "seed") {
        into.seed = reader_.count(it, 0);
      } else if (it.name == "runs") {
        into.runs = reader_.count(it, 1);
      } else if (it.name == "verify") {
        into.is_verified = it.value == "yes";
      }
    }
  }

  void read_part(std::uint32_t at, Scenario& into, std::string_view known) {
    const Element& element = elements_[at];
    const auto* const tag = std::ranges::find(scenario_words::kTags, element.tag, &Tag::name);
    if (tag == std::end(scenario_words::kTags)) {
      std::vector<std::string_view> names{"scenario"};
      for (const Tag& it : scenario_words::kTags) names.push_back(it.name);
      report_.at("unknown-element"_code, element.place,
                 fmt::format("unknown element '{}'", brief(element.tag)),
                 suggest(element.tag, names, known));
      return;
    }
    if (element.end > at + 1) {
      report_.at("unexpected-element"_code, elements_[at + 1].place,
                 fmt::format("'{}' cannot contain elements", element.tag));
    }
    const std::string_view open = tag->name == "leaf"     ? leaf_words::kOutput
                                  : tag->name == "expect" ? scenario_words::kInput
                                                          : std::string_view();
    if (!check_words(document_, at, open, tag->words, report_)) return;
    if (tag->name == "arg") read_argument(at, into);
    if (tag->name == "set") read_change(at, into);
    if (tag->name == "answer") read_answer(at, into);
    if (tag->name == "leaf") reader_.read_leaf(at, into);
    if (tag->name == "late") read_late(at, into);
    if (tag->name == "substitutions") read_substitutions(*attribute(at, "from"), into);
    if (tag->name == "expect") expectations_.read(at, into);
  }

  void read_argument(std::uint32_t at, Scenario& into) const {
    const Attribute &name = *attribute(at, "name"), &value = *attribute(at, "value");
    std::erase_if(into.arguments, [&](const NamedText& it) { return it.name == name.value; });
    into.arguments.push_back({std::string(name.value), std::string(value.value), name.place});
  }

  void read_change(std::uint32_t at, Scenario& into) const {
    const Attribute &key = *attribute(at, "key"), &value = *attribute(at, "value");
    SetEntry change{std::string(key.value), std::string(value.value), key.place, value.place};
    std::optional<std::uint64_t> tick;
    read_moment(at, tick, change.time);
    change.tick = tick.value_or(0);
    into.changes.push_back(std::move(change));
  }

  void read_moment(std::uint32_t at, std::optional<std::uint64_t>& into_tick,
                   std::optional<double>& into_time) const {
    const Attribute *tick = attribute(at, "tick"), *time = attribute(at, "time");
    if (tick != nullptr && time != nullptr) {
      report_.at("bad-attributes"_code, time->place, "give one of 'tick' and 'time'");
    }
    if (tick != nullptr) into_tick = reader_.count(*tick, 0);
    if (time != nullptr) into_time = reader_.number(*time, 0, 1e9);
  }

  void read_answer(std::uint32_t at, Scenario& into) const {
    const Attribute &path = *attribute(at, "path"), &value = *attribute(at, "value");
    AnswerEvent answer{std::string(path.value), std::string(value.value), path.place, value.place};
    read_moment(at, answer.tick, answer.time);
    into.answers.push_back(std::move(answer));
  }

  void read_late(std::uint32_t at, Scenario& into) const {
    into.late.push_back({reader_.count(*attribute(at, "tick"), 0),
                         reader_.number(*attribute(at, "by"), 0, 1e6), elements_[at].place});
  }

  void read_substitutions(const Attribute& from, Scenario& into) const {
    auto found = host::read_substitutions(beside(file_.path, from.value));
    if (!found) {
      return report_.at_value("bad-scenario"_code, from.place, found.error().message,
                              found.error().hint);
    }
    for (const std::string& note : found->notes) {
      report_.at_value("bad-scenario"_code, from.place, note, "write it into the scenario",
                       Severity::Warning);
    }
    for (BindingRow& row : found->rows) {
      row.place = row.source = from.place;
      into.bindings.push_back(std::move(row));
    }
  }

  Document& document_;
  const std::span<const Element> elements_;
  ScenarioFile& file_;
  const Reporter report_;
  const BindingReader reader_;
  const ExpectationReader expectations_;
  Scenario common_;
};

}  // namespace

std::unique_ptr<ScenarioFile> read_scenarios(const std::string& path, std::string text,
                                             Diagnostics& diagnostics) {
  const auto document = Document::parse(path, std::move(text), diagnostics);
  if (document == nullptr) return nullptr;
  auto file = std::make_unique<ScenarioFile>();
  file->path = path;
  file->sources.add(document->source());
  return Reader(*document, *file, diagnostics).read() ? std::move(file) : nullptr;
}

std::unique_ptr<ScenarioFile> read_scenarios(const std::string& path, Diagnostics& diagnostics) {
  auto text = read_file(path, Document::kMaxBytes, FileKinds::Regular);
  if (text) return read_scenarios(path, std::move(*text), diagnostics);
  diagnostics.error("unreadable-file"_code, {path}, "cannot be read: " + text.error().message,
                    text.error().hint);
  return nullptr;
}

}  // namespace lockstep::host
