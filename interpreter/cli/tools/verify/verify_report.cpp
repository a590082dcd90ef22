#include "cli/tools/verify/verify_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/core/shell_word.h"
#include "base/core/wording.h"
#include "base/json/json.h"

namespace lockstep::host {
namespace {

std::size_t count_findings(const Verdict& verdict) {
  return static_cast<std::size_t>(std::ranges::count_if(
      verdict.findings, [](const Finding& it) { return it.accepted.empty(); }));
}

std::string size_text(const SearchResult& found) {
  return fmt::format("{}, {}, {}, {:.2f} s", counted(found.store.size(), "state"),
                     counted(found.transitions, "transition"),
                     found.is_complete() ? std::string("complete")
                                         : fmt::format("stopped by {}", limit_of(found.end)),
                     to_seconds(found.took));
}

// Rounded up, to two digits.
std::string loss_text(const SearchResult& found) {
  return fmt::format("{:.1e}", found.store.probability_of_loss() * 1.05);
}

// Of the run that shows it: with --no-symmetry, another run may show the same.
std::string repeats_text(const Finding& finding) {
  if (!finding.repeats) return "";
  return fmt::format("; repeats {} from tick {} on", counted(finding.round(), "tick"),
                     *finding.repeats);
}

}  // namespace

std::string file_stem(std::string name) {
  for (char& it : name) {
    const bool is_plain =
        std::isalnum(static_cast<unsigned char>(it)) != 0 || it == '-' || it == '_' || it == '.';
    if (!is_plain) it = '.';
  }
  // A name may have 255 bytes. The end of a path says more than its middle.
  constexpr std::size_t kMost = 200, kBegin = 60;
  if (name.size() <= kMost) return name;
  return name.substr(0, kBegin) + "..." + name.substr(name.size() - (kMost - kBegin));
}

std::string_view limit_of(SearchEnd end) {
  constexpr std::string_view kWords[] = {"",       "--states", "transitions", "--memory",
                                         "--time", "--depth",  "a signal",    "--values"};
  return kWords[static_cast<std::size_t>(end)];
}

std::string conclusion(const VerifyReport& report) {
  if (!report.internal_error.empty()) return report.internal_error;
  const std::size_t count = count_findings(report.verdict), others = report.verdict.left_out;
  const std::string left_out =
      others == 0 ? "" : fmt::format("; --only leaves out {}", counted(others, "other finding"));
  if (count > 0) return fmt::format("not verified: {}{}", counted(count, "finding"), left_out);
  const SearchResult& found = report.found;
  if (found.is_proof() && others > 0)
    return fmt::format("no finding {}{}", joined(report.only, ", "), left_out);
  if (found.is_proof()) {
    return "verified for all behaviors that are assumed" +
           (report.cuts == 0 ? "" : fmt::format(", with at most {}", counted(report.cuts, "cut")));
  }
  if (found.is_complete()) {
    return fmt::format(
        "not proven: nothing found in {}; one was missed with a probability below {}{}",
        counted(found.store.size(), "state"), loss_text(found), left_out);
  }
  return fmt::format("bounded: nothing found in the first {} (all behaviors), {}{}",
                     counted(found.complete_depth(), "tick"), counted(found.store.size(), "state"),
                     left_out);
}

// Who chooses a depth wants no more.
bool wants_costs(SearchEnd end) {
  return end != SearchEnd::Complete && end != SearchEnd::Depth;
}

std::string to_text(const std::vector<SearchCost>& costs, const std::string& tree,
                    const std::string& leaves) {
  std::string text;
  for (const SearchCost& it : costs)
    text += fmt::format("  what costs: {}\n    remedy: {}\n", it.what, it.remedy);
  if (costs.empty() || !leaves.empty()) return text;
  return text +
         fmt::format("  `lockstep verify {} --save-model FILE` writes a leaf model to fill in\n",
                     shell_word(tree));
}

std::string to_text(const VerifyReport& report) {
  std::string text = fmt::format(
      "verify {}: {}, {}\n  {}\n", report.tree,
      report.leaf_count == 1 ? "1 leaf" : fmt::format("{} leaves", report.leaf_count),
      report.leaves.empty() ? std::string("no leaf model") : "leaf model " + report.leaves,
      size_text(report.found));
  std::size_t width = 0;
  for (const VerdictLine& it : report.verdict.facts) width = std::max(width, it.name.size());
  width = std::min<std::size_t>(width, 36);
  for (const VerdictLine& it : report.verdict.facts) {
    text += fmt::format("  {:<{}}  {}\n", it.name, width, it.text);
  }
  if (report.found.end == SearchEnd::Values) {
    text +=
        fmt::format("  the entry '{}' has more values than --values allows\n", report.found.note);
  }
  text += to_text(report.costs, report.tree, report.leaves);
  bool says_how = true;  // to look at the first recording
  for (const Finding& it : report.verdict.findings) {
    text += fmt::format("{} {}: {}\n", it.accepted.empty() ? "finding" : "accepted", it.name,
                        it.message);
    for (const std::string& line : it.more) text += fmt::format("    {}\n", line);
    if (!it.accepted.empty()) text += fmt::format("    accepted: {}\n", it.accepted);
    if (const auto files = report.files.find(it.name); files != report.files.end()) {
      text += fmt::format("    -> {}, {}{}\n", files->second.recording, files->second.leaves,
                          repeats_text(it));
      if (std::exchange(says_how, false)) {
        text += fmt::format("       lockstep replay {}\n", shell_word(files->second.recording));
      }
    }
  }
  text += fmt::format("  assumed: {}\n", joined(report.verdict.assumed, "; "));
  return text + conclusion(report) + '\n';
}

Json to_json(const std::vector<SearchCost>& costs) {
  Json all = Json::array();
  for (const SearchCost& it : costs) all.push_back(Json{{"what", it.what}, {"remedy", it.remedy}});
  return all;
}

std::string to_json(const VerifyReport& report) {
  Json json = Json::object();
  json["tree"] = report.tree;
  if (!report.leaves.empty()) json["leaves"] = report.leaves;
  json["conclusion"] = conclusion(report);
  if (report.verdict.left_out > 0) json["left_out"] = report.verdict.left_out;
  json["complete"] = report.found.is_complete();
  if (!report.found.is_complete()) json["limit"] = std::string(limit_of(report.found.end));
  if (report.found.store.keeps_hashes()) {
    json["missed_with_probability_below"] = report.found.store.probability_of_loss();
  }
  if (report.cuts > 0) json["cuts"] = report.cuts;
  if (!report.costs.empty()) json["costs"] = to_json(report.costs);
  json["states"] = report.found.store.size();
  json["transitions"] = report.found.transitions;
  json["bytes"] = report.found.memory();
  json["ticks"] = report.found.complete_depth();
  json["seconds"] = to_seconds(report.found.took);
  Json results = Json::object();
  for (const Status status : {Status::Success, Status::Failure, Status::Skipped}) {
    const auto& first = report.found.results[index_of(status)];
    if (first) results[std::string(to_string(status))] = first->ticks;
  }
  json["results"] = std::move(results);
  Json findings = Json::array();
  for (const Finding& it : report.verdict.findings) {
    Json finding = Json::object();
    finding["name"] = it.name;
    finding["message"] = it.message;
    finding["why"] = Json(it.more);
    if (!it.accepted.empty()) finding["accepted"] = it.accepted;
    if (it.repeats) finding["repeats_from"] = *it.repeats;
    if (!it.cuts.empty()) finding["cut_before"] = Json(it.cuts);
    if (const auto files = report.files.find(it.name); files != report.files.end()) {
      finding["recording"] = files->second.recording;
      finding["leaves"] = files->second.leaves;
    }
    findings.push_back(std::move(finding));
  }
  json["findings"] = std::move(findings);
  Json facts = Json::object();
  for (const VerdictLine& it : report.verdict.facts) facts[it.name] = it.text;
  json["facts"] = std::move(facts);
  json["assumed"] = Json(report.verdict.assumed);
  return json.printable(2) + '\n';
}

}  // namespace lockstep::host
