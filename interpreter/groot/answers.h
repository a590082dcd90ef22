// Answers what Groot2 asks. For one thread, which takes what the tick thread passes on.
#pragma once

#include <string>
#include <string_view>

#include "groot/boards.h"
#include "groot/hooks.h"
#include "groot/message.h"
#include "groot/statuses.h"
#include "groot/tree.h"
#include "record/live/snapshot_feed.h"
#include "record/live/status_feed.h"

namespace lockstep::host {

class GrootAnswers {
 public:
  GrootAnswers(const Shape& shape, GrootTree shown, StatusFeed& statuses, SnapshotFeed& snapshots,
               RunControl* control);

  // Whatever the request is.
  GrootMessage answer(const GrootMessage& request);
  GrootHooks& hooks() { return hooks_; }

 private:
  GrootMessage answer(GrootHeader header, const GrootMessage& request);
  GrootMessage change_hooks(GrootRequest what, const std::string& json, std::string header);
  GrootMessage toggle_recording(std::string_view word, std::string header);

  const GrootTreeId id_ = make_groot_tree_id();
  const std::string document_;
  const GrootBoards boards_;
  StatusFeed& status_feed_;
  SnapshotFeed& snapshots_;
  GrootStatuses statuses_;
  GrootHooks hooks_;
  const bool has_control_;
};

}  // namespace lockstep::host
