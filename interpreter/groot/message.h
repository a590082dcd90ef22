// The messages of Groot2's protocol, as bytes. Each has parts; the first is a header. Numbers are
// little-endian.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep::host {

using GrootMessage = std::vector<std::string>;

// The second byte of a header.
enum class GrootRequest : char {
  FullTree = 'T',
  Status = 'S',
  Blackboard = 'B',
  InsertHooks = 'I',
  RemoveHook = 'R',
  BreakpointReached = 'N',  // published, not asked
  Unlock = 'U',
  DumpHooks = 'D',
  RemoveAllHooks = 'A',
  DisableAllHooks = 'X',
  ToggleRecording = 'r',
  GetTransitions = 't',
};

struct GrootHeader {
  GrootRequest request;
  std::uint32_t id;  // which a reply repeats
};

// Nothing: it is not one.
std::optional<GrootHeader> read_groot_header(std::string_view bytes);
std::string to_bytes(GrootHeader header);

// The tree of a run: Groot2 asks for the document again when it sees another one.
using GrootTreeId = std::array<char, 16>;
GrootTreeId make_groot_tree_id();  // random

std::string reply_header(GrootHeader request, const GrootTreeId& tree);
GrootMessage groot_error(std::string text);

// Appends `count` bytes of a number.
void append_number(std::string& to, std::uint64_t number, unsigned count);

}  // namespace lockstep::host
