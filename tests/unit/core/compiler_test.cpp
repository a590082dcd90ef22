// What the build protects from: built with -O2, as for users, whatever the other tests are built
// with.
#include <catch2/catch.hpp>
#include <optional>
#include <stdexcept>

namespace lockstep::host {
namespace {

struct Large {
  std::size_t parts[8];
};

class Source {
 public:
  // Nothing after an error.
  [[gnu::noinline]] std::optional<Large> next() {
    while (!has_failed_) {
      std::optional<Large> found;
      guarded([&] { found = read(); });
      if (found) return found;
    }
    return std::nullopt;
  }

 private:
  [[gnu::noinline]] std::optional<Large> read() {
    if (++calls_ > 0) throw std::runtime_error("damaged");
    return Large{};
  }
  template <class Read>
  void guarded(Read read) {
    try {
      read();
    } catch (const std::runtime_error&) {
      fail();
    }
  }
  [[gnu::noinline]] void fail() { has_failed_ = true; }

  int calls_ = 0;
  bool has_failed_ = false;
};

// So that what has no beginning is not zero.
[[gnu::noinline]] void fill_stack() {
  volatile char bytes[4096];
  for (volatile char& byte : bytes) byte = 1;
}

TEST_CASE("compiler: what a call that throws would have assigned keeps its value") {
  Source source;
  fill_stack();
  CHECK_FALSE(source.next().has_value());
}

}  // namespace
}  // namespace lockstep::host
