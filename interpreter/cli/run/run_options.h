// The command line options of `lockstep run`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/load/load_options.h"
#include "cli/properties.h"
#include "lockstep/leaf.h"
#include "record/write/recorder.h"
#include "run/kept_run.h"
#include "run/loop.h"
#include "run/realtime.h"
#include "team/network.h"

namespace lockstep::host {

struct RunCommandOptions {
  LoadCommandOptions load;
  std::string tree;
  std::string leaves;                // scripts that are played in place of plugins; "": none
  std::vector<ScriptCut> cuts = {};  // of those: see LoopOptions
  double rate = 100;
  bool is_rate_given = false;
  std::string clock = "wall";
  std::uint64_t seed = 0;
  std::optional<std::uint64_t> max_ticks;
  std::string tick_limit = "--max-ticks";  // its giver
  std::optional<double> timeout;
  double stall = 5;
  double stall_fail = 0;

  OverrunPolicy overrun = OverrunPolicy::Skip;
  bool exactly_once = false;  // a tick of the tree in each period, also when a node asks for more
  std::optional<double> tick_budget_ms;  // none: the period, at least 1 ms; 0: no budget
  bool times_calls = false;              // each of them
  RealtimeOptions realtime;
  std::optional<Processors> helper_processors;  // of lockstep's other threads
  double spin_us = 0;                           // before each tick, without sleep
  FaultPolicy on_fault = FaultPolicy::Stop;

  PropertyOptions properties;
  bool ends_on_violation = false;
  std::string ticket;                               // of the tree; "": none is required
  std::string trusted_keys;                         // a file; "": the ticket need not be signed
  std::string watched_leaves;                       // a leaf model; "": none
  std::optional<std::string> proved_leaves = {};    // the text of that of the ticket, perhaps ""
  std::vector<std::string> proved_properties = {};  // of the ticket

  std::string record;
  bool record_compress = false;
  Rotation rotation = {};
  bool stop_on_record_error = false;
  KeepOptions keep;  // but for its sync and its clock
  double checkpoint_sync_ms = 100;
  bool checkpoint_required = false;  // the run ends where it cannot be kept
  // Where the run pauses, for who types.
  std::vector<std::string> breaks, break_conditions;
  std::optional<double> attended;  // s: the run stands while nobody has renewed for so long
  std::string view = "auto";
  lockstep_log_level log_level = LOCKSTEP_LOG_INFO;
  std::string record_entries = "all";
  bool json = false;
  bool notifies = false;  // the service manager

  std::optional<std::string> monitor;         // where it is reached; none: there is no monitor
  std::optional<std::string> monitor_socket;  // where one can be asked for; none: nowhere
  bool monitor_control = false;               // who watches may pause the run, and more
  bool begins_paused = false;
  std::optional<double> monitor_linger = {};  // s
  bool opens_browser = false;

  TeamNetworkOptions team;

  std::optional<std::string> groot2;  // where Groot2 finds it; none: nowhere
  bool groot2_control = false;        // it may pause the run

  bool is_real() const { return clock != "virtual"; }  // time passes by itself
  bool has_plugin_clock() const { return is_real() && clock != "wall"; }
  // None on the virtual clock and with --tick-budget 0.
  std::optional<Nanoseconds> tick_budget() const;
  // Each call is timed, and not only those of some ticks.
  bool times_each_call() const;
  // The limit of all that waits after the last halt; nothing: none.
  std::optional<Nanoseconds> end_limit() const;
  LoopOptions loop() const;
  KeepOptions kept() const;
};

void define_run_options(CLI::App& app, RunCommandOptions& options);

}  // namespace lockstep::host
