// Any bytes as what clients of Groot2's protocol ask: each gets an answer or an error, breakpoints
// are those of nodes that exist, and without them the run goes on. The first byte says where the
// bytes are cut in two parts of a message.
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "engine/compile.h"
#include "groot/answers.h"
#include "require.h"
#include "run/loading/plugins.h"
#include "run/observers.h"
#include "run/run.h"
#include "run/shape_of.h"
#include "tree/resolve.h"

namespace fuzz_groot_target {
namespace {

using namespace lockstep::host;
using fuzz::require;

// A run that never ends, and who answers about it.
class Answered {
 public:
  Answered() : Answered(definition()) {}

  GrootMessage ask(const GrootMessage& request) {
    const GrootMessage reply = answers_.answer(request);
    control_.take_orders(run_.ticker(), run_.blackboard());
    return reply;
  }
  void tick() {
    control_.take_orders(run_.ticker(), run_.blackboard());
    if (control_.is_paused()) return;
    run_.set_now(now_ += std::chrono::milliseconds(10));
    const Status status = run_.tick(now_);
    observers_.after_tick(run_.ticker(), {.tick = ticks_++, .time = now_, .status = status});
    control_.count_tick(run_.ticker());
    control_.report_standing(control_.is_paused());
  }
  std::uint64_t ticks() const { return ticks_; }

 private:
  explicit Answered(const Definition& definition)
      : tree_(compile(definition)), shown_(*groot_tree(definition)) {}

  static Definition definition() {
    static Diagnostics diagnostics;
    static const auto project = load_project_text(
        "fuzz.xml",
        "<root lockstep=\"1\"><BehaviorTree ID=\"B\"><Repeat><Sequence memory=\"true\">"
        "<Wait seconds=\"{pause}\"/><Script code=\"n := 1\"/></Sequence></Repeat></BehaviorTree>"
        "</root>",
        {}, diagnostics);
    ResolveOptions options;
    options.values["pause"] = "0.02";
    auto definition = resolve(*project, make_catalog({}), options, diagnostics);
    require(definition.has_value());
    return std::move(*definition);
  }

  const Tree tree_;
  const GrootTree shown_;
  Run run_{tree_, {}};
  RunControl control_;
  StatusFeed statuses_{shape_of(tree_)};
  SnapshotFeed snapshots_{shape_of(tree_)};
  Observer* const both_[2] = {&statuses_, &snapshots_};
  Observers observers_{tree_, both_};
  GrootAnswers answers_{shape_of(tree_), shown_, statuses_, snapshots_, &control_};
  Nanoseconds now_{0};
  std::uint64_t ticks_ = 0;
};

const std::string kRemoveAll(
    "\x02"
    "A\0\0\0\0",
    6);

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Answered it;
  if (size == 0 || size > 64u << 10) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::size_t cut = std::min<std::size_t>(data[0], bytes.size());
  GrootMessage request{std::string(bytes.substr(0, cut))};
  if (cut < bytes.size()) request.emplace_back(bytes.substr(cut));
  const GrootMessage reply = it.ask(request);
  const bool is_error = reply.front() == "error";
  require(is_error ? reply.size() == 2 : reply.front().size() == 22 && reply.size() <= 2);
  if (!is_error) require(reply.front().substr(1, 5) == request.front().substr(1));
  for (int i = 0; i < 4; ++i) it.tick();
  require(it.ask({kRemoveAll}).front().size() == 22);
  const std::uint64_t ticks = it.ticks();
  it.tick();
  require(it.ticks() == ticks + 1);
  return 0;
}

}  // namespace fuzz_groot_target
