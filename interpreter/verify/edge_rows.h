// The edges of a graph, packed: a row of bytes for each state, of its edges by their goals. An edge
// takes a byte or two where goals are near each other. A row may begin with a label of the ticks
// that end the run.
#pragma once

#include <iterator>
#include <optional>

#include "verify/byte_rows.h"
#include "verify/state_store.h"

namespace lockstep::host {

struct Edge {
  StateId to = 0;
  std::uint32_t label = 0;

  friend auto operator<=>(const Edge&, const Edge&) = default;
};

// The edges of one state, read one after the other.
class EdgeRow {
 public:
  class Iterator {
   public:
    using value_type = Edge;
    using difference_type = std::ptrdiff_t;
    Iterator() = default;
    explicit Iterator(std::span<const std::byte> bytes) : bytes_(bytes) { ++*this; }
    const Edge& operator*() const { return edge_; }
    const Edge* operator->() const { return &edge_; }
    Iterator& operator++();
    void operator++(int) { ++*this; }
    bool operator==(std::default_sentinel_t) const { return is_over_; }

   private:
    std::span<const std::byte> bytes_;
    Edge edge_;
    std::uint32_t row_ = 0;  // so many more like this one, each to the next state
    bool is_over_ = false;
  };

  EdgeRow() = default;
  explicit EdgeRow(std::span<const std::byte> row);
  Iterator begin() const { return Iterator(bytes_); }
  static std::default_sentinel_t end() { return {}; }
  std::optional<std::uint32_t> label_of_end() const { return label_of_end_; }

 private:
  std::span<const std::byte> bytes_;
  std::optional<std::uint32_t> label_of_end_;
};

class EdgeRows {
 public:
  // Those of the next state, by their goals.
  void add(std::span<const Edge> edges, std::optional<std::uint32_t> label_of_end = {});
  EdgeRow operator[](StateId state) const { return EdgeRow(rows_[state]); }
  std::size_t states() const { return rows_.size(); }
  std::uint64_t size() const { return size_; }  // edges
  std::size_t memory() const { return rows_.memory(); }

 private:
  ByteRows rows_;
  std::uint64_t size_ = 0;
  std::vector<std::byte> packed_;
};

}  // namespace lockstep::host
