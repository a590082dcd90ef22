// Bytes that come in pieces, whoever they are for.
#pragma once

#include <cstddef>
#include <span>

namespace lockstep::host {

class Stream {
 public:
  virtual ~Stream() = default;
  // It goes on until the client leaves.
  virtual bool is_endless() const = 0;
  struct Piece {
    enum class What { Bytes, Wait, End };
    What what;
    std::size_t count = 0;
  };
  // Wait: there is nothing now, and whoever reads asks again when there may be more.
  virtual Piece read(std::span<char> to) = 0;
};

}  // namespace lockstep::host
