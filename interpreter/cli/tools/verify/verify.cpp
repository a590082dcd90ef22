#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <thread>

#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "base/system/output_file.h"
#include "base/terminal/outlet.h"
#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/help_text.h"
#include "cli/load/load_options.h"
#include "cli/load/tree_argument.h"
#include "cli/outputs.h"
#include "cli/properties.h"
#include "cli/tools/new/new.h"
#include "cli/tools/ticket/ticket.h"
#include "cli/tools/verify/fmea.h"
#include "cli/tools/verify/probability_report.h"
#include "cli/tools/verify/save_scenarios.h"
#include "cli/tools/verify/verify_input.h"
#include "cli/tools/verify/verify_report.h"
#include "cli/tools/verify/verify_team.h"
#include "engine/compile.h"
#include "language/document/file.h"
#include "language/document/reporter.h"
#include "run/stop_signals.h"
#include "team/team_run.h"
#include "tree/pace.h"
#include "verify/assumptions.h"
#include "verify/chance_runs.h"
#include "verify/property_watch.h"
#include "verify/verifiable.h"

namespace lockstep::host {
namespace {

// Of --time: the rest is for the questions about what was found. Runs by chance are beyond it.
constexpr double kTimeOfSearch = 0.85, kTimeOfChance = 0.03;

constexpr std::uint64_t kMostCuts = 100, kMostLate = 100;
constexpr std::uint32_t kUsuallyLate = 1;

struct VerifyOptions {
  LoadCommandOptions load;
  std::string tree, leaves;
  std::vector<std::string> more;      // trees of other robots
  std::optional<std::uint32_t> late;  // words of theirs, in ticks
  std::optional<double> rate;
  std::uint64_t states = 5'000'000;
  std::optional<std::uint64_t> memory_mib;
  std::optional<double> time;
  std::optional<std::uint64_t> depth;
  std::uint64_t values = kUsualValues;
  unsigned jobs = 1;
  bool json = false;
  std::string format = "text";
  std::vector<std::string> only;
  bool symmetry = true, compact = false;
  std::uint32_t cuts = 0;
  AfterCut on_resume = AfterCut::StartsAgain;
  std::string out = ".";
  std::string save;          // a file of scenarios; "": none
  std::string save_model;    // a file for a leaf model; "": none
  std::string ticket, sign;  // files; "": none
  bool fmea = false, pairs = false;
  bool probability = false;
  PropertyOptions properties;
};

// Half of what the machine has.
std::size_t usual_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0
             ? static_cast<std::size_t>(pages) / 2 * static_cast<std::size_t>(size)
             : std::size_t{1} << 30u;
}

// Shows how far a search is: on a terminal a line that changes, elsewhere lines, of which a search
// of a few seconds has none.
class SearchLine {
 public:
  ~SearchLine() { clear(); }
  void clear() {
    if (std::exchange(is_visible_, false)) messages().say("\r\x1b[K");
  }
  void show(const SearchProgress& it) {
    show([&](double seconds) {
      return fmt::format("{} states, {} waiting, tick {}, {:.0f} transitions/s, {} MiB", it.states,
                         it.waiting, it.depth, static_cast<double>(it.transitions) / seconds,
                         it.memory >> 20u);
    });
  }
  // `text` makes one of the seconds since the begin.
  template <class Text>
  void show(const Text& text) {
    constexpr std::chrono::seconds kOnTerminal(1), kElsewhere(10);
    const Nanoseconds now = monotonic_now();
    if (now - shown_ < (is_terminal_ ? kOnTerminal : kElsewhere)) return;
    const double seconds = to_seconds(now - start_);
    shown_ = now;
    if (is_terminal_) {
      is_visible_ |= messages().show("\r" + text(seconds) + "\x1b[K");
    } else {
      messages().say(fmt::format("verify: {:.0f} s: {}\n", seconds, text(seconds)));
    }
  }

 private:
  const bool is_terminal_ = is_terminal(STDERR_FILENO);
  const Nanoseconds start_ = monotonic_now();
  Nanoseconds shown_ = start_;
  bool is_visible_ = false;
};

// "2026-11-29T12:00:00Z"
std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts;
  gmtime_r(&now, &parts);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

class VerifyCommand {
  // What a ticket must not replace.
  std::vector<NamedFile> inputs_of_ticket(const Loaded& loaded) const {
    std::vector<std::string> given{options_.tree, options_.leaves, options_.sign};
    given.insert(given.end(), options_.properties.files.begin(), options_.properties.files.end());
    return inputs_of(loaded, std::move(given));
  }

 public:
  explicit VerifyCommand(const VerifyOptions& options) : options_(options) {}

  int run_team() {
    StopSignals::install();
    SearchLine line;
    TeamVerifyOptions team{.files = {.load = options_.load,
                                     .robots = options_.more,
                                     .leaves = options_.leaves,
                                     .rate = options_.rate,
                                     .is_searched = true},
                           .late = options_.late.value_or(kUsuallyLate),
                           .limits = limits(line),
                           .search_ended = [&line] { line.clear(); },
                           .out = options_.out,
                           .json = options_.json || options_.format == "json"};
    team.files.robots.insert(team.files.robots.begin(), options_.tree);
    return verify_team(team);
  }

  int run() {
    auto loaded = load();
    if (!loaded) return code_;
    const Places places(*loaded);
    if (!options_.ticket.empty()) {
      if (would_overwrite("--ticket", options_.ticket, inputs_of_ticket(*loaded)))
        return kExitUsage;
      identity_ = ticket_identity(*loaded);
    }
    if (options_.cuts > 0) {
      if (const auto why_not = why_not_kept(compile(loaded->definition)))
        print_note("--cuts: " + why_not->message, "only a run with --leaves continues after a cut");
    }
    played_.take_over(loaded->definition);
    paces_ = paces(loaded->definition);
    ignore_pace(loaded->definition);
    const Runnable runnable = make_runnable(std::move(*loaded));
    // A search may take long.
    if (!options_.save.empty() &&
        !tree_to_save(options_.save, {options_.tree, options_.load.main_tree, runnable.tree.id}))
      return kExitUsage;
    const auto file = read_leaves(options_.leaves, leaves_, diagnostics_);
    if (!file) return refuse();
    auto properties = all_properties(runnable.properties, options_.properties, [&] {
      return names_with_facts(runnable.tree,
                              *file != nullptr ? (*file)->facts : std::vector<FactRow>());
    });
    if (!properties) return kExitUsage;
    properties_ = std::move(*properties);
    if (!knows_only(runnable.tree)) return kExitUsage;
    std::vector<NodeProblem> problems = not_verifiable(runnable.tree);
    const Observed observed = observed_by(runnable.tree, properties_, problems);
    if (!options_.save_model.empty() && !save_model(runnable.tree, observed.entries))
      return kExitUsage;
    LeafModels models = make_models(runnable.tree, file->get(), diagnostics_, problems, observed,
                                    Declared::Counts, given_outputs());
    allow_cuts({.most = options_.cuts, .otherwise = options_.on_resume}, runnable.tree, models);
    places.report(problems, diagnostics_);
    if (diagnostics_.has_errors()) return refuse();
    print_diagnostics(diagnostics_, Severity::Warning);
    return verify(runnable, models, places);
  }

 private:
  // Before the search, which may not end, and before what the model must say is missed.
  bool save_model(const Tree& tree, const std::vector<std::uint32_t>& observed) const {
    const std::string& file = options_.save_model;
    if (std::error_code none; std::filesystem::exists(file, none)) {
      print_error(fmt::format("--save-model: '{}' exists", printable(file)),
                  "remove it, or give another name");
      return false;
    }
    const std::string name = std::filesystem::path(options_.tree).filename().string();
    const auto written = write_output(
        file, new_leaf_model(tree, options_.tree == "-" ? "stdin.xml" : name, observed));
    if (!written) {
      print_error("--save-model: " + written.error().message, written.error().hint);
      return false;
    }
    messages().say(
        fmt::format("verify: wrote '{}': fill it in, and give it as --leaves\n", printable(file)));
    return true;
  }

  tl::expected<Loaded, LoadFailure> load() {
    auto loaded = load_given(options_.tree, options_.load, diagnostics_);
    if (loaded) return loaded;
    const bool lacks_nodes = std::ranges::any_of(
        diagnostics_.all(), [](const Diagnostic& it) { return it.code.text() == "unknown-node"; });
    if (lacks_nodes && !options_.load.mock) {
      diagnostics_.note("mocked-node"_code, {},
                        "verify --mock takes nodes that no plugin has for leaves");
    }
    if (const auto comma = options_.tree.find(','); comma != std::string::npos) {
      diagnostics_.note("bad-argument"_code, {},
                        "one tree takes its arguments as options: --arg " +
                            printable(options_.tree.substr(comma + 1)));
    }
    print_diagnostics(diagnostics_, Severity::Note);
    code_ = exit_code_of(loaded.error());
    return loaded;
  }

  // Of --mock-output, which loading has checked.
  GivenOutputs given_outputs() const {
    GivenOutputs outputs;
    for (const std::string& it : options_.load.mock_outputs) {
      const auto sign = it.find('=');
      outputs[it.substr(0, sign)] = it.substr(sign + 1);
    }
    return outputs;
  }

  int refuse() {
    print_diagnostics(diagnostics_, Severity::Warning);
    return kExitInvalidTree;
  }

  int verify(const Runnable& runnable, const LeafModels& models, const Places& places) {
    const double rate = options_.rate.value_or(models.rate.value_or(kModelRate));
    StopSignals::install();
    if (options_.fmea) return write_fmea(runnable, models, rate);
    if (options_.probability) return write_probability(runnable, models, rate);
    VerdictOptions options{
        .rate = rate, .place = [&](NodeIndex node) { return places.text(node); }, .paces = paces_};
    SearchResult found = [&] {
      SearchLine line;
      const SearchLimits limited = limits(line);
      if (options_.time) options.until = began_ + from_seconds(*options_.time);
      options.memory = limited.memory;
      return search(runnable.tree, models, properties_, rate, limited);
    }();
    Verdict verdict = make_verdict(runnable.tree, models, properties_, found, options);
    if (verdict.is_cut && found.is_complete()) found.end = SearchEnd::Time;
    if (!options_.only.empty()) verdict.keep_only(options_.only);
    VerifyReport report{
        found,         verdict,      options_.tree, options_.leaves, runnable.tree.leaves.size(),
        options_.cuts, options_.only};
    if (wants_costs(found.end)) report.costs = search_costs(runnable.tree, models, rate);
    Tracer tracer(runnable.tree, models, properties_, rate, found);
    ChanceLimits chance = usual_chance(found);
    chance.stop_signal = StopSignals::received;
    if (options.until) {
      const Nanoseconds left =
          *options.until + from_seconds(*options_.time * kTimeOfChance) - monotonic_now();
      chance.time = std::min(chance.time, std::max(Nanoseconds(0), left));
    }
    if (const auto wrong =
            find_contradiction(runnable.tree, models, properties_, rate, found, chance)) {
      report.internal_error = to_text(*wrong);
    }
    // A verdict may have taken long, so it is printed also where its files cannot be written.
    const bool has_files =
        write_files(runnable, rate, tracer, verdict, report) &&
        (options_.save.empty() || save_scenarios(options_.save, report,
                                                 {runnable.tree, options_.load.main_tree, models,
                                                  properties_, rate, tracer, played_}));
    const int failed = write_results(written(report));
    if (!report.internal_error.empty()) {
      print_error(report.internal_error,
                  "this is a bug in lockstep: please report it with the tree and the leaf model");
      return kExitInternal;
    }
    if (!has_files) return kExitUsage;
    const int code = exit_code(found, verdict);
    const bool is_wanted = !options_.ticket.empty();
    if (is_wanted && (code == kExitSuccess || code == kExitLimit) && !give_ticket(report, rate))
      return kExitUsage;
    return first_failure(failed, code);
  }

  int write_fmea(const Runnable& runnable, const LeafModels& models, double rate) const {
    SearchLine line;
    const std::vector<FailureRow> rows = failure_table(
        runnable.tree, models, properties_,
        {.rate = rate, .pairs = options_.pairs, .limits = limits(line), .until = end_of_search()});
    const FmeaReport report{runnable.tree, properties_, rows, rate};
    const int failed = write_results(to_text(report, options_.json ? "json" : options_.format));
    const int signal = StopSignals::received();
    if (signal != 0) return kExitSignal + signal;
    const bool is_whole = std::ranges::all_of(rows, &FailureRow::is_complete);
    return first_failure(failed, is_whole ? kExitSuccess : kExitLimit);
  }

  int write_probability(const Runnable& runnable, const LeafModels& models, double rate) const {
    std::optional<SearchLine> line(std::in_place);
    const ChanceGraph graph =
        explore_chances(runnable.tree, models, properties_, rate, limits(*line));
    std::optional<Nanoseconds> until;
    if (options_.time) until = began_ + from_seconds(*options_.time);
    const Probabilities found = probabilities(
        graph,
        [&] {
          line->show([&](double) {
            return fmt::format("{} states, all found; the numbers come nearer", graph.states);
          });
          return StopSignals::received() != 0;
        },
        until);
    line.reset();
    const ProbabilityReport report{graph,
                                   found,
                                   properties_,
                                   options_.tree,
                                   options_.leaves,
                                   runnable.tree.leaves.size(),
                                   assumptions(runnable.tree, models, rate, paces_),
                                   wants_costs(graph.end)
                                       ? search_costs(runnable.tree, models, rate)
                                       : std::vector<SearchCost>()};
    const bool as_json = options_.json || options_.format == "json";
    const int failed = write_results(as_json ? to_json(report) : to_text(report));
    const int signal = StopSignals::received();
    if (signal != 0) return kExitSignal + signal;
    const bool is_whole = graph.end == SearchEnd::Complete && !found.is_cut;
    return first_failure(failed, is_whole ? kExitSuccess : kExitLimit);
  }

  // A mistyped name would leave out its finding.
  bool knows_only(const Tree& tree) const {
    if (options_.only.empty()) return true;
    const std::vector<std::string> names = possible_findings(tree, properties_);
    const std::vector<std::string_view> known(names.begin(), names.end());
    for (const std::string& it : options_.only) {
      if (may_mean_finding(it, names)) continue;
      const bool is_of_property = it.starts_with(kPropertyFinding);
      print_error(is_of_property ? fmt::format("--only: there is no property '{}'", printable(it))
                                 : fmt::format("--only: no finding of this tree has the name '{}'",
                                               printable(it)),
                  suggest(it, known, is_of_property ? "findings about properties" : "findings"));
      return false;
    }
    return true;
  }

  bool give_ticket(const VerifyReport& report, double rate) const {
    Ticket ticket{.made = utc_now(),
                  .identity = identity_,
                  .rate = rate,
                  .conclusion = conclusion(report),
                  .is_proof = report.found.is_proof(),
                  .cuts = options_.cuts,
                  .on_resume = options_.on_resume,
                  .leaves = leaves_,
                  .properties = {},
                  .violated = {},
                  .accepted = {},
                  .assumptions = report.verdict.assumed,
                  .key = {},
                  .signature = {}};
    std::set<std::string> findings;
    for (const Finding& it : report.verdict.findings) {
      findings.insert(it.name);
      ticket.accepted.push_back(fmt::format("{}: {} ({})", it.name, it.message, it.accepted));
    }
    for (const Property& it : properties_) {
      auto& list = findings.contains(name_of_finding(it)) ? ticket.violated : ticket.properties;
      list.push_back(it.has_name() ? fmt::format("{}: {}", it.name(), it.text()) : it.text());
    }
    auto done = sign_ticket(ticket, options_.sign);
    if (done) done = write_ticket(options_.ticket, ticket);
    if (done) return true;
    print_error("--ticket: " + done.error().message, done.error().hint);
    return false;
  }

  std::string written(const VerifyReport& report) const {
    if (options_.json || options_.format == "json") return to_json(report);
    return options_.format == "junit" ? to_junit(report) : to_text(report);
  }

  std::optional<Nanoseconds> end_of_search() const {
    if (!options_.time) return std::nullopt;
    return began_ + from_seconds(*options_.time * kTimeOfSearch);
  }

  SearchLimits limits(SearchLine& line) const {
    SearchLimits limits{.states = options_.states, .memory = usual_memory()};
    if (options_.memory_mib) limits.memory = *options_.memory_mib << 20u;
    if (const auto until = end_of_search())
      limits.time = std::max(Nanoseconds(0), *until - monotonic_now());
    limits.values = options_.values;
    if (options_.depth) limits.depth = static_cast<std::uint32_t>(*options_.depth);
    limits.stop_signal = StopSignals::received;
    limits.jobs = options_.jobs;
    limits.symmetry = options_.symmetry;
    if (options_.compact) limits.hash_bits = 64;
    limits.tell = [&line](const SearchProgress& it) { line.show(it); };
    return limits;
  }

  bool write_files(const Runnable& runnable, double rate, Tracer& tracer, const Verdict& verdict,
                   VerifyReport& report) {
    CounterExampleOptions options{.stem = {}, .tree_file = options_.tree, .rate = rate};
    options.arguments = values_of(runnable.arguments);
    options.values = runnable.values;
    for (const Finding& finding : verdict.findings) {
      if (finding.run.empty() || !finding.accepted.empty()) continue;
      std::error_code error;
      std::filesystem::create_directories(options_.out, error);
      options.stem = stem_of(finding);
      auto files =
          write_counter_example(runnable.tree, finding, tracer, played_, properties_, options);
      if (!files) {
        print_error(files.error().message, files.error().hint);
        return false;
      }
      report.files[finding.name] = *files;
      if (!files->contradiction.empty() && report.internal_error.empty()) {
        report.internal_error =
            fmt::format("internal error: the run that shows the finding {} contradicts it: {}",
                        finding.name, files->contradiction);
      }
    }
    return true;
  }

  std::string stem_of(const Finding& finding) {
    const std::filesystem::path tree(options_.tree == "-" ? "stdin" : options_.tree);
    std::string name = file_stem(tree.stem().string() + '.' + finding.name);
    const auto count = ++stems_[name];
    if (count > 1) name += fmt::format("-{}", count);
    return options_.out == "." ? name : (std::filesystem::path(options_.out) / name).string();
  }

  static int exit_code(const SearchResult& found, const Verdict& verdict) {
    if (verdict.has_findings()) return kExitFailure;
    if (found.end == SearchEnd::Signal) return kExitSignal + found.signal;
    return found.is_proof() ? kExitSuccess : kExitLimit;
  }

  const VerifyOptions& options_;
  const Nanoseconds began_ = monotonic_now();  // --time counts from here, with loading the tree
  Diagnostics diagnostics_;
  PlayedLeaves played_;
  bool paces_ = false;  // nodes of the tree do
  std::vector<Property> properties_;
  TreeIdentity identity_;                     // for the ticket
  std::string leaves_;                        // the text of the leaf model
  std::map<std::string, std::size_t> stems_;  // of recordings: how many findings have them
  int code_ = kExitSuccess;
};

// An option that says nothing of several robots; "": there is none.
std::string_view not_for_teams(const VerifyOptions& options) {
  if (options.fmea) return "--fmea";
  if (options.probability) return "--probability";
  if (options.cuts != 0) return "--cuts";
  if (!options.ticket.empty()) return "--ticket";
  if (!options.save.empty()) return "--save";
  if (!options.save_model.empty()) return "--save-model";
  if (!options.only.empty()) return "--only";
  if (options.compact) return "--compact";
  if (options.depth) return "--depth";
  if (options.values != kUsualValues) return "--values";
  if (!options.symmetry) return "--no-symmetry";
  if (!options.properties.texts.empty() || !options.properties.files.empty()) return "--property";
  return options.format == "junit" ? "--format junit" : "";
}

int verify(const VerifyOptions& options) {
  keep_stdout_for_results();
  const bool is_of_fmea = options.format == "md" || options.format == "csv";
  if (is_of_fmea && !options.fmea) {
    print_error(fmt::format("--format {} is for --fmea", options.format));
    return kExitUsage;
  }
  if (options.fmea && (options.format == "junit" || !options.ticket.empty())) {
    print_error("--fmea prints a table: as text, md, csv or json, and without a ticket");
    return kExitUsage;
  }
  if (options.fmea && options.cuts != 0) {
    print_error("--fmea and --cuts: a row is what one failure does, without a cut",
                "leave out --cuts");
    return kExitUsage;
  }
  const bool is_text_or_json = options.format == "text" || options.format == "json";
  if (options.probability && (options.fmea || !is_text_or_json || !options.ticket.empty())) {
    print_error("--probability prints probabilities: as text or json, without --fmea and a ticket");
    return kExitUsage;
  }
  if ((options.probability || options.fmea) && (!options.save.empty() || !options.only.empty())) {
    print_error(fmt::format("{}: there are no findings to save, and it answers all questions",
                            options.fmea ? "--fmea" : "--probability"),
                "leave out --save and --only");
    return kExitUsage;
  }
  if (options.probability && (options.cuts != 0 || options.compact || options.depth)) {
    print_error("--probability: cuts have no chances, and all ticks and states count",
                "leave out --cuts, --compact and --depth");
    return kExitUsage;
  }
  if (!options.ticket.empty() && !options.only.empty()) {
    print_error("--ticket and --only: a ticket is for all questions", "leave out --only");
    return kExitUsage;
  }
  if (!options.more.empty()) {
    if (const std::string_view option = not_for_teams(options); !option.empty()) {
      print_error(fmt::format("{} is for one tree, and here are several", option),
                  "verify each of them by itself with it");
      return kExitUsage;
    }
    return VerifyCommand(options).run_team();
  }
  if (options.late) {
    print_error("--late is for the trees of several robots",
                "name them: lockstep verify left.xml right.xml");
    return kExitUsage;
  }
  try {
    return VerifyCommand(options).run();
  } catch (const std::runtime_error& error) {
    if (options.ticket.empty()) throw;
    print_error(fmt::format("--ticket: {}", error.what()));  // there is no libsodium
    return kExitUsage;
  }
}

std::function<int()> define_verify(CLI::App& app) {
  const auto options = std::make_shared<VerifyOptions>();
  add_tree_argument(app, options->tree, "Tree file; - is stdin");
  app.add_option("robots", options->more,
                 "The trees of the other robots of its team, to be verified together; arguments "
                 "of one robot follow its file: carry.xml,me=right")
      ->type_name("TREE.xml[,ARG=VALUE]");
  app.add_option("--late", options->late,
                 "Of several robots: each word is heard at most N ticks late (default: 1)")
      ->type_name("N")
      ->transform(whole_number(0, kMostLate));
  app.add_option(
         "--leaves", options->leaves,
         "A leaf model: what the leaves may do (default: everything that their contract allows)")
      ->type_name("FILE");
  app.add_option("--rate", options->rate,
                 "Ticks per second (default: that of the leaf model, otherwise 10)")
      ->type_name("HZ")
      ->check(number_between(0.001, 100000.0));
  app.add_option("--states", options->states, "Stop after N states")
      ->type_name("N")
      ->transform(whole_number(1))
      ->capture_default_str();
  app.add_option("--memory", options->memory_mib,
                 "Stop when the search has taken N MiB (default: half of the machine)")
      ->type_name("N")
      ->transform(whole_number(1, 1u << 24u));
  app.add_option("--time", options->time, "Stop after S seconds")
      ->type_name("S")
      ->check(number_between(0.0, 1e9));
  app.add_option("--depth", options->depth, "Search only the first N ticks")
      ->type_name("N")
      ->transform(whole_number(1, 1'000'000'000));
  app.add_option("--cuts", options->cuts,
                 "Cut the process before any tick, at most N times in a run: it is resumed as with "
                 "`run --resume` (N: 1 when it is left out)")
      ->type_name("N")
      ->expected(0, 1)
      ->default_str("1")
      ->transform(whole_number(0, kMostCuts));
  app.add_option_function<std::string>(
         "--on-resume",
         [options](const std::string& word) { options->on_resume = *after_cut_named(word); },
         "With --cuts: what leaves do that ran at the cut and cannot continue: restart, failure or "
         "success")
      ->needs("--cuts")
      ->check(one_of({"restart", "failure", "success"}))
      ->default_str("restart");
  app.add_option("--values", options->values, "Stop when an entry has had more than N values")
      ->type_name("N")
      ->transform(whole_number(1))
      ->capture_default_str();
  options->jobs = std::max(1u, std::thread::hardware_concurrency());
  app.add_option("-j,--jobs", options->jobs, "Threads; the verdict does not depend on it")
      ->type_name("N")
      ->transform(whole_number(1, 1024))
      ->capture_default_str();
  app.add_option("--out", options->out,
                 "The directory for the recordings and scripts of the findings")
      ->type_name("DIR")
      ->capture_default_str();
  app.add_option("--save", options->save,
                 "Add the findings to this file of scenarios for `lockstep test`; it is made if it "
                 "is missing")
      ->type_name("FILE.test.xml");
  app.add_option("--save-model", options->save_model,
                 "Before the search, write a leaf model to fill in, for the leaves that no plugin "
                 "describes")
      ->type_name("FILE.leaves.xml");
  add_property_options(app, options->properties);
  app.add_option("--ticket", options->ticket,
                 "Without findings, write a ticket for `lockstep run --require-ticket`")
      ->type_name("FILE");
  app.add_option("--sign", options->sign,
                 "Sign the ticket with this private key of Ed25519, in PEM")
      ->type_name("KEY")
      ->needs("--ticket");
  app.add_option("--only", options->only,
                 "Report only these findings: a name such as 'trap', in which * stands for any "
                 "part; may be repeated")
      ->type_name("FINDING");
  app.add_flag(
      "--fmea", options->fmea,
      "In place of a verdict, print a table of failure modes and effects: what the tree does "
      "when one leaf fails");
  app.add_flag("--pairs", options->pairs, "With --fmea: also each two failures of different leaves")
      ->needs("--fmea");
  app.add_flag("--probability", options->probability,
               "In place of a verdict, print how likely each result and property is, from the "
               "chances in the leaf model");
  app.add_option("--format", options->format,
                 "text, json or junit (a test for each question); of --fmea also md and csv")
      ->check(one_of({"text", "json", "junit", "md", "csv"},
                     {"sarif", "junit is for a workflow, and json for other programs"}))
      ->capture_default_str();
  app.add_flag("--compact", options->compact,
               "Keep a hash of 64 bits in place of each state: less memory, but not a proof: a "
               "state may be missed, with a probability that the verdict reports");
  app.add_flag_callback(
      "--no-symmetry", [options] { options->symmetry = false; },
      "Count separately the states that differ only in which symmetric child does what");
  app.add_flag("--json", options->json, "The same as --format json");
  add_mock_option(app, options->load);
  add_load_options(app, options->load);
  add_program_option(app, options->load.plugins);
  constexpr const char* kOfExperts[] = {"--compact", "--no-symmetry", "--values",
                                        "--sign",    "--on-resume",   "--depth"};
  only_in_help_all(app, kOfExperts);
  return [options] { return verify(*options); };
}

}  // namespace

std::optional<std::unique_ptr<LeafFile>> read_leaves(const std::string& path, std::string& as_text,
                                                     Diagnostics& diagnostics) {
  if (path.empty()) return nullptr;
  constexpr std::size_t kMost = std::size_t{16} << 20u;
  auto text = read_file(path, kMost, FileKinds::RegularOrPipe);
  if (!text) {
    diagnostics.error("unreadable-file"_code, {path}, text.error().message, text.error().hint);
    return std::nullopt;
  }
  as_text = *text;
  auto file = read_leaf_file(path, std::move(*text), diagnostics);
  if (file == nullptr) return std::nullopt;
  return file;
}

extern const Command kVerifyCommand{
    "verify", "Check every behavior of a tree, with any results of its leaves",
    "The verdict goes to stdout, messages go to stderr. Each finding comes with a recording,\n"
    "and with a script of the leaves with which `lockstep run --leaves` repeats it.\n"
    "Exit code: 0 all is verified, 1 there are findings, 2 usage, 3 invalid tree or leaf model, "
    "or\n"
    "something that cannot be verified, 4 plugin refused, 9 a run contradicts the search (a bug\n"
    "in lockstep), 124 a limit was reached and nothing was found, or nothing with --compact,\n"
    "128 + N signal N.\n"
    "\n"
    "Examples:\n"
    "  lockstep verify --example door_pulling\n"
    "  lockstep verify tree.xml --leaves tree.leaves.xml --out findings\n"
    "  lockstep verify carry.xml,me=left carry.xml,me=right\n"
    "  lockstep run tree.xml --leaves findings/tree.trap.leaves --clock virtual",
    define_verify};

}  // namespace lockstep::host
