#include "support/json.h"

template class nlohmann::basic_json<>;

namespace lockstep::host::test {

nlohmann::json parse_json(const std::string& text) {
  return nlohmann::json::parse(text);
}

}  // namespace lockstep::host::test
