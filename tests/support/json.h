// JSON that tests read. What nlohmann's parser is made of is compiled once, in json.cpp: a unit
// that compiles it takes half as long again.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

extern template class nlohmann::basic_json<>;

namespace lockstep::host::test {

// Throws nlohmann::json::parse_error.
nlohmann::json parse_json(const std::string& text);

}  // namespace lockstep::host::test
