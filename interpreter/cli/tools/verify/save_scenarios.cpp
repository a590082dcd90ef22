#include "cli/tools/verify/save_scenarios.h"

#include <fmt/format.h>

#include "cli/console.h"
#include "language/property/property_token.h"
#include "scenario/recorded_words.h"
#include "scenario/scenario_writer.h"
#include "verify/property_watch.h"

namespace lockstep::host {
namespace {

constexpr const char *kAnEnd = "success;failure;skipped",
                     *kAllButFault = "success;failure;skipped;running";

class ScenarioMaker {
 public:
  // `tree`: ScenarioText::tree.
  ScenarioMaker(const VerifiedTree& of, const Finding& finding, RecordedWords words,
                const std::string& tree)
      : of_(of), finding_(finding), words_(std::move(words)) {
    text_.tree = tree;
  }

  std::string make() {
    const std::string_view what =
        std::string_view(finding_.name).substr(0, finding_.name.find('/'));
    if (what == "property") expect_property();
    if (what == "fault") expect_result_within(words_.ticks.value_or(0), kAllButFault);
    if (what == "starvation") expect_ticks();
    if (what == "cycle") expect_end();
    if (what == "trap" && !expect_end_of_others()) expect_end();
    return to_text(words_, text_);
  }

 private:
  void expect_property() {
    for (const Property& property : of_.properties) {
      const bool is_meant = finding_.name == "property/" + property.name();
      if (is_meant && !names_fact(property, of_.tree)) text_.expected.push_back(property.text());
    }
  }

  void expect_result_within(std::uint64_t ticks, const char* result) {
    words_.ticks = ticks;
    words_.result = "";
    text_.result = result;
  }

  // As often as a Retry that mends it may take.
  void repeat() {
    constexpr int kRounds = 10;
    TracedRun run = finding_.run;
    const TracedRun round(run.end() - static_cast<std::ptrdiff_t>(finding_.round()), run.end());
    for (int i = 2; i < kRounds; ++i) run.insert(run.end(), round.begin(), round.end());
    words_.leaves = of_.tracer.scripts(run).leaves;
    expect_result_within(run.size(), "");
  }

  void expect_end() {
    repeat();
    text_.result = kAnEnd;
  }

  // The child gets no tick in the cycle.
  void expect_ticks() {
    repeat();
    const std::string path = of_.tree.path(*finding_.node);
    text_.expected.push_back(fmt::format("not {0}{1}{0}.ticked at most {2} ticks",
                                         needs_quotes(path) ? "'" : "", path,
                                         *words_.ticks - *finding_.repeats - 1));
  }

  // Where no leaf helps, each ends as soon as it can: the mended tree comes to its end. If this one
  // does, too, the leaf model forbids that, or something in the tree wants other results.
  bool expect_end_of_others() {
    const auto begin = finding_.run.begin();
    const auto decided = begin + static_cast<std::ptrdiff_t>(finding_.decided);
    LeafScripts scripts = of_.tracer.scripts(TracedRun(begin, decided));
    for (std::size_t i = 0; i < of_.tree.leaves.size(); ++i) {
      const ResultSet& may = of_.models.leaves[i].results;
      const LeafWord end{.status = may.success   ? Status::Success
                                   : may.failure ? Status::Failure
                                                 : Status::Skipped};
      auto& words = scripts.leaves[of_.tree.path(of_.tree.leaves[i].node)];
      if (words.empty() || words.back() != end) words.push_back(end);
    }
    if (ends(of_.tree, scripts, of_.played, of_.rate)) return false;
    std::erase_if(scripts.leaves, [](const auto& it) {
      return it.second == std::vector{LeafWord{.status = Status::Success}};  // as without a row
    });
    words_.leaves = std::move(scripts.leaves);
    text_.result = kAnEnd;
    text_.has_limit = false;
    return true;
  }

  const VerifiedTree& of_;
  const Finding& finding_;
  RecordedWords words_;
  ScenarioText text_{.name = "verify: " + finding_.name,
                     .comments = {"found by verify: " + finding_.message},
                     .main = of_.main};
};

}  // namespace

std::optional<std::string> tree_to_save(const std::string& path, const ScenarioTree& of) {
  const auto tree = tree_in_scenario_file(path, of);
  if (tree) return *tree;
  print_error("--save: " + tree.error().message, tree.error().hint);
  return std::nullopt;
}

bool save_scenarios(const std::string& path, const VerifyReport& report, const VerifiedTree& of) {
  const ScenarioTree about{report.tree, of.main, of.tree.id};
  const auto tree = tree_to_save(path, about);
  if (!tree) return false;
  std::string scenarios;
  for (const Finding& finding : report.verdict.findings) {
    const auto files = report.files.find(finding.name);
    if (files == report.files.end()) continue;
    if (!files->second.scripts.cuts.empty()) {
      print_note(fmt::format("--save leaves out {}: a scenario cannot hold a cut", finding.name));
      continue;
    }
    RecordedWords words = read_recorded_words(files->second.recording, of.tree);
    if (!words.outcome.error.empty()) {
      print_error("--save: " + words.outcome.error);
      return false;
    }
    // A recording does not tell the result of a leaf from that of a script around it.
    words.leaves = files->second.scripts.leaves;
    scenarios += ScenarioMaker(of, finding, std::move(words), *tree).make();
  }
  if (scenarios.empty()) return true;
  const auto saved = add_to_scenario_file(path, about, scenarios);
  if (!saved) print_error("--save: " + saved.error().message, saved.error().hint);
  return saved.has_value();
}

}  // namespace lockstep::host
