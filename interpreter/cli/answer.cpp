#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <thread>
#include <utility>

#include "base/core/clock.h"
#include "base/core/diagnostics.h"
#include "base/core/suggest.h"
#include "base/core/value.h"
#include "base/core/wording.h"
#include "base/json/json.h"
#include "base/json/reader.h"
#include "base/terminal/outlet.h"
#include "base/terminal/text_table.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/reach_run.h"
#include "show/web/attach_socket.h"

namespace lockstep::host {
namespace {

struct AnswerOptions {
  std::string answer, run, node, by;
  bool json = false;
};

struct Asked {
  ReachableRun run;
  std::uint64_t node = 0, tick = 0;
  std::string path = {}, text = {};
  std::vector<std::string> options = {};

  friend bool operator==(const Asked& one, const Asked& other) {
    return one.run.socket == other.run.socket && one.node == other.node && one.tick == other.tick;
  }
};

// `more`: how many there are beside these.
Result<std::vector<Asked>> questions_of(const ReachableRun& run, std::uint64_t& more) {
  auto text = ask_run(run.socket, std::string(kListQuestions));
  if (!text) return tl::unexpected(text.error());
  std::vector<Asked> found;
  try {
    JsonReader().read(*text, [&](JsonObject object) {
      object.read({{"questions",
                    [&](JsonValue all) {
                      all.each_item([&](JsonValue value) {
                        Asked& it = found.emplace_back(Asked{.run = run});
                        value.object().read({{"node", into(it.node)},
                                             {"tick", into(it.tick)},
                                             {"path", into(it.path)},
                                             {"text", into(it.text)},
                                             {"options", [&](JsonValue options) {
                                                options.each_item([&](JsonValue option) {
                                                  it.options.emplace_back(option.text());
                                                });
                                              }}});
                      });
                    }},
                   {"more", into(more)}});
    });
  } catch (const JsonError& error) {
    return problem(
        fmt::format("run {} answers with no list: {}", printable(run.name), error.what()));
  }
  return found;
}

std::string options_text(const Asked& it) {
  const std::vector<std::string_view> options(it.options.begin(), it.options.end());
  return printable(joined(options, ", "));
}

int list(const std::vector<Asked>& questions, bool json) {
  if (json) {
    Json all = Json::array();
    for (const Asked& it : questions) {
      all.push_back({{"run", it.run.name},
                     {"node", it.path},
                     {"text", it.text},
                     {"options", it.options},
                     {"tick", it.tick}});
    }
    return write_results(all.text() + "\n");
  }
  std::vector<TableRow> rows;
  for (const Asked& it : questions) {
    rows.push_back(
        {printable(it.run.name), printable(it.path), printable(it.text), options_text(it)});
  }
  return write_results(text_table(rows, 4));
}

bool is_meant(const Asked& it, const std::string& node) {
  return node.empty() || it.path == node || it.path.ends_with("/" + node);
}

// Until the run has taken the answer, which it does before its next tick.
bool is_taken(const Asked& question) {
  constexpr std::chrono::milliseconds kLook{20}, kLongest{2000};
  for (std::chrono::milliseconds waited{0}; waited < kLongest; waited += kLook) {
    std::uint64_t more = 0;
    const auto now = questions_of(question.run, more);
    if (!now || std::ranges::find(*now, question) == now->end()) return true;
    std::this_thread::sleep_for(kLook);
  }
  return false;
}

// What counted may have been another answer.
int confirm(const Asked& question, const std::string& given) {
  const AnsweredQuestion asked{static_cast<std::uint32_t>(question.node), question.tick};
  auto text = ask_run(question.run.socket, asked.request());
  if (!text) {  // mostly with the answer
    print_note(fmt::format("run {} has ended", printable(question.run.name)),
               "its recording shows whether it took the answer");
    return kExitSuccess;
  }
  std::string answer, who;
  try {
    JsonReader().read(*text, [&](JsonObject object) {
      object.read({{"answer", into(answer), kMayLack}, {"who", into(who), kMayLack}});
    });
  } catch (const JsonError& error) {
    return refuse({error.what()});
  }
  if (answer.empty()) {
    return refuse({fmt::format("{} waits for no answer any more", printable(question.path))});
  }
  messages().say(fmt::format("{}: {}\n", printable(question.path), printable(answer)));
  if (answer == given) return kExitSuccess;
  return refuse({fmt::format("{} answered before", printable(who))});
}

int give(const Asked& question, const AnswerOptions& options) {
  const Json order = {{"do", "answer"},
                      {"node", question.node},
                      {"answer", options.answer},
                      {"seen", question.tick},
                      {"by", options.by.empty() ? user_name() : options.by}};
  const auto taken = ask_run(question.run.socket, order.text());
  if (!taken) return refuse(taken.error());
  if (!is_taken(question)) {
    return refuse(
        {fmt::format("{} is held, or the run is paused: it takes the answer when it "
                     "continues",
                     printable(question.path))});
  }
  return confirm(question, options.answer);
}

int answer(const AnswerOptions& options) {
  const auto runs = reachable_runs(options.run);
  if (runs.empty()) {
    const std::string which =
        options.run.empty() ? "no run" : fmt::format("no run {}", printable(options.run));
    return refuse({which + " of yours asks people",
                   "a run asks if its tree has an Ask: lockstep run TREE.xml"});
  }
  std::vector<Asked> questions;
  for (const ReachableRun& run : runs) {
    std::uint64_t more = 0;
    auto found = questions_of(run, more);
    if (!found && !options.run.empty()) return refuse(found.error());
    if (!found) print_note(found.error().message, found.error().hint);
    if (more > 0) print_note(fmt::format("run {} has {} more questions", run.name, more));
    if (!found) continue;
    for (Asked& it : *found) {
      if (is_meant(it, options.node)) questions.push_back(std::move(it));
    }
  }
  if (options.answer.empty()) return list(questions, options.json);
  if (questions.empty()) return refuse({"no run of yours asks anything now"});
  std::vector<Asked> fitting = questions;
  std::erase_if(fitting, [&](const Asked& it) {
    return std::ranges::find(it.options, options.answer) == it.options.end();
  });
  if (fitting.empty()) {
    const Asked& it = questions.front();
    const std::vector<std::string_view> known(it.options.begin(), it.options.end());
    return refuse({fmt::format("'{}' is no answer to {}: {}", brief(options.answer),
                               printable(it.path), printable(it.text)),
                   suggest(options.answer, known, "its answers")});
  }
  if (fitting.size() == 1) return give(fitting.front(), options);
  list(fitting, false);
  return refuse({fmt::format("'{}' answers {} questions", brief(options.answer), fitting.size()),
                 "lockstep answer ANSWER PID --node NODE"});
}

std::function<int()> define_answer(CLI::App& app) {
  const auto options = std::make_shared<AnswerOptions>();
  app.add_option("answer", options->answer,
                 "The answer; without one, the open questions are listed")
      ->type_name("ANSWER");
  app.add_option("run", options->run,
                 "Only of this run: the number of its process, or the path of its socket")
      ->type_name("PID|PATH");
  app.add_option("--node", options->node, "Only of this node: its path, or the end of that")
      ->type_name("NODE");
  app.add_option("--by", options->by, "Who answers, for the recording (default: your user name)")
      ->type_name("NAME");
  app.add_flag("--json", options->json, "Print the list as JSON");
  return [options] { return answer(*options); };
}

struct AttendOptions {
  std::string run;
  bool once = false;
};

// Renews; how long that lasts.
Result<Nanoseconds> renew(const ReachableRun& run) {
  const Json order = {{"do", "attend"}, {"by", user_name()}};
  const auto given = ask_run(run.socket, order.text());
  if (!given) return tl::unexpected(given.error());
  return from_seconds(parse_double(*given).value_or(1));
}

int attend(const AttendOptions& options) {
  constexpr Nanoseconds kLongest = std::chrono::seconds(1);
  constexpr int kTimes = 4;  // before it is over
  auto runs = reachable_runs(options.run);
  Problem why{"no run of yours needs people to attend", "lockstep run TREE.xml --attended 5"};
  bool is_first = true;
  while (!runs.empty()) {
    Nanoseconds next = kLongest;
    std::erase_if(runs, [&](const ReachableRun& run) {
      const auto lasts = renew(run);
      lasts ? void(next = std::min(next, *lasts / kTimes)) : void(why = lasts.error());
      return !lasts;
    });
    if (runs.empty() || options.once) break;
    if (std::exchange(is_first, false)) {
      messages().say(fmt::format("attending {}; Ctrl-C ends it\n", counted(runs.size(), "run")));
    }
    std::this_thread::sleep_for(next);
  }
  if (is_first && runs.empty()) return refuse(why);
  if (!options.once) messages().say("the run has ended\n");
  return kExitSuccess;
}

std::function<int()> define_attend(CLI::App& app) {
  const auto options = std::make_shared<AttendOptions>();
  app.add_option("run", options->run,
                 "Only this run: the number of its process, or the path of its socket")
      ->type_name("PID|PATH");
  app.add_flag("--once", options->once, "Renew once, as a script does");
  return [options] { return attend(*options); };
}

}  // namespace

extern const Command kAnswerCommand{
    "answer", "Answer what a run asks, or list its questions",
    "For trees with an Ask. Reaches the runs of your user on this machine.\n"
    "Exit code: 0 answered or listed, 2 usage, no such question, or the run is paused.\n"
    "\n"
    "Examples:\n"
    "  lockstep answer\n"
    "  lockstep answer yes\n"
    "  lockstep answer left 4711 --node where --by maria",
    define_answer};

extern const Command kAttendCommand{
    "attend", "Attend a run, which pauses while it is unattended",
    "For runs with --attended. Renews until Ctrl-C, or until they have ended.\n"
    "Exit code: 0 the runs have ended, 2 usage, or no run needs it, 130 Ctrl-C.\n"
    "\n"
    "Examples:\n"
    "  lockstep attend\n"
    "  lockstep attend 4711 --once",
    define_attend};

}  // namespace lockstep::host
