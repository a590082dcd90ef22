// Types of objects whose functions do what they should not.
#include "leaves/plugin/contract/object_type.h"

#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "base/core/object.h"
#include "base/system/call_mark.h"

namespace lockstep::host::test {
namespace {

std::string g_seen;  // the function that the thread was marked to be in

void note() {
  const CallMark::Look look = CallMark::this_thread().look();
  g_seen =
      std::string(look.site->origin->kind) + " " + look.site->text() + " " + name_of(look.function);
}

void ignore(void* /*object*/) {}
std::size_t text_of(const void* /*object*/, char* text, std::size_t size) {
  note();
  const std::string whole(1000, 't');
  whole.copy(text, size);
  return whole.size();
}
void* no_object(const void* /*bytes*/, std::size_t /*length*/) {
  note();
  return nullptr;
}

lockstep_object_type declared(decltype(lockstep_object_type::to_bytes) to_bytes,
                              decltype(lockstep_object_type::from_bytes) from_bytes = no_object) {
  lockstep_object_type type{};
  type.struct_size = sizeof type;
  type.name = "test.Map";
  type.retain = type.release = ignore;
  type.to_text = text_of;
  type.to_bytes = to_bytes;
  type.from_bytes = from_bytes;
  return type;
}

std::string bytes_or_error(const lockstep_object_type& type) {
  const auto bytes = (*read_object_type(&type, "maps"))->to_bytes(nullptr);
  return bytes ? *bytes : bytes.error().message;
}

TEST_CASE("object type: bytes of any length up to the limit") {
  static const auto kLong = declared([](const void*, void* bytes, std::size_t size) {
    const std::string whole(100'000, 'm');
    whole.copy(static_cast<char*>(bytes), size);
    return whole.size();
  });
  CHECK(bytes_or_error(kLong) == std::string(100'000, 'm'));
  static const auto kEmpty =
      declared([](const void*, void*, std::size_t) { return std::size_t{0}; });
  CHECK(bytes_or_error(kEmpty).empty());
}

TEST_CASE("object type: lengths that are none are errors") {
  static const auto kFails = declared([](const void*, void*, std::size_t) { return SIZE_MAX; });
  CHECK(bytes_or_error(kFails) == "to_bytes of 'test.Map' has failed");
  static const auto kHuge = declared([](const void*, void*, std::size_t) { return SIZE_MAX - 1; });
  CHECK(
      bytes_or_error(kHuge) ==
      "to_bytes of 'test.Map' has 18446744073709551614 bytes, at most 64 MiB can leave a process");
  static const auto kGrows =
      declared([](const void*, void*, std::size_t size) { return size + 1; });
  CHECK(bytes_or_error(kGrows) ==
        "to_bytes of 'test.Map' has 4098 bytes, after 4097 a moment before");
  static const auto kThrows = declared(
      [](const void*, void*, std::size_t) -> std::size_t { throw std::runtime_error("torn"); });
  CHECK(bytes_or_error(kThrows) == "to_bytes of 'test.Map' threw an exception: torn");
}

TEST_CASE("object type: bytes that are no object are an error") {
  static const auto kRefuses = declared([](const void*, void*, std::size_t) { return SIZE_MAX; });
  const auto none = (*read_object_type(&kRefuses, "maps"))->from_bytes("abc");
  REQUIRE_FALSE(none);
  CHECK(none.error().message == "from_bytes of 'test.Map' finds no object in 3 bytes");
  static const auto kThrows = declared(kRefuses.to_bytes, [](const void*, std::size_t) -> void* {
    throw std::runtime_error("old");
  });
  const auto thrown = (*read_object_type(&kThrows, "maps"))->from_bytes("abc");
  REQUIRE_FALSE(thrown);
  CHECK(thrown.error().message == "from_bytes of 'test.Map' threw an exception: old");
}

// So a crash or a hang there has a name.
TEST_CASE("object type: its functions are marked calls") {
  static const auto kType = declared([](const void*, void*, std::size_t) { return SIZE_MAX; });
  const ObjectType& type = **read_object_type(&kType, "maps");
  std::string text = "text: ";
  type.append_text(nullptr, text);
  CHECK(text == "text: " + std::string(1000, 't'));
  CHECK(g_seen == "object type 'test.Map' (of plugin 'maps') to_text");
  CHECK_FALSE(type.from_bytes("abc"));
  CHECK(g_seen == "object type 'test.Map' (of plugin 'maps') from_bytes");
  CHECK(CallMark::this_thread().look().function == PluginFunction::None);
}

TEST_CASE("object type: a declaration from before to_bytes has none") {
  static auto kOld = declared([](const void*, void*, std::size_t) { return SIZE_MAX; });
  kOld.struct_size = offsetof(lockstep_object_type, to_bytes);
  CHECK_FALSE((*read_object_type(&kOld, "maps"))->has_bytes());
}

}  // namespace
}  // namespace lockstep::host::test
