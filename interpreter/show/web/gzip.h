// Compression that browsers undo.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

namespace lockstep::host {

// Compresses bytes as they come, and keeps little of them. The same bytes give the same result,
// whatever their pieces were.
class Gzip {
 public:
  using Sink = std::function<void(std::string_view)>;

  explicit Gzip(Sink sink);
  ~Gzip();

  void add(std::string_view bytes);
  // No bytes follow. Then the sink has the whole result.
  void finish();

 private:
  struct State;

  void compress(std::string_view bytes, bool is_end);

  const Sink sink_;
  const std::unique_ptr<State> state_;
};

}  // namespace lockstep::host
