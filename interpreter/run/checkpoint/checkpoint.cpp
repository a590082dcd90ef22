#include "run/checkpoint/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/crc32c.h"
#include "run/checkpoint/archive.h"

namespace lockstep::host {
namespace {

void head_fields(auto& it, Is<Checkpoint> auto& checkpoint) {
  it(checkpoint.kind, checkpoint.resumes, checkpoint.ticks, checkpoint.time, checkpoint.written,
     checkpoint.boot, checkpoint.note, checkpoint.rounds, checkpoint.set, checkpoint.properties);
}

void fact_fields(auto& it, Is<CheckpointFacts> auto& facts) {
  it(facts.identity, facts.nodes, facts.is_leaf);
}

const std::string* find(const CheckpointFacts& facts, const std::string& name) {
  const auto it = std::ranges::find(
      facts.identity, name, [](const auto& fact) -> const auto& { return fact.first; });
  return it == facts.identity.end() ? nullptr : &it->second;
}

}  // namespace

std::vector<Difference> differences(const CheckpointFacts& kept, const CheckpointFacts& now) {
  std::vector<Difference> found;
  for (const auto& [name, value] : kept.identity) {
    const std::string* const other = find(now, name);
    if (other == nullptr || *other != value) {
      found.push_back({name, value, other == nullptr ? "" : *other});
    }
  }
  for (const auto& [name, value] : now.identity) {
    if (find(kept, name) == nullptr) found.push_back({name, "", value});
  }
  return found;
}

std::string text_mark(std::string_view text) {
  return fmt::format("{} bytes, {:08x}", text.size(), crc32c(text));
}

void append_head(const Checkpoint& checkpoint, std::string& to) {
  ByteWriter writer(to);
  head_fields(writer, checkpoint);
}

bool read_checkpoint_bytes(std::string_view bytes, Checkpoint& into) {
  ByteReader reader(bytes);
  head_fields(reader, into);
  if (!reader.is_good() || into.kind > Checkpoint::Kind::Lost) return false;
  into.run = reader.rest();
  return true;
}

void append_facts(const CheckpointFacts& facts, std::string& to) {
  ByteWriter writer(to);
  fact_fields(writer, facts);
}

bool read_facts(std::string_view bytes, CheckpointFacts& into) {
  ByteReader reader(bytes);
  fact_fields(reader, into);
  return reader.is_whole() && into.is_leaf.size() == into.nodes.size();
}

}  // namespace lockstep::host
