// Builds JSON values and prints them. Members keep their order. The only file that uses nlohmann's
// library, whose headers take seconds to compile.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/core/value.h"

namespace lockstep::host {

struct JsonMember;

class Json {
 public:
  Json() = default;  // null
  Json(std::nullptr_t) {}
  Json(bool flag) : value_(flag) {}
  template <std::integral T>
  requires(!std::same_as<T, bool>) Json(T number)
      : value_(std::conditional_t<std::is_signed_v<T>, std::int64_t, std::uint64_t>{number}) {}
  Json(double number) : value_(number) {}  // null unless finite
  Json(std::string text) : value_(std::move(text)) {}
  Json(std::string_view text) : value_(std::string(text)) {}
  Json(const char* text) : value_(std::string(text)) {}
  template <class T>
  Json(const std::vector<T>& items) : value_(List(items.begin(), items.end())) {}
  template <class T>
  Json(const std::optional<T>& value) : Json(value ? Json(*value) : Json()) {}
  Json(const std::map<std::string, std::string>& members)
      : value_(Members(members.begin(), members.end())) {}
  Json(std::initializer_list<JsonMember> members);  // an object

  static Json array(std::vector<Json> items = {});
  static Json object();

  Json& operator[](std::string_view name);  // of an object; a new one is null
  void add(std::string name, Json value);   // to an object that has no such member
  void push_back(Json item);                // to an array
  Json& back();                             // of an array

  using Members = std::vector<std::pair<std::string, Json>>;
  const Members& members() const { return std::get<Members>(value_); }  // of an object

  // Invalid UTF-8 is replaced. With an indent of spaces per level: on several lines.
  std::string text(std::size_t indent = 0) const;
  // The same for terminals: characters that control one are escaped, so values do not change.
  std::string printable(std::size_t indent = 0) const;
  // The same value as MessagePack, in bytes; members are sorted.
  std::string message_pack() const;

 private:
  using List = std::vector<Json>;
  void add_text(std::string& text, std::size_t indent, std::size_t depth) const;

  std::variant<NoValue, bool, std::int64_t, std::uint64_t, double, std::string, List, Members>
      value_;
};

struct JsonMember {
  std::string_view name;
  mutable Json value;  // moved from
};

// Adds a text with its quotes. Allocates nothing where `to` has room, if nothing must be escaped.
void append_json(std::string& to, std::string_view text);
void append_json(std::string& to, double number);

}  // namespace lockstep::host
