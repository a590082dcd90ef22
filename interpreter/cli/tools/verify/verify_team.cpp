#include "cli/tools/verify/verify_team.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "base/core/shell_word.h"
#include "base/core/wording.h"
#include "base/json/json.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/tools/verify/verify_report.h"
#include "team/team_run.h"
#include "verify/assumptions.h"
#include "verify/team/team_recording.h"

namespace lockstep::host {
namespace {

std::string_view word_of(RobotState::Phase phase) {
  constexpr std::string_view kWords[] = {"not begun", "running", "success",
                                         "failure",   "skipped", "fault"};
  return kWords[static_cast<std::size_t>(phase)];
}

class TeamVerification {
 public:
  explicit TeamVerification(const TeamVerifyOptions& options) : options_(options) {}

  int run() {
    if (const int wrong = team_.load(options_.files); wrong != kExitSuccess) return wrong;
    std::vector<TeamTree> trees;
    for (RobotOfTeam& it : team_.robots())
      trees.push_back({it.label, it.runnable.tree, it.models, it.teams, it.runnable.properties});
    for (const RobotOfTeam& it : team_.robots()) {
      must_end_ &= it.models.tree_ends;
      has_facts_ |= !it.models.facts.empty();
    }
    TeamSearch search(trees, team_.rate(), options_.late, must_end_, options_.limits);
    found_ = search.search();
    for (TeamFinding& it : found_.findings) it.accepted = why_accepted(it);
    options_.search_ended();
    const bool has_files = write_files(search, trees);
    const int failed = write_results(options_.json ? as_json() : as_text(search));
    if (!internal_error_.empty()) {
      print_error(internal_error_,
                  "this is a bug in lockstep: please report it with the trees and the leaf model");
      return kExitInternal;
    }
    if (!has_files) return kExitUsage;
    return first_failure(failed, exit_code());
  }

 private:
  bool write_files(TeamSearch& search, const std::vector<TeamTree>& trees) {
    for (const TeamFinding& finding : found_.findings) {
      std::error_code error;
      std::filesystem::create_directories(options_.out, error);
      std::vector<RecordedRobot> recorded;
      std::vector<std::string>& files = files_.emplace_back();
      if (!finding.accepted.empty()) continue;
      for (std::size_t i = 0; i < team_.robots().size(); ++i) {
        RobotOfTeam& robot = team_.robots()[i];
        std::string path;  // "": it has not begun
        if (search.begin_of(finding.run, i)) {
          path = file_stem(stem() + '.' + finding.name + '.' + robot.label) + ".jsonl";
          if (options_.out != ".") path = (std::filesystem::path(options_.out) / path).string();
          files.push_back(path);
        }
        recorded.push_back({robot.file, path, robot.runnable, robot.played});
      }
      const auto wrong = record_team(search, finding, trees, recorded, team_.rate());
      if (!wrong) {
        print_error(wrong.error().message, wrong.error().hint);
        files.clear();
        return false;
      }
      if (!wrong->empty() && internal_error_.empty()) {
        internal_error_ =
            fmt::format("internal error: the run that shows the finding {} contradicts it: {}",
                        finding.name, *wrong);
      }
    }
    return true;
  }

  // Where robots share a pool only, their recordings do not have when they heard each other.
  std::string offsets(const TeamSearch& search, const TeamFinding& finding) const {
    std::string text;
    std::optional<double> first;
    for (std::size_t i = 0; i < team_.robots().size(); ++i) {
      const auto begin = search.begin_of(finding.run, i);
      if (!begin) continue;
      if (!found_.spreads.empty()) return "";
      if (first) text += fmt::format(" --offset {}={:.6g}", search.name(i), *begin - *first);
      first = first ? first : begin;
    }
    return text;
  }

  std::string stem() const {
    return std::filesystem::path(team_.robots().front().file).stem().string();
  }

  std::string why_accepted(const TeamFinding& finding) const {
    for (const RobotOfTeam& robot : team_.robots()) {
      for (const AcceptedFinding& it : robot.models.accepted) {
        if (matches(it.finding, finding.name)) return it.because;
      }
    }
    return "";
  }

  std::size_t count_findings() const {
    return static_cast<std::size_t>(std::ranges::count_if(
        found_.findings, [](const TeamFinding& it) { return it.accepted.empty(); }));
  }

  int exit_code() const {
    if (count_findings() > 0) return kExitFailure;
    if (found_.end == SearchEnd::Signal) return kExitSignal + found_.signal;
    return found_.is_complete() ? kExitSuccess : kExitLimit;
  }

  std::string conclusion() const {
    if (!internal_error_.empty()) return internal_error_;
    if (const auto count = count_findings(); count > 0)
      return fmt::format("not verified: {}", counted(count, "finding"));
    if (!found_.is_complete())
      return fmt::format("bounded: nothing found in {}", counted(found_.states, "state"));
    return "verified for all behaviors that are assumed";
  }

  std::vector<VerdictLine> facts() const {
    const bool is_all = found_.is_complete();
    const std::string so_far = is_all ? "" : " so far";
    const auto not_yet = [&](const char* no) { return std::string(is_all ? no : "not known"); };
    std::vector<VerdictLine> lines;
    for (std::size_t i = 0; i < team_.robots().size(); ++i) {
      std::string text;
      for (const RobotState::Phase it : found_.results[i])
        text += (text.empty() ? "" : ", ") + std::string(word_of(it));
      lines.push_back(
          {team_.robots()[i].label, text.empty() ? not_yet("never ends") : text + so_far});
    }
    for (std::size_t i = 0; i < team_.robots().size(); ++i) {
      const auto& properties = team_.robots()[i].runnable.properties;
      for (std::size_t it = 0; it < properties.size(); ++it) {
        lines.push_back(
            {fmt::format("property '{}' of {}", properties[it].name(), team_.robots()[i].label),
             verdict_of(i, it)});
      }
    }
    lines.push_back({"all may succeed", found_.may_all_succeed ? "yes" : not_yet("NO")});
    lines.push_back({"can always end", !must_end_               ? "not asked: <tree ends=\"no\"/>"
                                       : !found_.can_always_end ? "NO"
                                                                : not_yet("yes")});
    for (const auto& it : found_.spreads)
      lines.push_back({"largest spread of " + it.team, fmt::format("{:.4g}", it.largest) + so_far});
    if (found_.has_pool) lines.push_back({"two owners of a resource", has("two-owners") + so_far});
    if (found_.has_barriers)
      lines.push_back({"barriers passed too early", has("barrier-passed") + so_far});
    return lines;
  }

  bool is_found(std::string_view finding) const {
    return std::ranges::any_of(found_.findings,
                               [&](const TeamFinding& it) { return it.name.starts_with(finding); });
  }
  std::string has(std::string_view finding) const { return is_found(finding) ? "YES" : "never"; }

  // Where each run can end, each fair one does: what is still owed then was looked at.
  std::string verdict_of(std::size_t robot, std::size_t property) const {
    const std::string& name = team_.robots()[robot].runnable.properties[property].name();
    if (is_found(fmt::format("property/{}.{}", name, team_.robots()[robot].label))) return "NO";
    if (!found_.is_complete()) return "not known";
    const bool waits = found_.owes[robot][property];
    return waits && !(must_end_ && found_.can_always_end) ? "not known: a run may be endless"
                                                          : "holds";
  }

  std::vector<std::string> assumed() const {
    std::vector<std::string> all;
    std::map<std::string, std::vector<std::string>> by;  // who needs it
    for (const RobotOfTeam& it : team_.robots()) {
      for (const std::string& line :
           assumptions(it.runnable.tree, without_robots(it), team_.rate(), it.paces)) {
        if (by[line].empty()) all.push_back(line);
        by[line].push_back(it.label);
      }
    }
    for (std::string& it : all) {
      const auto& names = by[it];
      if (names.size() < team_.robots().size()) it += fmt::format(" of {}", joined(names, ", "));
    }
    all.push_back("each robot begins once, at any time, and is not killed");
    if (team_.robots().size() > 2) {
      const bool any = team_.robots().size() <= TeamCode::kMostInAnyOrder;
      all.push_back(fmt::format("in each period the robots tick in {}, which does not change",
                                any ? "any order" : "the order of their files"));
    }
    if (found_.leaves_out_silences)
      all.push_back("of more than six robots that become silent in one tick, all or none do so");
    if (has_facts_) all.push_back("facts belong to one robot");
    all.push_back(options_.late == 0
                      ? "each word is heard in the next tick of the other robots"
                      : fmt::format("each word is heard at most {} late, or a newer one",
                                    counted(options_.late, "tick")));
    return all;
  }

  // What the models say of leaves that stand for robots does not count here.
  static LeafModels without_robots(const RobotOfTeam& robot) {
    LeafModels models = robot.models;
    for (const RobotLeaf& it : robot_leaves(robot.runnable.tree)) {
      const NodeType& type = *robot.runnable.tree.leaves[it.leaf].type;
      LeafModel& model = models.leaves[it.leaf];
      if (model.levels.size() > 1 && models.unstated_steps > 0) --models.unstated_steps;
      model.can_run = false;
      model.parts = 0;
      std::erase_if(models.declared,
                    [&](const std::string& line) { return line.starts_with(type.id); });
    }
    return models;
  }

  std::string as_text(const TeamSearch& search) const {
    std::string text = "verify";
    for (const std::string& it : options_.files.robots) text += ' ' + it;
    text +=
        fmt::format(": {}, {}\n  {}, {}, {}, {:.2f} s\n", counted(team_.robots().size(), "robot"),
                    options_.files.leaves.empty() ? std::string("no leaf model")
                                                  : "leaf model " + options_.files.leaves,
                    counted(found_.states, "state"), counted(found_.transitions, "transition"),
                    found_.is_complete() ? std::string("complete")
                                         : fmt::format("stopped by {}", limit_of(found_.end)),
                    to_seconds(found_.took));
    const auto lines = facts();
    std::size_t width = 0;
    for (const VerdictLine& it : lines) width = std::max(width, it.name.size());
    for (const VerdictLine& it : lines)
      text += fmt::format("  {:<{}}  {}\n", it.name, width, it.text);
    bool says_how = true;  // to look at the first recordings
    for (std::size_t i = 0; i < found_.findings.size(); ++i) {
      const TeamFinding& finding = found_.findings[i];
      text += fmt::format("{} {}: {}\n", finding.accepted.empty() ? "finding" : "accepted",
                          finding.name, finding.message);
      for (const std::string& line : finding.more) text += fmt::format("    {}\n", line);
      if (!finding.accepted.empty()) text += fmt::format("    accepted: {}\n", finding.accepted);
      if (i >= files_.size() || files_[i].empty()) continue;
      text += fmt::format("    -> {}\n", joined(files_[i], ", "));
      if (!std::exchange(says_how, false)) continue;
      text += "       lockstep log merge";
      for (const std::string& it : files_[i]) text += ' ' + shell_word(it);
      text += offsets(search, finding) + " --out team.jsonl\n       lockstep replay team.jsonl\n";
    }
    text += fmt::format("  assumed: {}\n", joined(assumed(), "; "));
    return text + conclusion() + '\n';
  }

  std::string as_json() const {
    Json json = Json::object();
    json["trees"] = Json(options_.files.robots);
    if (!options_.files.leaves.empty()) json["leaves"] = options_.files.leaves;
    json["conclusion"] = conclusion();
    json["complete"] = found_.is_complete();
    if (!found_.is_complete()) json["limit"] = std::string(limit_of(found_.end));
    json["late"] = options_.late;
    json["states"] = found_.states;
    json["transitions"] = found_.transitions;
    json["ticks"] = found_.periods;
    json["seconds"] = to_seconds(found_.took);
    Json results = Json::object();
    for (std::size_t i = 0; i < team_.robots().size(); ++i) {
      Json all = Json::array();
      for (const RobotState::Phase it : found_.results[i]) all.push_back(std::string(word_of(it)));
      results[team_.robots()[i].label] = std::move(all);
    }
    json["results"] = std::move(results);
    Json findings = Json::array();
    for (std::size_t i = 0; i < found_.findings.size(); ++i) {
      Json finding = Json::object();
      finding["name"] = found_.findings[i].name;
      finding["message"] = found_.findings[i].message;
      finding["why"] = Json(found_.findings[i].more);
      if (!found_.findings[i].accepted.empty()) finding["accepted"] = found_.findings[i].accepted;
      if (i < files_.size() && !files_[i].empty()) finding["recordings"] = Json(files_[i]);
      findings.push_back(std::move(finding));
    }
    json["findings"] = std::move(findings);
    Json all = Json::object();
    for (const VerdictLine& it : facts()) all[it.name] = it.text;
    json["facts"] = std::move(all);
    json["assumed"] = Json(assumed());
    return json.printable(2) + '\n';
  }

  const TeamVerifyOptions& options_;
  TeamOfRobots team_;
  bool must_end_ = true, has_facts_ = false;
  TeamSearchResult found_;
  std::vector<std::vector<std::string>> files_;  // of each finding
  std::string internal_error_;
};

}  // namespace

int verify_team(const TeamVerifyOptions& options) {
  return TeamVerification(options).run();
}

}  // namespace lockstep::host
