#include "groot/answers.h"

#include <chrono>
#include <utility>

namespace lockstep::host {

GrootAnswers::GrootAnswers(const Shape& shape, GrootTree shown, StatusFeed& statuses,
                           SnapshotFeed& snapshots, RunControl* control)
    : document_(std::move(shown.document)),
      boards_(shape, std::move(shown.boards)),
      status_feed_(statuses),
      snapshots_(snapshots),
      statuses_(shown.order),
      hooks_(shape.nodes[0].end, control),
      has_control_(control != nullptr) {}

GrootMessage GrootAnswers::answer(const GrootMessage& request) {
  status_feed_.take([&](NodeIndex node, Status status, Nanoseconds time) {
    statuses_.change(node, status, time);
  });
  snapshots_.take();
  const auto header = request.empty() ? std::nullopt : read_groot_header(request.front());
  if (!header) return groot_error("expected a header of 6 bytes");
  return answer(*header, request);
}

GrootMessage GrootAnswers::answer(GrootHeader header, const GrootMessage& request) {
  const bool has_value = request.size() == 2;
  const GrootMessage no_value = groot_error("expected a second part");
  std::string begin = reply_header(header, id_);
  switch (header.request) {
    case GrootRequest::FullTree:
      return {std::move(begin), document_};
    case GrootRequest::Status:
      return {std::move(begin), statuses_.bytes()};
    case GrootRequest::Blackboard:
      if (!has_value) return no_value;
      return {std::move(begin), boards_.dump(request[1], snapshots_.newest())};
    case GrootRequest::ToggleRecording:
      return has_value ? toggle_recording(request[1], std::move(begin)) : no_value;
    case GrootRequest::GetTransitions:
      return {std::move(begin), statuses_.take_transitions()};
    case GrootRequest::InsertHooks:
    case GrootRequest::RemoveHook:
    case GrootRequest::Unlock:
      return has_value ? change_hooks(header.request, request[1], std::move(begin)) : no_value;
    case GrootRequest::RemoveAllHooks:
      hooks_.remove_all();
      return {std::move(begin)};
    case GrootRequest::DisableAllHooks:
      hooks_.disable_all();
      return {std::move(begin)};
    case GrootRequest::DumpHooks:
      return {std::move(begin), hooks_.dump()};
    default:
      return groot_error("unknown request");
  }
}

GrootMessage GrootAnswers::change_hooks(GrootRequest what, const std::string& json,
                                        std::string header) {
  if (!has_control_) {
    return groot_error("this run can only be watched: start it with --groot2-control");
  }
  const std::string problem = what == GrootRequest::InsertHooks  ? hooks_.insert(json)
                              : what == GrootRequest::RemoveHook ? hooks_.remove(json)
                                                                 : hooks_.unlock(json);
  if (!problem.empty()) return groot_error(problem);
  return {std::move(header)};
}

GrootMessage GrootAnswers::toggle_recording(std::string_view word, std::string header) {
  if (word == "stop") {
    statuses_.stop_recording();
    return {std::move(header)};
  }
  if (word != "start") return groot_error("expected 'start' or 'stop'");
  statuses_.start_recording(snapshots_.newest().header.time);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto since = std::chrono::duration_cast<std::chrono::microseconds>(now);
  return {std::move(header), std::to_string(since.count())};
}

}  // namespace lockstep::host
