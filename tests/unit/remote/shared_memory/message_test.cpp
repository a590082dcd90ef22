// What is written is what is read; and bytes that nobody wrote are refused, never trusted.
#include "leaves/remote/shared_memory/message.h"
#include "leaves/remote/shared_memory/remote_entries.h"

#include <catch2/catch.hpp>
#include <limits>

#include "base/core/random.h"

namespace lockstep::host::test {
namespace {

const std::vector<Value> kValues{Value(),
                                 Value(true),
                                 Value(false),
                                 Value(std::int64_t{-7}),
                                 Value(0.1),
                                 Value(std::string()),
                                 Value(std::string("a\0b", 3)),
                                 Value(std::vector<double>{}),
                                 Value(std::vector<double>{1, -2.5}),
                                 Value(std::vector<std::int64_t>{1, -2}),
                                 Value(std::vector<Flag>{{true}, {false}}),
                                 Value(std::vector<std::string>{"a", "", "b;"})};

MessageWriter written() {
  MessageWriter message;
  for (const Value& value : kValues) message.put_value(value);
  return message;
}

// The values up to the first that is none.
std::vector<Value> read_values(std::span<const std::byte> bytes, std::size_t at_most) {
  MessageReader message(bytes);
  std::vector<Value> values;
  Value value;
  while (values.size() < at_most && message.value_into(value)) values.push_back(value);
  return values;
}

TEST_CASE("message: values are read as they were written") {
  const MessageWriter message = written();
  CHECK((read_values(message.bytes(), 100) == kValues));
}

TEST_CASE("message: texts may be absent") {
  MessageWriter message;
  message.put_text_or_null(nullptr);
  message.put_text_or_null("");
  message.put_text_or_null("text");
  MessageReader reader(message.bytes());
  CHECK_FALSE(reader.has_text());
  CHECK((reader.has_text() && reader.text().empty()));
  CHECK((reader.has_text() && reader.text() == "text"));
  CHECK((reader.good() && reader.rest().empty()));
}

TEST_CASE("message: wherever it is cut, what is missing is missed") {
  const MessageWriter message = written();
  for (std::size_t size = 0; size < message.bytes().size(); ++size) {
    const auto values = read_values(message.bytes().first(size), kValues.size());
    CHECK(values.size() < kValues.size());
  }
}

TEST_CASE(
    "message: whether an entry takes a number that is not finite is not for the message to say") {
  for (const double number :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    MessageWriter message;
    message.put_value(Value(number));
    CHECK(read_values(message.bytes(), 1).size() == 1);
    message.clear();
    message.put_value(Value(std::vector<double>{0, number}));
    CHECK(read_values(message.bytes(), 1).size() == 1);
  }
}

TEST_CASE("entries of another process: only a loose one takes a number that is not finite") {
  for (const Typing typing : {Typing::Strict, Typing::Declared}) {
    Entry entry(typing, ValueType::Double);
    RemoteEntries entries;
    BoundPort port;
    port.read = &entry.value();
    port.write = &entry;
    port.type = ValueType::Double;
    MessageWriter message;
    message.put(entries.number_of(port));
    message.put_value(Value(std::numeric_limits<double>::infinity()));
    message.put(RemoteEntries::kNone);
    MessageReader reader(message.bytes());
    std::string refused;
    CHECK(entries.read(reader, refused) == (typing == Typing::Declared));
    CHECK(entry.has_value() == (typing == Typing::Declared));
  }
}

TEST_CASE("message: sizes beyond the message are not believed") {
  for (const auto type : {4, 5, 6, 7, 8}) {
    for (const std::uint64_t size : {std::uint64_t{9}, std::uint64_t{1} << 61, ~std::uint64_t{0}}) {
      MessageWriter message;
      message.put(static_cast<std::uint8_t>(type));
      message.put(size);
      message.put(std::uint64_t{0});
      CHECK(read_values(message.bytes(), 1).empty());
    }
  }
}

TEST_CASE("message: an object is its bytes and its text, where objects are expected") {
  const PackedType& type = PackedType::of("test.Path");
  MessageWriter message;
  message.put_value(Value(type.make({std::string("a\0b", 3), "a to b"})));
  Value value;
  REQUIRE(MessageReader(message.bytes()).value_into(value, &type));
  const auto& object = std::get<Object>(value);
  CHECK((object.type()->name() == "test.Path" && to_text(value) == "a to b"));
  CHECK(PackedType::get(object).bytes == std::string("a\0b", 3));
  CHECK_FALSE(MessageReader(message.bytes()).value_into(value));
  for (std::size_t size = 0; size < message.bytes().size(); ++size) {
    CHECK_FALSE(MessageReader(message.bytes().first(size)).value_into(value, &type));
  }
}

TEST_CASE("message: damaged bytes give values or nothing, never harm") {
  RandomStream random(1, 1);
  const MessageWriter message = written();
  std::size_t refused = 0;
  for (int round = 0; round < 20000; ++round) {
    std::vector<std::byte> bytes(message.bytes().begin(), message.bytes().end());
    bytes[random.next() % bytes.size()] = static_cast<std::byte>(random.next());
    if (read_values(bytes, kValues.size()).size() < kValues.size()) ++refused;
  }
  CHECK(refused > 100);
}

}  // namespace
}  // namespace lockstep::host::test
