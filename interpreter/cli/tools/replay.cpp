#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "base/terminal/terminal.h"
#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/monitor_link.h"
#include "cli/tools/log/log.h"
#include "cli/tools/replay_session.h"
#include "run/stop_signals.h"
#include "show/view/replay/replay_view.h"
#include "show/web/page_server.h"

namespace lockstep::host {
namespace {

struct ReplayOptions {
  std::string file;
  std::optional<std::uint64_t> at;
  TickRange range;  // what is played
  double speed = 1;
  bool print = false;
  std::optional<std::string> monitor;  // where a page is served; none: there is none
  bool opens_browser = false;
};

int no_such_tick(std::uint64_t tick, std::uint64_t first, std::uint64_t last) {
  print_error(fmt::format("--at {}: the recording has ticks {} to {}", tick, first, last));
  return kExitUsage;
}

int before_first(std::uint64_t tick, std::uint64_t first) {
  print_error(fmt::format("--at {}: this part of the recording begins with tick {}", tick, first));
  return kExitUsage;
}

int no_ticks() {
  print_error("the recording has no tick to show");
  return kExitUsage;
}

// The tick that was asked for, else the last before it. Reads no more than is needed.
struct Search {
  TimelineTick found;
  std::uint64_t ticks = 0, last = 0;
};

Search search(RecordingReader& reader, std::optional<std::uint64_t> at) {
  Search search;
  reader.skip_to(at.value_or(UINT64_MAX));
  std::uint64_t expected = reader.header().first_tick;
  if (at && *at < expected) return search;
  while (const auto tick = reader.next()) {
    if (search.ticks++ == 0) expected = tick->whole ? tick->tick : expected;
    search.last = tick->tick;
    if (at && tick->tick > *at) break;
    take(*tick, tick->tick - expected, search.found);
    expected = tick->tick + 1;
  }
  return search;
}

int print_tick(const ReplayOptions& options, RecordingReader& reader) {
  const Search found = search(reader, options.at);
  const std::uint64_t first = reader.header().first_tick;
  if (options.at && *options.at < first) return before_first(*options.at, first);
  const int code = report_end(reader);
  if (found.ticks == 0) return code == kExitSuccess ? no_ticks() : code;
  if (options.at && *options.at > found.last)
    return code == kExitSuccess ? no_such_tick(*options.at, first, found.last) : code;
  const TimelineTick& moment = found.found;
  if (options.at && moment.tick != *options.at) {
    print_error(fmt::format("tick {} is not in the recording: {} is the last before it",
                            *options.at, moment.tick));
  }
  constexpr unsigned kUnlimited = 1'000'000;
  const bool ended = moment.tick == found.last && reader.end();
  const std::string text =
      draw_moment(reader.header(),
                  snapshot_of(reader.header(), moment, ended ? &*reader.end() : nullptr), moment,
                  {.width = kUnlimited,
                   .height = kUnlimited,
                   .color = wants_color(results_file()),
                   .unicode = has_unicode()});
  return first_failure(code, write_results(text));
}

int play(const ReplayOptions& options, RecordingReader& reader) {
  const RecordingHeader& header = reader.header();
  write_results("reading ...");  // what is large takes seconds
  RecordingTimeline timeline(reader, {.range = options.range});
  write_results("\r\x1b[K");
  const RecordingOutcome& outcome = timeline.outcome();
  if (timeline.size() == 0) {
    const int code =
        options.range.is_all() ? report_end(outcome) : report_end(reader, options.range);
    return code == kExitSuccess ? no_ticks() : code;
  }
  if (options.at) {
    if (*options.at < timeline.first_tick() || *options.at > timeline.last_tick()) {
      const int code = report_end(outcome);
      no_such_tick(*options.at, timeline.first_tick(), timeline.last_tick());
      return code == kExitSuccess ? kExitUsage : code;
    }
    timeline.go_to_tick(*options.at);
  }
  const int code = play_on_terminal(header, timeline, options.speed);
  const int read = report_end(outcome);
  return code == kExitSuccess ? read : code;
}

int serve(const ReplayOptions& options) {
  auto socket = listen_for_monitor(*options.monitor);
  if (!socket) return refuse(socket.error());
  if (!socket->is_loopback) {
    print_error(fmt::format("--monitor: '{}' can be reached from other machines", *options.monitor),
                "lockstep log page FILE --out PAGE.html makes a page that can be sent there");
    return kExitUsage;
  }
  return with_file(options.file, [&](std::istream& in) {
    std::string page;
    const auto keep = [&page](std::string_view part) { return !page.append(part).empty(); };
    if (const int code = make_page(in, options.file, options.range, keep); code != kExitSuccess)
      return code;
    PageServer server(std::move(page), std::move(*socket));
    StopSignals::install();
    MonitorLink link(options.file);
    link.tell(server.link(), options.opens_browser);
    server.serve_until([] { return StopSignals::received() != 0; });
    return kExitSignal + StopSignals::received();
  });
}

int replay(const ReplayOptions& options) {
  if (options.monitor) return serve(options);
  return with_recording(options.file, [&](RecordingReader& reader) {
    const bool interactive = !options.print && options.file != "-" && is_terminal(STDIN_FILENO) &&
                             is_terminal(results_file()) && can_draw();
    if (interactive) return play(options, reader);
    if (!options.range.is_all()) {
      return usage_error("--from and --to are for a terminal or --monitor: --at prints one tick");
    }
    return print_tick(options, reader);
  });
}

std::function<int()> define_replay(CLI::App& app) {
  const auto options = std::make_shared<ReplayOptions>();
  add_recording_file(app, options->file);
  app.add_option("--at", options->at, "Begin at this tick; without a terminal: print it")
      ->type_name("TICK")
      ->transform(whole_number());
  add_tick_range(app, options->range);
  app.add_option("--speed", options->speed, "1: as recorded; 0.1: ten times as slow")
      ->type_name("X")
      ->check(number_between(ReplayPlayer::kSlowest, ReplayPlayer::kFastest))
      ->capture_default_str();
  app.add_option(
         "--monitor", options->monitor,
         "Show the recording in a browser (default: 127.0.0.1 and a free port), until Ctrl-C; "
         "the link is on stderr")
      ->type_name("[ADDRESS:PORT]");
  app.add_flag("--monitor-open", options->opens_browser,
               "With --monitor: open the page in the browser");
  app.add_flag("--print", options->print, "Print one tick and exit, even on a terminal");
  return [options] { return replay(*options); };
}

}  // namespace

extern const Command kReplayCommand{
    "replay", "Watch a run again, from its recording",
    "On a terminal the recording plays as the live view of the run did. Keys:\n"
    "  space           pause, continue\n"
    "  right, n        one tick forward\n"
    "  left, p         one tick back\n"
    "  g TICK enter    go to that tick\n"
    "  home, end       go to the first, the last tick\n"
    "  + -             twice, half the speed\n"
    "  up, down        scroll; also page up, page down\n"
    "  f, F            fold the node at the cursor or unfold it; unfold all\n"
    "  escape          follow the running nodes again\n"
    "  q, Ctrl-C       quit\n"
    "Otherwise, and with --print, the tree as of one tick is printed to stdout: that of\n"
    "--at, otherwise the last.\n"
    "Exit code: 0 read, 2 usage or a file that cannot be read, 3 not a recording or a damaged "
    "one,\n"
    "130 Ctrl-C.\n"
    "\n"
    "Examples:\n"
    "  lockstep replay run.jsonl\n"
    "  lockstep replay run.jsonl --at 400 --speed 0.1\n"
    "  lockstep replay run.jsonl --at 400 --print\n"
    "  lockstep replay shift.jsonl.zst --from 1800000 --to 1860000\n"
    "  lockstep replay run.jsonl --monitor",
    define_replay};

}  // namespace lockstep::host
