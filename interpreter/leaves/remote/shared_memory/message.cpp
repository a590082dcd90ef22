#include "leaves/remote/shared_memory/message.h"

#include <algorithm>
#include <utility>

#include "base/core/value_types.h"
#include "leaves/plugin/contract/held.h"

namespace lockstep::host {

void MessageWriter::append(const void* data, std::size_t size) {
  const auto* first = static_cast<const std::byte*>(data);
  bytes_.insert(bytes_.end(), first, first + size);
}

void MessageWriter::put_text(std::string_view text) {
  put(std::uint64_t{text.size()});
  append(text.data(), text.size());
}

void MessageWriter::put_text_or_null(const char* text) {
  put(static_cast<std::uint8_t>(text != nullptr));
  if (text != nullptr) put_text(text);
}

namespace {

class ValueWriter {
 public:
  explicit ValueWriter(MessageWriter& message) : message_(message) {}

  void operator()(const NoValue& /*none*/) const {}
  void operator()(const Object& object) const {
    const PackedObject& packed = PackedType::get(object);
    message_.put_text(packed.bytes);
    message_.put_text(packed.text);
  }
  void operator()(bool flag) const { message_.put(static_cast<std::uint8_t>(flag)); }
  void operator()(Flag flag) const { (*this)(flag.is_set); }
  template <IsNumber Number>
  void operator()(Number number) const {
    message_.put(number);
  }
  void operator()(const std::string& text) const { message_.put_text(text); }
  template <class T>
  void operator()(const std::vector<T>& list) const {
    message_.put(std::uint64_t{list.size()});
    if constexpr (IsNumber<T>) {  // copied together; not every byte is a bool
      message_.append(list.data(), list.size() * sizeof(T));
    } else {
      for (const T& item : list) (*this)(item);
    }
  }

 private:
  MessageWriter& message_;
};

// True if there was a value.
class ValueReader {
 public:
  ValueReader(MessageReader& message, const PackedType* objects)
      : message_(message), objects_(objects) {}

  bool operator()(NoValue&) const { return true; }
  bool operator()(Object& object) const {
    const std::string_view bytes = message_.text();
    const std::string_view text = message_.text();
    if (objects_ == nullptr || !message_.good()) return false;
    object = objects_->make({std::string(bytes), std::string(text)});
    return true;
  }
  bool operator()(bool& flag) const {
    flag = message_.get<std::uint8_t>() != 0;
    return message_.good();
  }
  bool operator()(Flag& flag) const { return (*this)(flag.is_set); }
  template <IsNumber Number>
  bool operator()(Number& number) const {
    number = message_.get<Number>();
    return message_.good();
  }
  bool operator()(std::string& text) const {
    text.assign(message_.text());
    return message_.good();
  }
  template <class T>
  bool operator()(std::vector<T>& list) const {
    // The bytes of an item, at least: a text has its size.
    constexpr std::size_t kLeast = std::is_same_v<T, std::string> ? 8 : sizeof(T);
    const auto count = message_.get<std::uint64_t>();
    if (!message_.good() || count > message_.rest().size() / kLeast) return false;
    list.resize(count);
    if constexpr (IsNumber<T>) {
      const std::byte* const data = message_.take(count * sizeof(T));
      if (count != 0) std::memcpy(list.data(), data, count * sizeof(T));
      return true;
    } else {
      return std::ranges::all_of(list, [this](T& item) { return (*this)(item); });
    }
  }

 private:
  MessageReader& message_;
  const PackedType* objects_;
};

}  // namespace

void MessageWriter::put_value(const Value& value) {
  put(static_cast<std::uint8_t>(value.index()));
  std::visit(ValueWriter(*this), value);
}

bool MessageReader::fail() {
  good_ = false;
  rest_ = {};
  return false;
}

const std::byte* MessageReader::take(std::size_t size) {
  if (size > rest_.size()) {
    fail();
    return nullptr;
  }
  const std::byte* const data = rest_.data();
  rest_ = rest_.subspan(size);
  return data;
}

std::string_view MessageReader::text() {
  const auto size = get<std::uint64_t>();
  const std::byte* const data = take(size);
  return data == nullptr ? std::string_view{}
                         : std::string_view(reinterpret_cast<const char*>(data), size);
}

bool MessageReader::has_text() {
  return get<std::uint8_t>() != 0;
}

bool MessageReader::value_into(Value& value, const PackedType* objects) {
  const auto index = get<std::uint8_t>();
  if (!good_) return false;
  const ValueReader read(*this, objects);
  const bool is_read =
      index < std::variant_size_v<Value> &&
      with_alternative(index, [&]<class T>(std::type_identity<T>) { return read(held<T>(value)); });
  return is_read || fail();
}

}  // namespace lockstep::host
