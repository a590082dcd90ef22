#include "cli/run/required_ticket.h"

#include <fmt/format.h>

#include <stdexcept>

#include "base/terminal/outlet.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/tools/ticket/ticket.h"
#include "run/checkpoint/checkpoint.h"

namespace lockstep::host {
namespace {

int refuse_ticket(const Problem& why) {
  print_error("--require-ticket: " + why.message, why.hint);
  return kExitInvalidTree;
}

std::string shown(const std::string& value) {
  return value.empty() ? "nothing" : printable(value);
}

// What does not differ is not printed.
int refuse_other_tree(const std::vector<Difference>& all) {
  std::string more;
  for (const Difference& it : all)
    more += fmt::format("  {}: {} was proved, {} is given\n", printable(it.name), shown(it.kept),
                        shown(it.now));
  print_error("--require-ticket: this is not the tree that was proved",
              "prove this one: lockstep verify --ticket");
  messages().say(more);
  return kExitInvalidTree;
}

// What the options of the run change in what the tree does. The proof is of a run without them.
std::vector<std::string> changes(const RunCommandOptions& options, const Ticket& ticket) {
  std::vector<std::string> all;
  if (options.stall_fail > 0) all.emplace_back("--stall-fail: a node that makes no progress fails");
  if (options.on_fault == FaultPolicy::Fail)
    all.emplace_back("--on-fault fail: after a fault of a leaf, the run continues");
  if (options.load.plugins.condition_wait || options.load.plugins.condition_age)
    all.emplace_back(
        "--condition-wait, --condition-age: a condition of a program may be old, or Running");
  if (options.keep.resumes && ticket.cuts == 0)
    all.emplace_back("--resume: what a run does after a cut; lockstep verify --cuts 1 proves it");
  if (options.keep.resumes && ticket.cuts > 0 && options.keep.on_resume != ticket.on_resume)
    all.emplace_back(fmt::format("--on-resume {}: the proof has {}",
                                 word_of(options.keep.on_resume), word_of(ticket.on_resume)));
  if (options.monitor_control || options.groot2_control || options.attended ||
      !options.breaks.empty() || !options.break_conditions.empty())
    all.emplace_back("what people change while the tree runs");
  return all;
}

void print_ticket(const RunCommandOptions& options, const Ticket& ticket) {
  std::string text = fmt::format("ticket of {}: {}, at {} ticks per second\n",
                                 printable(ticket.made), printable(ticket.conclusion), ticket.rate);
  for (const std::string& it : ticket.properties)
    text += fmt::format("  {}: {}\n", ticket.is_proof ? "proved" : "holds within the limit",
                        printable(it));
  if (!ticket.is_proof) text += "  not proved: the search had a limit\n";
  for (const std::string& it : ticket.accepted)
    text += fmt::format("  not proved, but accepted: {}\n", printable(it));
  for (const std::string& it : ticket.assumptions)
    text += fmt::format("  not proved, but assumed: {}\n", printable(it));
  for (const std::string& it : changes(options, ticket))
    text += fmt::format("  not proved: {}\n", it);
  text += "  watched: a leaf that breaks the leaf model of the proof has a fault\n";
  messages().say(text);
}

// The leaves that were proved are those that run.
std::string_view other_leaves(const RunCommandOptions& options) {
  if (!options.leaves.empty()) return "--leaves";
  return options.load.mock || !options.load.mock_leaves.empty() ? "--mock" : "";
}

int check_ticket(RunCommandOptions& options, const Loaded& loaded) {
  if (const std::string_view other = other_leaves(options); !other.empty()) {
    print_error(
        fmt::format("--require-ticket and {}: other leaves would run than were proved", other),
        fmt::format("leave out {}", other));
    return kExitUsage;
  }
  if (options.exactly_once) {
    print_error(
        "--require-ticket and --tick exactly-once: the proof is of a tree that is ticked again in "
        "a period when a node requests it",
        "leave out --tick exactly-once");
    return kExitUsage;
  }
  const auto ticket = read_ticket(options.ticket);
  if (!ticket) return refuse_ticket(ticket.error());
  if (const auto good = check_signature(*ticket, options.trusted_keys); !good)
    return refuse_ticket(good.error());
  CheckpointFacts kept{ticket->identity, {}, {}}, now{ticket_identity(loaded), {}, {}};
  if (const auto all = differences(kept, now); !all.empty()) return refuse_other_tree(all);
  if (!options.is_rate_given) options.rate = ticket->rate;
  if (options.rate != ticket->rate) {
    return refuse_other_tree(
        {{"--rate", fmt::format("{}", ticket->rate), fmt::format("{}", options.rate)}});
  }
  options.proved_leaves = ticket->leaves;
  options.proved_properties = ticket->properties;
  options.proved_properties.insert(options.proved_properties.end(), ticket->violated.begin(),
                                   ticket->violated.end());
  print_ticket(options, *ticket);
  return kExitSuccess;
}

}  // namespace

int require_ticket(RunCommandOptions& options, const Loaded& loaded) {
  try {
    return check_ticket(options, loaded);
  } catch (const std::runtime_error& error) {  // there is no libsodium
    print_error(fmt::format("--require-ticket: {}", error.what()));
    return kExitUsage;
  }
}

}  // namespace lockstep::host
