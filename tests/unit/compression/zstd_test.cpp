// Compressed texts: what is written comes back, from every place, and of a cut file all whole
// pieces.
#include <algorithm>
#include <catch2/catch.hpp>
#include <istream>
#include <random>
#include <sstream>

#include "base/compression/decompressed.h"
#include "base/compression/zstd_frames.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kPiece = 64u << 10;

// Lines as a recording has them: much is repeated, some is not.
std::string some_text(std::mt19937& random, std::size_t size) {
  std::string text;
  while (text.size() < size) {
    text += "{\"tick\":" + std::to_string(random()) + ",\"nodes\":[[1,\"running\",0.5,1,0]]}\n";
  }
  text.resize(size);
  return text;
}

struct Piece {
  std::size_t text = 0, file = 0;  // where it ends
};

struct Compressed {
  std::string text, file;
  std::vector<Piece> pieces;

  void add(std::string_view piece, std::string_view bytes) {
    text += piece;
    file += bytes;
    pieces.push_back({text.size(), file.size()});
  }
};

// A megabyte, in pieces of all sizes.
Compressed some_file(unsigned seed) {
  std::mt19937 random(seed);
  ZstdFrames frames(kPiece);
  Compressed result;
  while (result.text.size() < (1u << 20)) {
    const std::string piece = some_text(random, 1 + random() % kPiece);
    result.add(piece, frames.add(piece));
    if (random() % 8 == 0) result.file += frames.end();
  }
  result.file += frames.end();
  return result;
}

std::string read_all(std::istream& in) {
  std::string text;
  char part[5000];
  while (in.read(part, sizeof part) || in.gcount() > 0) {
    text.append(part, static_cast<std::size_t>(in.gcount()));
  }
  return text;
}

std::string decompressed(const std::string& file) {
  std::istringstream in(file);
  Decompressed text(*in.rdbuf());
  std::istream read(&text);
  return read_all(read);
}

TEST_CASE("zstd: what was written is read, in much less space") {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Compressed it = some_file(seed);
    CHECK(decompressed(it.file) == it.text);
    CHECK(it.file.size() < it.text.size() / 3);
  }
}

TEST_CASE("zstd: a file that is not compressed is read as it is") {
  for (const std::string text : {"", "x", "(\xB5", "{\"lockstep_recording\":1}\n"}) {
    CHECK(decompressed(text) == text);
  }
  std::mt19937 random(1);
  const std::string text = some_text(random, 300'000);
  CHECK(decompressed(text) == text);
}

TEST_CASE("zstd: wherever a file is cut, all pieces before are read") {
  const Compressed it = some_file(7);
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    const std::size_t cut = 4 + random() % (it.file.size() - 4);
    const std::string text = decompressed(it.file.substr(0, cut));
    std::size_t whole = 0;
    for (const Piece& piece : it.pieces) {
      if (piece.file <= cut) whole = piece.text;
    }
    INFO("cut after byte " << cut);
    CHECK(text.size() >= whole);
    CHECK(it.text.starts_with(text));
  }
}

TEST_CASE("zstd: reading goes on at any earlier place") {
  for (const bool is_plain : {false, true}) {
    const Compressed it = some_file(3);
    std::istringstream in(is_plain ? it.text : it.file);
    Decompressed text(*in.rdbuf());
    std::istream read(&text);
    REQUIRE(read_all(read) == it.text);
    std::mt19937 random(3);
    for (int i = 0; i < 100; ++i) {
      const std::size_t place = random() % it.text.size();
      read.clear();
      REQUIRE(read.seekg(static_cast<std::streamoff>(place)));
      CHECK(static_cast<std::size_t>(read.tellg()) == place);
      std::string part(100, '\0');
      read.read(part.data(), 100);
      part.resize(static_cast<std::size_t>(read.gcount()));
      CHECK(part == it.text.substr(place, 100));
    }
  }
}

// A file that counts what is read of it.
class Counted final : public std::stringbuf {
 public:
  using std::stringbuf::stringbuf;
  std::size_t read = 0;

 private:
  std::streamsize xsgetn(char* to, std::streamsize count) override {
    const std::streamsize got = std::stringbuf::xsgetn(to, count);
    read += static_cast<std::size_t>(got);
    return got;
  }
};

TEST_CASE("zstd: with a table a place is found without reading what is before it") {
  std::mt19937 random(4);
  ZstdFrames frames(kPiece);
  Compressed it;
  while (it.text.size() < (8u << 20)) {
    const std::string piece = some_text(random, kPiece);
    it.add(piece, frames.add(piece));
    frames.make_room();
  }
  it.file += frames.end();
  for (const bool has_table : {true, false}) {
    Counted file(has_table ? it.file + frames.table() : it.file);
    Decompressed text(file);
    std::istream read(&text);
    REQUIRE(read.seekg(0, std::ios_base::end));
    CHECK(static_cast<std::size_t>(read.tellg()) == it.text.size());
    const std::size_t place = it.text.size() / 2;
    REQUIRE(read.seekg(static_cast<std::streamoff>(place)));
    std::string part(100, '\0');
    read.read(part.data(), 100);
    CHECK(part == it.text.substr(place, 100));
    CHECK((file.read < it.file.size() / 4) == has_table);
  }
}

TEST_CASE("zstd: what is damaged is an error, or other text, and never more") {
  const Compressed it = some_file(5);
  std::mt19937 random(5);
  int errors = 0;
  for (int i = 0; i < 200; ++i) {
    std::string file = it.file;
    file[4 + random() % (file.size() - 4)] ^= static_cast<char>(1 + random() % 255);
    std::istringstream in(file);
    Decompressed text(*in.rdbuf());
    std::istream read(&text);
    read.exceptions(std::ios_base::badbit);
    try {
      const std::size_t size = read_all(read).size();
      CHECK(size < 4 * it.text.size());
    } catch (const CannotDecompress& damage) {
      ++errors;
      CHECK(std::string(damage.what()).starts_with("its compressed bytes "));
    }
  }
  CHECK(errors > 20);
}

TEST_CASE("zstd: each flipped bit is found, or the text is the same") {
  std::mt19937 random(6);
  for (const bool crashes : {false, true}) {
    ZstdFrames frames(kPiece);
    std::string text = some_text(random, 300), file{frames.add(text)};
    const std::string more = some_text(random, 200);
    file += frames.add(more);
    text += more;
    if (crashes) file += frames.end();
    const std::string last = some_text(random, 300);
    file += frames.add(last);
    text += last;
    file += frames.end();
    file += frames.table();
    for (std::size_t bit = 0; bit < 8 * file.size(); ++bit) {
      std::string bad = file;
      bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << bit % 8));
      std::istringstream in(bad);
      Decompressed buffer(*in.rdbuf());
      std::istream read(&buffer);
      read.exceptions(std::ios_base::badbit);
      if (bit < 32) continue;  // it is a plain text
      try {
        const std::string got = read_all(read);
        INFO(bit);
        CHECK(got == text);
      } catch (const CannotDecompress&) {
      }
    }
  }
}

TEST_CASE("zstd: a file that needs much memory is refused") {
  // A frame whose window is 1 GiB: RFC 8878, 3.1.1.1.2.
  const std::string file("\x28\xB5\x2F\xFD\x00\xA0\x01\x00\x00", 9);
  std::istringstream in(file);
  Decompressed text(*in.rdbuf());
  std::istream read(&text);
  read.exceptions(std::ios_base::badbit);
  CHECK_THROWS_AS(read_all(read), CannotDecompress);
}

}  // namespace
}  // namespace lockstep::host
