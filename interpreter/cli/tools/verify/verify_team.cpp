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
  constexpr std::string_view kWords[] = {"not begun", "running", "success", "failure", "skipped"};
  return kWords[static_cast<std::size_t>(phase)];
}

class TeamVerification {
 public:
  explicit TeamVerification(const TeamVerifyOptions& options) : options_(options) {}

  int run() {
    if (const int wrong = team_.load(options_.files); wrong != kExitSuccess) return wrong;
    std::vector<TeamTree> trees;
    for (RobotOfTeam& it : team_.robots()) trees.push_back({it.runnable.tree, it.models, it.teams});
    TeamSearch search(trees, team_.rate(), options_.late, options_.limits);
    found_ = search.search();
    for (TeamFinding& it : found_.findings) it.accepted = why_accepted(it);
    options_.search_ended();
    const bool has_files = write_files(search, trees);
    const int failed = write_results(options_.json ? as_json(search) : as_text(search));
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
        files.push_back(stem() + '.' + finding.name + '.' + search.name(i) + ".jsonl");
        if (options_.out != ".")
          files.back() = (std::filesystem::path(options_.out) / files.back()).string();
        recorded.push_back({robot.file, files.back(), robot.runnable, robot.played});
      }
      const auto wrong = record_team(search, finding, trees, recorded, team_.rate());
      if (!wrong) {
        print_error(wrong.error().message, wrong.error().hint);
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

  std::vector<VerdictLine> facts(const TeamSearch& search) const {
    std::vector<VerdictLine> lines;
    for (std::size_t i = 0; i < team_.robots().size(); ++i) {
      std::string text;
      for (const RobotState::Phase it : found_.results[i])
        text += (text.empty() ? "" : ", ") + std::string(word_of(it));
      lines.push_back({search.name(i), text.empty() ? "never ends" : text});
    }
    const auto yes = [&](bool is) { return std::string(is ? "yes" : "NO"); };
    lines.push_back({"all may succeed", yes(found_.may_all_succeed)});
    lines.push_back({"can always end", yes(found_.can_always_end)});
    for (const auto& it : found_.spreads)
      lines.push_back({"largest spread of " + it.team, fmt::format("{:.4g}", it.largest)});
    if (found_.has_pool) lines.push_back({"two owners of a resource", has("two-owners")});
    if (!found_.spreads.empty())
      lines.push_back({"barriers passed too early", has("barrier-passed")});
    return lines;
  }

  std::string has(std::string_view finding) const {
    const bool is_found = std::ranges::any_of(
        found_.findings, [&](const TeamFinding& it) { return it.name.starts_with(finding); });
    return is_found ? "YES" : "never";
  }

  std::vector<std::string> assumed() const {
    std::vector<std::string> all;
    std::map<std::string, std::vector<std::string>> by;  // who needs it
    for (const RobotOfTeam& it : team_.robots()) {
      for (const std::string& line :
           assumptions(it.runnable.tree, without_robots(it), team_.rate(), it.paces)) {
        if (by[line].empty()) all.push_back(line);
        by[line].push_back(it.name());
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
      models.leaves[it.leaf].can_run = false;
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
    const auto lines = facts(search);
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
      text += " --out team.jsonl\n       lockstep replay team.jsonl\n";
    }
    text += fmt::format("  assumed: {}\n", joined(assumed(), "; "));
    return text + conclusion() + '\n';
  }

  std::string as_json(const TeamSearch& search) const {
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
      results[search.name(i)] = std::move(all);
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
    for (const VerdictLine& it : facts(search)) all[it.name] = it.text;
    json["facts"] = std::move(all);
    json["assumed"] = Json(assumed());
    return json.printable(2) + '\n';
  }

  const TeamVerifyOptions& options_;
  TeamOfRobots team_;
  TeamSearchResult found_;
  std::vector<std::vector<std::string>> files_;  // of each finding
  std::string internal_error_;
};

}  // namespace

int verify_team(const TeamVerifyOptions& options) {
  return TeamVerification(options).run();
}

}  // namespace lockstep::host
