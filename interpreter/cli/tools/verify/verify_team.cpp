#include "cli/tools/verify/verify_team.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <filesystem>

#include "base/core/shell_word.h"
#include "base/core/wording.h"
#include "base/json/json.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/tools/team/robot_files.h"
#include "cli/tools/verify/verify_input.h"
#include "cli/tools/verify/verify_report.h"
#include "team/team_run.h"
#include "verify/assumptions.h"
#include "verify/team/team_recording.h"
#include "verify/verifiable.h"

namespace lockstep::host {
namespace {

// From its file to what a search needs.
struct VerifiedRobot {
  std::string file = {};
  PlayedLeaves played = {};
  bool paces = false;
  Runnable runnable = {};
  LeafModels models = {};
  TeamsOfRobot teams = {};
  std::size_t leaves = 0;  // that do not stand for other robots
  std::string recording = {};
};

std::string_view word_of(RobotState::Phase phase) {
  constexpr std::string_view kWords[] = {"not begun", "running", "success", "failure", "skipped"};
  return kWords[static_cast<std::size_t>(phase)];
}

class TeamVerification {
 public:
  explicit TeamVerification(const TeamVerifyOptions& options) : options_(options) {}

  int run() {
    if (const int wrong = load(); wrong != kExitSuccess) return wrong;
    std::vector<TeamTree> trees;
    for (VerifiedRobot& it : robots_) trees.push_back({it.runnable.tree, it.models, it.teams});
    TeamSearch search(trees, rate_, options_.late, options_.limits);
    found_ = search.search();
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
  int load() {
    Diagnostics diagnostics;
    std::string text;
    const auto file = read_leaves(options_.leaves, text, diagnostics);
    if (!file) {
      print_diagnostics(diagnostics, Severity::Warning);
      return kExitInvalidTree;
    }
    std::vector<TeamsOfRobot> teams;
    std::vector<std::string> files;
    std::vector<Diagnostics> said(options_.robots.size());
    for (std::size_t i = 0; i < options_.robots.size(); ++i) {
      auto loaded = load_robot(options_.robots[i], options_.load, std::make_shared<PluginSet>());
      if (!loaded) return loaded.error();
      VerifiedRobot& robot = robots_.emplace_back();
      robot.file = loaded->file;
      const Places places(loaded->loaded);
      Definition& definition = loaded->loaded.definition;
      robot.played.take_over(definition, stands_for_robots);
      robot.paces = paces(definition);
      ignore_pace(definition);
      robot.runnable = make_runnable(std::move(loaded->loaded));
      std::vector<NodeProblem> problems = not_verifiable(robot.runnable.tree);
      add_problems(robot.runnable.tree, problems);
      robot.models = make_models(robot.runnable.tree, file->get(), said[i], problems);
      places.report(problems, said[i]);
      if (i == 0) rate_ = options_.rate.value_or(robot.models.rate.value_or(kModelRate));
      robot.teams = teams_of(robot.runnable.tree, from_seconds(1 / rate_));
      robot.leaves = robot.runnable.tree.leaves.size() - robot_leaves(robot.runnable.tree).size();
      teams.push_back(robot.teams);
      files.push_back(robot.file);
    }
    if (report(said)) return kExitInvalidTree;
    return check_teams(teams, files);
  }

  // A robot asks for what its file says, in a search.
  static void add_problems(const Tree& tree, std::vector<NodeProblem>& problems) {
    for (const RobotLeaf& it : robot_leaves(tree)) {
      if (it.asks && !it.wanted)
        problems.push_back({tree.labels[tree.leaves[it.leaf].node].parent,
                            "an entry says which shared resources it uses, so robots cannot be "
                            "verified together",
                            "name them here"});
    }
  }

  // Whether there are errors. A row of the leaf model need not fit all robots.
  static bool report(const std::vector<Diagnostics>& said) {
    const auto is_said_by = [](const Diagnostics& all, const Diagnostic& wanted) {
      return std::ranges::any_of(all.all(), [&](const Diagnostic& it) {
        return it.code.text() == wanted.code.text() && it.location.file == wanted.location.file &&
               it.location.line == wanted.location.line &&
               it.location.column == wanted.location.column;
      });
    };
    bool has_errors = false;
    for (std::size_t i = 0; i < said.size(); ++i) {
      Diagnostics kept;
      for (const Diagnostic& it : said[i].all()) {
        const bool is_of_row = it.code.text() == "unknown-leaf";
        const bool fits_one = is_of_row && !std::ranges::all_of(said, [&](const Diagnostics& all) {
                                return is_said_by(all, it);
                              });
        const bool is_told = is_of_row && i > 0;
        if (!fits_one && !is_told) kept.add(it);
      }
      has_errors |= kept.has_errors();
      print_diagnostics(kept, Severity::Warning);
    }
    return has_errors;
  }

  bool write_files(TeamSearch& search, const std::vector<TeamTree>& trees) {
    for (const TeamFinding& finding : found_.findings) {
      std::error_code error;
      std::filesystem::create_directories(options_.out, error);
      std::vector<RecordedRobot> recorded;
      std::vector<std::string>& files = files_.emplace_back();
      for (std::size_t i = 0; i < robots_.size(); ++i) {
        VerifiedRobot& robot = robots_[i];
        files.push_back(stem() + '.' + finding.name + '.' + search.name(i) + ".jsonl");
        if (options_.out != ".")
          files.back() = (std::filesystem::path(options_.out) / files.back()).string();
        recorded.push_back({robot.file, files.back(), robot.runnable, robot.played});
      }
      const auto wrong = record_team(search, finding, trees, recorded, rate_);
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

  std::string stem() const { return std::filesystem::path(robots_.front().file).stem().string(); }

  int exit_code() const {
    if (!found_.findings.empty()) return kExitFailure;
    if (found_.end == SearchEnd::Signal) return kExitSignal + found_.signal;
    return found_.is_complete() ? kExitSuccess : kExitLimit;
  }

  std::string conclusion() const {
    if (!internal_error_.empty()) return internal_error_;
    if (!found_.findings.empty())
      return fmt::format("not verified: {}", counted(found_.findings.size(), "finding"));
    if (!found_.is_complete())
      return fmt::format("bounded: nothing found in {}", counted(found_.states, "state"));
    return "verified for all behaviors that are assumed";
  }

  std::vector<VerdictLine> facts(const TeamSearch& search) const {
    std::vector<VerdictLine> lines;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
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
    for (const VerifiedRobot& it : robots_) {
      for (std::string& line : assumptions(it.runnable.tree, without_robots(it), rate_, it.paces)) {
        if (std::ranges::find(all, line) == all.end()) all.push_back(std::move(line));
      }
    }
    all.push_back("each robot begins once, at any time, and is not killed");
    all.push_back(options_.late == 0
                      ? "each word is heard in the next tick of the other robots"
                      : fmt::format("each word is heard at most {} late, or a newer one",
                                    counted(options_.late, "tick")));
    return all;
  }

  // What the models say of leaves that stand for robots does not count here.
  static LeafModels without_robots(const VerifiedRobot& robot) {
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
    for (std::size_t i = 0; i < robots_.size(); ++i) text += ' ' + options_.robots[i];
    text += fmt::format(
        ": {}, {}\n  {}, {}, {}, {:.2f} s\n", counted(robots_.size(), "robot"),
        options_.leaves.empty() ? std::string("no leaf model") : "leaf model " + options_.leaves,
        counted(found_.states, "state"), counted(found_.transitions, "transition"),
        found_.is_complete() ? std::string("complete")
                             : fmt::format("stopped by {}", limit_of(found_.end)),
        to_seconds(found_.took));
    const auto lines = facts(search);
    std::size_t width = 0;
    for (const VerdictLine& it : lines) width = std::max(width, it.name.size());
    for (const VerdictLine& it : lines)
      text += fmt::format("  {:<{}}  {}\n", it.name, width, it.text);
    for (std::size_t i = 0; i < found_.findings.size(); ++i) {
      const TeamFinding& finding = found_.findings[i];
      text += fmt::format("finding {}: {}\n", finding.name, finding.message);
      for (const std::string& line : finding.more) text += fmt::format("    {}\n", line);
      if (i >= files_.size()) continue;
      text += fmt::format("    -> {}\n", joined(files_[i], ", "));
      if (i > 0) continue;
      text += "       lockstep log merge";
      for (const std::string& it : files_[i]) text += ' ' + shell_word(it);
      text += " --out team.jsonl\n       lockstep replay team.jsonl\n";
    }
    text += fmt::format("  assumed: {}\n", joined(assumed(), "; "));
    return text + conclusion() + '\n';
  }

  std::string as_json(const TeamSearch& search) const {
    Json json = Json::object();
    json["trees"] = Json(options_.robots);
    if (!options_.leaves.empty()) json["leaves"] = options_.leaves;
    json["conclusion"] = conclusion();
    json["complete"] = found_.is_complete();
    if (!found_.is_complete()) json["limit"] = std::string(limit_of(found_.end));
    json["late"] = options_.late;
    json["states"] = found_.states;
    json["transitions"] = found_.transitions;
    json["ticks"] = found_.periods;
    json["seconds"] = to_seconds(found_.took);
    Json results = Json::object();
    for (std::size_t i = 0; i < robots_.size(); ++i) {
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
      if (i < files_.size()) finding["recordings"] = Json(files_[i]);
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
  std::deque<VerifiedRobot> robots_;
  double rate_ = kModelRate;
  TeamSearchResult found_;
  std::vector<std::vector<std::string>> files_;  // of each finding
  std::string internal_error_;
};

}  // namespace

int verify_team(const TeamVerifyOptions& options) {
  return TeamVerification(options).run();
}

}  // namespace lockstep::host
