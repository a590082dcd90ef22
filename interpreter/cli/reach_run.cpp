#include "cli/reach_run.h"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <optional>

#include "base/core/value.h"
#include "base/json/reader.h"
#include "show/web/registry.h"

namespace lockstep::host {

std::vector<ReachableRun> reachable_runs(const std::string& run) {
  if (!run.empty() && !parse_int(run)) return {{run, run}};
  std::vector<ReachableRun> found;
  for (const RegisteredRun& it : registered_runs()) {
    const std::string process = std::to_string(it.process);
    if (!it.socket.empty() && (run.empty() || run == process))
      found.push_back({it.socket, process});
  }
  return found;
}

std::string AnsweredQuestion::request() const {
  return fmt::format(R"({{"do":"answered","node":{},"tick":{}}})", node, tick);
}

std::optional<AnsweredQuestion> answered_question(const std::string& request) {
  if (!request.starts_with(R"({"do":"answered",)")) return std::nullopt;
  AnsweredQuestion question;
  std::string text = request, what;
  std::uint64_t node = 0;
  try {
    JsonReader().read(text, [&](JsonObject object) {
      object.read({{"do", into(what)}, {"node", into(node)}, {"tick", into(question.tick)}});
    });
  } catch (const JsonError&) {
    return std::nullopt;
  }
  question.node = static_cast<std::uint32_t>(node);
  return question;
}

std::string user_name() {
  const passwd* const user = getpwuid(geteuid());
  return user != nullptr ? user->pw_name : std::to_string(geteuid());
}

}  // namespace lockstep::host
