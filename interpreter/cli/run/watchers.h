// Those who watch a run from outside, and may control it: browsers, Groot2, and who types at
// breakpoints.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/problem.h"
#include "cli/monitor_link.h"
#include "cli/run/groot.h"
#include "cli/run/prompt.h"
#include "cli/run/run_options.h"
#include "record/live/open_questions.h"
#include "show/web/monitor.h"
#include "tree/definition.h"

namespace lockstep::host {

// Where they come in. Made first, since a port may be taken.
struct WatcherSockets {
  std::optional<ServerSocket> monitor = {};
  std::optional<AttachSocket> attach = {};  // instead of it, or to reach a run that needs people
  std::string own = {};                     // the path of one that no option asks for
  std::optional<std::unique_ptr<GrootListener>> groot = {};
};
Result<WatcherSockets> listen_for_watchers(const RunCommandOptions& options,
                                           const Definition& definition);

// Whether a person at this terminal answers the tree, or attends.
bool has_typist(const RunCommandOptions& options, const Shape& shape);

class Watchers {
 public:
  // `print` shows a line to the person; from any thread. `note` records it, too; on the tick
  // thread.
  using Print = std::function<void(const std::string& line)>;
  Watchers(const Shape& shape, const RunCommandOptions& options, const RunDescription& run,
           WatcherSockets sockets, const PausePlaces& places, Print print, Print note);

  // Says where the monitor is, before the run starts.
  void tell();
  // The orders that the watchers may give; null if they may give none.
  RunControl* control() { return control_ ? &*control_ : nullptr; }
  // Passes on a line that a leaf has logged. May be called from any thread.
  void log(std::string_view who, std::string_view level, std::string_view text);
  void add_to(std::vector<Observer*>& observers);
  // After all that the run prints: see --monitor-linger.
  void linger();

 private:
  // Tells that the run stands because nobody attends.
  class Attendance final : public Observer {
   public:
    Attendance(const RunControl& control, double longest, Print note)
        : control_(control), longest_(longest), note_(std::move(note)) {}
    void standing(const Moment& moment) override;
    void before_tick(const Moment& moment, std::uint64_t tick, Nanoseconds time) override;

   private:
    const RunControl& control_;
    const double longest_;
    const Print note_;
    bool is_alone_ = false;
  };

  void tell_vain_answers(const Print& note);
  Result<std::string> answer_request(const std::string& request);
  std::string list_questions() const;

  const Shape& shape_;
  const RunCommandOptions& options_;
  std::optional<RunControl> control_;
  std::optional<OpenQuestions> questions_;
  std::optional<Attendance> attendance_;
  const std::string own_socket_;
  std::string opened_;               // the link of the monitor, if it is open from the beginning
  std::optional<MonitorLink> link_;  // used by the thread of the monitor
  std::optional<Monitor> monitor_;
  std::unique_ptr<Observer> groot_;
  std::optional<Prompt> prompt_;
};

}  // namespace lockstep::host
