// The functions that the host offers to plugins.
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstring>

#include "leaves/plugin/contract/host.h"
#include "lockstep/leaf.h"

namespace lockstep::host {
namespace {

using Function = void (*)();

TEST_CASE("host: each function of the table is there") {
  constexpr std::size_t kBegin = offsetof(lockstep_host, get_bool);
  const auto* const table = reinterpret_cast<const char*>(&host_table());
  for (std::size_t at = kBegin; at < sizeof(lockstep_host); at += sizeof(Function)) {
    Function function = nullptr;
    std::memcpy(&function, table + at, sizeof function);
    INFO("at byte " << at << " of lockstep_host");
    CHECK(function != nullptr);
  }
}

}  // namespace
}  // namespace lockstep::host
