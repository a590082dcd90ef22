#include "show/web/answer.h"

#include "base/json/json.h"

namespace lockstep::host {

WebAnswer refusal(unsigned status, const Problem& problem) {
  Json json = {{"error", problem.message}};
  if (!problem.hint.empty()) json["hint"] = problem.hint;
  return {.status = status, .type = "application/json", .body = json.text() + '\n'};
}

}  // namespace lockstep::host
