#include "base/json/reader.h"

#include <fmt/format.h>
#include <simdjson.h>

#include <algorithm>
#include <bit>
#include <new>
#include <type_traits>
#include <utility>

#include "base/core/wording.h"

namespace lockstep::host {
namespace {

namespace ondemand = simdjson::ondemand;

template <class Place>
JsonPlace hidden(const Place& place) {
  return std::bit_cast<JsonPlace>(place);
}
ondemand::value& value_at(JsonPlace& place) {
  static_assert(sizeof(ondemand::value) == sizeof(JsonPlace));
  static_assert(std::is_trivially_copyable_v<ondemand::value>);
  return *std::launder(reinterpret_cast<ondemand::value*>(place.bytes));
}
ondemand::object& object_at(JsonPlace& place) {
  static_assert(sizeof(ondemand::object) == sizeof(JsonPlace));
  static_assert(std::is_trivially_copyable_v<ondemand::object>);
  return *std::launder(reinterpret_cast<ondemand::object*>(place.bytes));
}

// simdjson reads a bit beyond the end of a text. Zeros there are the beginning of no value.
class Padding {
 public:
  explicit Padding(std::string& text) : text_(text), size_(text.size()) {
    text_.resize(size_ + simdjson::SIMDJSON_PADDING);
  }
  ~Padding() { text_.resize(size_); }
  Padding(const Padding&) = delete;
  Padding& operator=(const Padding&) = delete;

  std::size_t size() const { return size_; }

 private:
  std::string& text_;
  const std::size_t size_;
};

// True when there is a value in `result`, false when it is of another type or out of range.
template <class Value>
bool take(simdjson::simdjson_result<Value> result, Value& value) {
  const simdjson::error_code error = std::move(result).get(value);
  if (error == simdjson::INCORRECT_TYPE || error == simdjson::NUMBER_ERROR) return false;
  if (error != simdjson::SUCCESS) throw simdjson::simdjson_error(error);
  return true;
}

ondemand::object root(ondemand::document& document) {
  ondemand::object object;
  const ondemand::json_type type = document.type();
  if (type != ondemand::json_type::object) throw JsonError("expected a JSON object");
  if (const auto error = document.get_object().get(object)) throw simdjson::simdjson_error(error);
  return object;
}

}  // namespace

void JsonValue::fail(std::string_view expected) const {
  throw JsonError(fmt::format("{}'{}' is not {}", of_ == Of::List ? "an item of " : "",
                              brief(name_), expected));
}

bool JsonValue::get(std::string_view& text) {
  return take(value_at(place_).get_string(), text);
}
bool JsonValue::get(bool& flag) {
  return take(value_at(place_).get_bool(), flag);
}
bool JsonValue::get(double& number) {
  return take(value_at(place_).get_double(), number);
}
bool JsonValue::get(std::uint64_t& number) {
  return take(value_at(place_).get_uint64(), number);
}
bool JsonValue::get(std::int64_t& number) {
  return take(value_at(place_).get_int64(), number);
}
bool JsonValue::is_null() {
  bool is_null = false;
  return take(value_at(place_).is_null(), is_null) && is_null;
}
bool JsonValue::is_list() {
  return ondemand::json_type(value_at(place_).type()) == ondemand::json_type::array;
}

std::string_view JsonValue::text() {
  std::string_view text;
  if (!get(text)) fail("a string");
  return text;
}

double JsonValue::number() {
  double number = 0;
  if (!get(number)) fail("a number");
  return number;
}

std::uint64_t JsonValue::whole() {
  std::uint64_t number = 0;
  if (!get(number)) fail(fmt::format("a whole number from 0 to {}", UINT64_MAX));
  return number;
}

JsonObject JsonValue::object() {
  ondemand::object object;
  if (!take(value_at(place_).get_object(), object)) fail("a JSON object");
  return JsonObject(hidden(object));
}

void JsonValue::each_item(void* reader, void (*read)(void* reader, JsonValue item)) {
  ondemand::array list;
  if (!take(value_at(place_).get_array(), list)) fail("a list");
  for (ondemand::value item : list) read(reader, JsonValue(hidden(item), name_, Of::List));
}

std::size_t JsonValue::count_items() {
  if (!is_list()) fail("a list");
  return value_at(place_).count_elements();
}

void JsonValue::skip(unsigned levels) {
  const ondemand::json_type type = value_at(place_).type();
  const bool nests = type == ondemand::json_type::array || type == ondemand::json_type::object;
  if (nests && levels == 0)
    throw JsonError(fmt::format("values are nested deeper than {} levels", kDeepest));
  switch (type) {
    case ondemand::json_type::array:
      return each_item([&](JsonValue item) { item.skip(levels - 1); });
    case ondemand::json_type::object:
      return object().each_field([&](auto, JsonValue value) { value.skip(levels - 1); });
    case ondemand::json_type::string:
      static_cast<void>(std::string_view(value_at(place_).get_string()));
      return;
    case ondemand::json_type::number:
      static_cast<void>(double(value_at(place_).get_double()));
      return;
    case ondemand::json_type::boolean:
      static_cast<void>(bool(value_at(place_).get_bool()));
      return;
    case ondemand::json_type::null:
      if (!is_null()) throw NotJson();
  }
}

void JsonObject::each_field(const std::function<void(std::string_view, JsonValue)>& read) {
  for (auto field : object_at(place_)) {
    const std::string_view name = field.unescaped_key();
    read(name, JsonValue(hidden(ondemand::value(field.value())), name, JsonValue::Of::Field));
  }
}

void JsonObject::read(std::span<const JsonField> fields) {
  std::uint64_t seen = 0;  // a bit for each of the fields
  const auto bit = [&](const JsonField* field) { return 1ull << (field - fields.data()); };
  each_field([&](std::string_view name, JsonValue value) {
    const auto found = std::ranges::find(fields, name, &JsonField::name);
    if (found == fields.end()) return value.skip();
    const JsonField* const field = &*found;
    if ((seen & bit(field)) != 0) throw JsonError(fmt::format("'{}' is given twice", name));
    seen |= bit(field);
    field->read(value);
  });
  for (const JsonField& field : fields) {
    if (!field.may_lack && (seen & bit(&field)) == 0)
      throw JsonError(fmt::format("'{}' is missing", field.name));
  }
}

struct JsonReader::Parser : ondemand::parser {};

JsonReader::JsonReader() : parser_(std::make_unique<Parser>()) {}
JsonReader::~JsonReader() = default;

void JsonReader::read(std::string& text, const std::function<void(JsonObject)>& use) {
  const Padding padding(text);
  try {
    ondemand::document document = parser_->iterate(text.data(), padding.size(), text.size());
    use(JsonObject(hidden(root(document))));
    if (document.current_location().error() != simdjson::OUT_OF_BOUNDS) throw NotJson();
  } catch (const simdjson::simdjson_error& error) {
    if (error.error() == simdjson::MEMALLOC) throw std::bad_alloc();
    throw NotJson();
  }
}

}  // namespace lockstep::host
