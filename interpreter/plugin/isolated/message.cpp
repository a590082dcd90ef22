#include "plugin/isolated/message.h"

#include <algorithm>
#include <cmath>

#include "plugin/held.h"

namespace lockstep {

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

void MessageWriter::put_value(const Value& value) {
  put(static_cast<std::uint8_t>(value.index()));
  if (const auto* flag = std::get_if<bool>(&value)) put(static_cast<std::uint8_t>(*flag));
  if (const auto* whole = std::get_if<std::int64_t>(&value)) put(*whole);
  if (const auto* number = std::get_if<double>(&value)) put(*number);
  if (const auto* text = std::get_if<std::string>(&value)) put_text(*text);
  if (const auto* list = std::get_if<std::vector<double>>(&value)) {
    put(std::uint64_t{list->size()});
    append(list->data(), list->size() * sizeof(double));
  }
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

bool MessageReader::value_into(Value& value) {
  const auto index = get<std::uint8_t>();
  if (!good_) return false;
  if (index == 0) {
    value.emplace<NoValue>();
    return true;
  }
  switch (static_cast<ValueType>(index - 1)) {
    case ValueType::Bool:
      value.emplace<bool>(get<std::uint8_t>() != 0);
      return good_;
    case ValueType::Int:
      value.emplace<std::int64_t>(get<std::int64_t>());
      return good_;
    case ValueType::Double: {
      const double number = value.emplace<double>(get<double>());
      return (good_ && std::isfinite(number)) || fail();
    }
    case ValueType::String:
      held<std::string>(value).assign(text());
      return good_;
    case ValueType::DoubleList: {
      const auto count = get<std::uint64_t>();
      if (count > rest_.size() / sizeof(double)) return fail();
      auto& list = held<std::vector<double>>(value);
      list.resize(count);
      const std::byte* const data = take(count * sizeof(double));
      if (count != 0) std::memcpy(list.data(), data, count * sizeof(double));
      const bool finite = std::ranges::all_of(list, [](double it) { return std::isfinite(it); });
      return (good_ && finite) || fail();
    }
  }
  return fail();
}

}  // namespace lockstep
