#include "verify/edge_merger.h"

#include <algorithm>

namespace lockstep::host {

void EdgeMerger::add(const Chunk& chunk, std::size_t first, std::size_t last,
                     std::span<const StateId> numbers, std::optional<std::uint32_t> label_of_end) {
  const LabelTable& own = expanders_[chunk.thread]->labels();
  edges_.assign(chunk.edges.begin() + static_cast<std::ptrdiff_t>(first),
                chunk.edges.begin() + static_cast<std::ptrdiff_t>(last));
  for (Edge& it : edges_) {
    if ((it.to & Chunk::kFresh) != 0) it.to = numbers[it.to & ~Chunk::kFresh];
  }
  // By the bits, since each thread has its own numbers of labels.
  std::ranges::sort(edges_, [&](const Edge& a, const Edge& b) {
    if (a.to != b.to) return a.to < b.to;
    return a.label != b.label &&
           std::ranges::lexicographical_compare(own.packed(a.label), own.packed(b.label));
  });
  for (Edge& it : edges_) it.label = label_of(chunk, it.label);
  if (label_of_end) label_of_end = label_of(chunk, *label_of_end);
  graph_.edges.add(edges_, label_of_end);
}

std::uint32_t EdgeMerger::label_of(const Chunk& chunk, std::uint32_t own_number) {
  const LabelTable& own = expanders_[chunk.thread]->labels();
  std::vector<std::uint32_t>& numbers = labels_[chunk.thread];
  if (numbers.size() < own.size()) numbers.resize(own.size(), kNoState);
  std::uint32_t& label = numbers[own_number];
  if (label == kNoState) label = graph_.labels.add(own.packed(own_number));
  return label;
}

std::size_t EdgeMerger::memory() const {
  std::size_t bytes = edges_.capacity() * sizeof edges_[0];
  for (const auto& it : labels_) bytes += it.capacity() * sizeof it[0];
  return bytes;
}

}  // namespace lockstep::host
