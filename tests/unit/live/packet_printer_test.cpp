// From the tick thread's packets to the text of a recording: the ring between the two, and the
// printer. That the text is what docs/recording.md says: recording_test.cpp.
#include "record/live/packet_printer.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <random>
#include <string>
#include <thread>

#include "record/json_lines.h"

namespace lockstep::host {
namespace {

// A packet, what it points to, and what it says.
struct Written {
  std::vector<NodeChange> nodes;
  std::string text, expected;
  PacketHead head;

  Packet packet() const { return {.head = head, .nodes = nodes, .text = text}; }
};

std::size_t below(std::mt19937& random, std::size_t limit) {
  return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random);
}

std::string text_of(const NodeChange& change) {
  return fmt::format("[{},\"{}\",{},{:d},{:d}]", change.node,
                     to_string(status_of(change.activity())), change.progress, change.ticked(),
                     change.activity() == Activity::Paused);
}

NodeChange random_change(std::mt19937& random) {
  NodeChange change;
  change.node = static_cast<NodeIndex>(random());
  const std::size_t status = below(random, kStatuses.size() + 1);
  change.state = static_cast<std::uint8_t>(status < kStatuses.size() ? static_cast<Activity>(status)
                                                                     : Activity::Paused);
  if (below(random, 2) == 0) change.state |= NodeChange::kTicked;
  change.progress = static_cast<double>(below(random, 3)) / 2;
  if (below(random, 2) == 0)
    change.progress = std::ldexp(random(), -static_cast<int>(random() % 99));
  return change;
}

Written random_tick(std::mt19937& random, std::size_t most_nodes) {
  Written it;
  it.head = {.tick = random(), .time = static_cast<std::int64_t>(random()) * 1'000'000'000};
  it.head.is_tick = 1;
  if (below(random, 4) == 0) {
    it.head.lost = 1 + random();
    it.head.lost_from = random();
    it.expected =
        fmt::format("{{\"lost\":{{\"ticks\":{},\"from\":{}}}}}\n", it.head.lost, it.head.lost_from);
  }
  it.expected += fmt::format("{{\"tick\":{},\"time_s\":{}.0,\"nodes\":[", it.head.tick,
                             it.head.time / 1'000'000'000);
  it.nodes.resize(below(random, most_nodes + 1));
  for (NodeChange& change : it.nodes) {
    if (&change != it.nodes.data()) it.expected += ',';
    it.expected += text_of(change = random_change(random));
  }
  it.text = "]" + std::string(below(random, most_nodes), 'x') + "}\n";
  it.expected += it.text;
  return it;
}

// Packets in a ring that is just large enough for them, and has its end somewhere among them.
struct Filled {
  Filled(std::mt19937& random, std::size_t most_nodes) {
    std::size_t size = 0;
    for (int i = 0; i < 5; ++i) {
      all.push_back(random_tick(random, most_nodes));
      size += PacketRing::in_cells(packet_size(all.back().packet()));
      expected += all.back().expected;
    }
    ring.grow(size);
    const std::string text(below(random, size - sizeof(PacketHead)), 'x');
    REQUIRE(ring.push({.text = text}));
    ring.take_until(ring.pushed());
    for (const Written& it : all) REQUIRE(ring.push(it.packet()));
    REQUIRE_FALSE(ring.push({.text = "x"}));
  }

  PacketRing ring{1};
  std::vector<Written> all;
  std::string expected;
};

std::string rest_of(PacketPrinter& printer, std::size_t room) {
  std::vector<char> memory(room);
  std::string all;
  for (auto text = printer.print(memory); !text.empty(); text = printer.print(memory)) {
    CHECK(text.size() <= room);
    all += text;
  }
  return all;
}

TEST_CASE("packets are printed as they were pushed, whatever the room and wherever the ring ends") {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const Filled filled(random, 1 + 40 * (seed % 5));
    for (const std::size_t room :
         {PacketPrinter::kLeastRoom, std::size_t{1000}, std::size_t{1} << 20}) {
      PacketPrinter printer(filled.ring);
      REQUIRE(rest_of(printer, room) == filled.expected);
      CHECK(printer.finished() == filled.ring.pushed());
      CHECK(printer.unfinished_text() == 0);
    }
  }
}

TEST_CASE("a printer goes on where another was, if what that had printed is left out") {
  std::mt19937 random(1);
  Filled filled(random, 100);
  PacketPrinter printer(filled.ring);
  char room[PacketPrinter::kLeastRoom];
  std::size_t printed = 0, restarted = 0;
  for (auto text = printer.print(room); !text.empty(); text = printer.print(room)) {
    printed += text.size();
    filled.ring.take_until(printer.finished());
    PacketPrinter other(filled.ring);
    const std::string rest = rest_of(other, 1000);
    REQUIRE(rest.substr(printer.unfinished_text()) == filled.expected.substr(printed));
    ++restarted;
  }
  CHECK(restarted > 10);
  CHECK(filled.ring.empty());
}

TEST_CASE("a packet is in the ring as a whole or not at all, whenever another thread looks") {
  std::mt19937 random(1);
  std::vector<Written> all;
  std::string expected, printed;
  for (int i = 0; i < 100; ++i) {
    all.push_back(random_tick(random, 300));
    expected += all.back().expected;
  }
  PacketRing ring(20000);
  std::thread tick_thread([&] {
    for (const Written& it : all) {
      // Many are pushed while the other is looking for them, the others while it prints.
      while (it.head.tick % 2 == 0 && !ring.empty()) std::this_thread::yield();
      while (!ring.push(it.packet())) std::this_thread::yield();
    }
  });
  PacketPrinter printer(ring);
  std::vector<char> room(10000);
  while (printed.size() < expected.size()) {
    printed += printer.print(room);
    ring.take_until(printer.finished());
  }
  tick_thread.join();
  CHECK(printed == expected);
}

TEST_CASE("what was written over by others ends the printing") {
  constexpr std::uint64_t kMuch = ~std::uint64_t{0};
  for (const std::uint64_t text : {kMuch, kMuch - 47, std::uint64_t{1000}}) {
    PacketRing ring(200);
    ring.push({.text = "one\n"});
    const std::uint64_t second = ring.pushed();
    ring.push({.text = "two\n"});
    const PacketHead head{.text = text};
    std::memcpy(const_cast<char*>(ring.bytes(second, sizeof head).data()), &head, sizeof head);
    PacketPrinter printer(ring);
    CHECK(rest_of(printer, 1000) == "one\n");
    CHECK(printer.finished() == ring.pushed());
  }
}

}  // namespace
}  // namespace lockstep::host
