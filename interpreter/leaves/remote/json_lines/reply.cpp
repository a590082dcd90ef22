#include "leaves/remote/json_lines/reply.h"

#include <fmt/format.h>

#include "base/core/wording.h"

namespace lockstep::host {
namespace {

lockstep_status status_of(std::string_view word) {
  if (word == "running") return LOCKSTEP_RUNNING;
  if (word == "success") return LOCKSTEP_SUCCESS;
  if (word == "failure") return LOCKSTEP_FAILURE;
  if (word == "skipped") return LOCKSTEP_SKIPPED;
  throw JsonError(fmt::format("the status is '{}', expected running, success, failure or skipped",
                              brief(word)));
}

lockstep_log_level level_of(std::string_view word) {
  if (word == "debug") return LOCKSTEP_LOG_DEBUG;
  if (word == "info") return LOCKSTEP_LOG_INFO;
  if (word == "warning") return LOCKSTEP_LOG_WARNING;
  throw JsonError(fmt::format("the level is '{}', expected debug, info or warning", brief(word)));
}

lockstep_after_cut after_cut_of(std::string_view word) {
  if (word == "starts again") return LOCKSTEP_STARTS_AGAIN;
  if (word == "continues") return LOCKSTEP_CONTINUES;
  if (word == "cannot continue") return LOCKSTEP_CANNOT_CONTINUE;
  throw JsonError(fmt::format(
      "after_cut is '{}', expected 'starts again', 'continues' or 'cannot continue'", brief(word)));
}

void read_fields(JsonObject object, Reply& reply) {
  int kinds = 0;
  const auto is = [&](Reply::What what) {
    reply.what = what;
    ++kinds;
  };
  object.read(
      {{"leaf", into(reply.leaf), kMayLack},
       {"status",
        [&](JsonValue it) {
          reply.status = status_of(it.text());
          is(Reply::What::Status);
        },
        kMayLack},
       {"progress", [&](JsonValue it) { reply.progress = it.number(); }, kMayLack},
       {"reason", into(reply.reason), kMayLack},
       {"kept", [&](JsonValue it) { reply.kept = it.text(); }, kMayLack},
       {"after_cut", [&](JsonValue it) { reply.after_cut = after_cut_of(it.text()); }, kMayLack},
       {"pace",
        [&](JsonValue it) {
          reply.pace = it.number();
          is(Reply::What::Pace);
        },
        kMayLack},
       {"set",
        [&](JsonValue it) {
          reply.sets_ports = true;
          it.skip();
        },
        kMayLack},
       {"done",
        [&](JsonValue it) {
          it.skip();
          is(Reply::What::Done);
        },
        kMayLack},
       {"log",
        [&](JsonValue it) {
          reply.text = it.text();
          is(Reply::What::Log);
        },
        kMayLack},
       {"level", [&](JsonValue it) { reply.level = level_of(it.text()); }, kMayLack},
       {"error",
        [&](JsonValue it) {
          reply.text = it.text();
          if (reply.text.empty()) reply.text = "unknown error";
          is(Reply::What::Error);
        },
        kMayLack}});
  if (kinds == 0 && (reply.progress || reply.kept)) is(Reply::What::Progress);
  if (kinds != 1) {
    throw JsonError(
        "expected one of 'status', 'done', 'pace', 'log' and 'error', or 'progress' or 'kept' "
        "alone");
  }
  if (reply.sets_ports && reply.what != Reply::What::Status) {
    throw JsonError("'set' belongs to a 'status'");
  }
}

}  // namespace

std::string read_reply(JsonReader& reader, std::string& line, Reply& reply) {
  reply.leaf = 0;
  reply.progress.reset();
  reply.reason.clear();
  reply.kept.reset();
  reply.after_cut = LOCKSTEP_STARTS_AGAIN;
  reply.sets_ports = false;
  reply.level = LOCKSTEP_LOG_INFO;
  try {
    reader.read(line, [&](JsonObject object) { read_fields(object, reply); });
  } catch (const JsonError& error) {
    return error.what();
  }
  return {};
}

}  // namespace lockstep::host
