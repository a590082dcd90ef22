// What fits into a file of MCAP; what tools read from one is tested from outside.
#include "recording/use/mcap_file.h"

#include <catch2/catch.hpp>
#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace lockstep::host {
namespace {

TEST_CASE("a file of MCAP has up to 65 536 channels") {
  std::size_t bytes = 0;
  const ExportSink sink = [&](std::string_view more) {
    bytes += more.size();
    return true;
  };
  McapFile file("test", sink);
  const std::uint16_t schema = file.add_schema("Number", "{}");
  std::uint16_t last = 0;
  for (std::uint32_t i = 0; i <= UINT16_MAX; ++i) last = file.add_channel(schema, "/number");
  CHECK(last == UINT16_MAX);
  file.add(last, 1, "{}");
  CHECK(file.finish());
  CHECK(bytes > 0);
  CHECK_THROWS_AS(file.add_channel(schema, "/one_more"), std::runtime_error);
}

}  // namespace
}  // namespace lockstep::host
