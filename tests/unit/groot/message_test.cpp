// The bytes of Groot2's protocol.
#include "groot/message.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "groot/statuses.h"

namespace lockstep::host {
namespace {

using namespace std::string_literals;

TEST_CASE("a header is protocol, request and id, and a reply adds the tree") {
  const auto header = read_groot_header("\x02T\x04\x03\x02\xff"s);
  REQUIRE(header);
  CHECK(header->request == GrootRequest::FullTree);
  CHECK(header->id == 0xff020304);
  CHECK(to_bytes(*header) == "\x02T\x04\x03\x02\xff"s);
  GrootTreeId tree{};
  tree.fill('u');
  CHECK(reply_header(*header, tree) == "\x02T\x04\x03\x02\xff"s + std::string(16, 'u'));
  CHECK_FALSE(read_groot_header("\x02T\x04\x03\x02"));
  CHECK_FALSE(read_groot_header("\x02T\x04\x03\x02\x01\x01"));
  CHECK_FALSE(read_groot_header(""));
}

TEST_CASE("the name of a tree is random, and says so") {
  const GrootTreeId one = make_groot_tree_id(), other = make_groot_tree_id();
  CHECK(one != other);
  CHECK((one[6] & 0xf0) == 0x40);
  CHECK((static_cast<unsigned char>(one[8]) & 0xc0) == 0x80);
}

TEST_CASE("an idle node says what it was before") {
  const NodeIndex order[] = {0, 1};
  GrootStatuses it(order);
  CHECK(it.bytes() == "\x01\0\0\x02\0\0"s);
  it.change(1, Status::Running, Nanoseconds(0));
  it.change(0, Status::Skipped, Nanoseconds(0));
  CHECK(it.bytes() == "\x01\0\x04\x02\0\x01"s);
  it.change(1, Status::Idle, Nanoseconds(0));
  it.change(0, Status::Idle, Nanoseconds(0));
  CHECK(it.bytes() == "\x01\0\x0e\x02\0\x0b"s);
  it.change(1, Status::Failure, Nanoseconds(0));
  it.change(1, Status::Idle, Nanoseconds(0));
  it.change(1, Status::Idle, Nanoseconds(0));
  it.change(2, Status::Running, Nanoseconds(0));  // a group
  CHECK(it.bytes() == "\x01\0\x0e\x02\0\x0d"s);
}

TEST_CASE("nodes come in the order of the document") {
  const NodeIndex order[] = {0, 3, 1, 2};
  GrootStatuses it(order);
  it.change(1, Status::Running, Nanoseconds(0));
  CHECK(it.bytes() == "\x01\0\0\x04\0\0\x02\0\x01\x03\0\0"s);
}

TEST_CASE("uids have two bytes") {
  std::vector<NodeIndex> order(kMostGrootNodes);
  std::iota(order.begin(), order.end(), 0u);
  const GrootStatuses it(order);
  CHECK(it.bytes().size() == 3 * kMostGrootNodes);
  CHECK(it.bytes().substr(3 * 255, 3) == "\x00\x01\x00"s);
  CHECK(it.bytes().substr(3 * (kMostGrootNodes - 1)) == "\xff\xff\x00"s);
}

TEST_CASE("a recording has the last changes, each with its time since it was started") {
  const NodeIndex order[] = {0, 1};
  GrootStatuses it(order);
  it.change(0, Status::Running, std::chrono::seconds(1));
  it.start_recording(std::chrono::seconds(2));
  it.change(1, Status::Running, std::chrono::microseconds(2'000'259));
  it.change(1, Status::Running, std::chrono::seconds(3));  // held: no other status
  it.change(1, Status::Idle, std::chrono::seconds(1));     // never before the start
  CHECK(it.take_transitions() == "\x03\x01\0\0\0\0\x02\0\x01\0\0\0\0\0\0\x02\0\0"s);
  CHECK(it.take_transitions().empty());
  for (int i = 0; i < 2000; ++i) {
    it.change(0, i % 2 == 0 ? Status::Success : Status::Failure, std::chrono::microseconds(i));
  }
  CHECK(it.take_transitions().size() == 9 * GrootStatuses::kMostTransitions);
  it.stop_recording();
  it.change(0, Status::Idle, std::chrono::seconds(4));
  CHECK(it.take_transitions().empty());
}

}  // namespace
}  // namespace lockstep::host
