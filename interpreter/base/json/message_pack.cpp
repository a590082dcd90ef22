#include <nlohmann/json.hpp>

#include "base/json/json.h"

namespace lockstep::host {

std::string Json::message_pack() const {
  std::string bytes;
  nlohmann::json::to_msgpack(nlohmann::json::parse(text()), bytes);
  return bytes;
}

}  // namespace lockstep::host
