// Reads untrusted JSON in one pass, without building a tree. Every value is checked, even if no one
// reads it. A text needs at most six times its size in memory, whatever its content. Only the
// source of this file sees simdjson.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep::host {

// The text does not have the expected content: "'seed' is missing".
struct JsonError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
// It is not JSON, or its end is missing.
struct NotJson : JsonError {
  NotJson() : JsonError("not JSON") {}
};

class JsonObject;

// Room for a place in a text, as simdjson has it.
struct JsonPlace {
  alignas(void*) std::byte bytes[24];
};

// Must be read once, before the next value of its object or list.
class JsonValue {
 public:
  static constexpr unsigned kDeepest = 64;  // levels of nested lists and objects that are skipped

  enum class Of : bool { Field, List };
  // `name` is that of the field, or of the list.
  JsonValue(const JsonPlace& place, std::string_view name, Of of)
      : place_(place), name_(name), of_(of) {}

  // False if the value has another type; then the caller may ask for that type. Strings are valid
  // until the whole text has been read.
  bool get(std::string_view& text);
  bool get(double& number);
  bool get(std::uint64_t& number);
  bool get(std::int64_t& number);
  bool get(bool& flag);
  bool is_null();
  bool is_list();

  // The same, but throws a JsonError that names the value.
  std::string_view text();
  double number();
  std::uint64_t whole();  // below 2^64
  JsonObject object();
  std::size_t count_items();
  template <class Read>
  void each_item(Read read) {
    each_item(&read, [](void* reader, JsonValue item) { (*static_cast<Read*>(reader))(item); });
  }

  // Only checks it.
  void skip() { skip(kDeepest); }

 private:
  void each_item(void* reader, void (*read)(void* reader, JsonValue item));
  void skip(unsigned levels);
  [[noreturn]] void fail(std::string_view expected) const;

  JsonPlace place_;
  std::string_view name_;
  Of of_;
};

constexpr bool kMayLack = true;

// How one field of an object is read.
struct JsonField {
  std::string_view name;
  std::function<void(JsonValue)> read;
  bool may_lack = false;
};

class JsonObject {
 public:
  explicit JsonObject(const JsonPlace& place) : place_(place) {}

  // Reads these fields, in whatever order they come, and skips all others.
  void read(std::span<const JsonField> fields);
  void read(std::initializer_list<JsonField> fields) {
    read(std::span(fields.begin(), fields.size()));
  }
  void each_field(const std::function<void(std::string_view name, JsonValue)>& read);

 private:
  JsonPlace place_;
};

class JsonReader {
 public:
  JsonReader();
  ~JsonReader();
  JsonReader(const JsonReader&) = delete;
  JsonReader& operator=(const JsonReader&) = delete;

  // Reads an object that is the whole of `text`, which is the same again afterwards.
  void read(std::string& text, const std::function<void(JsonObject)>& use);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

// For JsonField: stores the value.
inline auto into(std::string& text) {
  return [&text](JsonValue value) { text = value.text(); };
}
inline auto into(std::vector<std::string>& texts) {
  return [&texts](JsonValue value) {
    texts.reserve(value.count_items());
    value.each_item([&](JsonValue item) { texts.emplace_back(item.text()); });
  };
}
inline auto into(double& number) {
  return [&number](JsonValue value) { number = value.number(); };
}
inline auto into(std::uint64_t& number) {
  return [&number](JsonValue value) { number = value.whole(); };
}

}  // namespace lockstep::host
