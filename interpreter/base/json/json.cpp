#include "base/json/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/core/utf8.h"

namespace lockstep::host {
namespace {

using Scalar = nlohmann::json;

std::string dumped(const Scalar& value) {
  return value.dump(-1, ' ', false, Scalar::error_handler_t::replace);
}

// Eight letters at a time, each in a byte of `letters`: a byte's high bit is set in the result for
// one that is not plain, and maybe for one above it (S. E. Anderson, "Bit Twiddling Hacks").
[[gnu::always_inline]] inline std::uint64_t not_plain(std::uint64_t letters) {
  constexpr std::uint64_t kOnes = ~std::uint64_t{0} / 255, kHigh = kOnes * 0x80;
  const auto less = [](std::uint64_t bytes, std::uint64_t than) {
    return (bytes - kOnes * than) & ~bytes;
  };
  const auto is = [&](char letter) {
    return less(letters ^ (kOnes * static_cast<unsigned char>(letter)), 1);
  };
  return (letters | less(letters, ' ') | is('\x7F') | is('"') | is('\\')) & kHigh;
}

// Each letter from ' ' to '~' but '"' and '\\'.
bool is_plain(std::string_view text) {
  constexpr std::size_t kBlock = sizeof(std::uint64_t);
  std::uint64_t letters = 0;
  for (; text.size() >= kBlock; text.remove_prefix(kBlock)) {
    std::memcpy(&letters, text.data(), kBlock);
    if (not_plain(letters) != 0) return false;
  }
  letters = ~std::uint64_t{0} / 255 * ' ';
  std::memcpy(&letters, text.data(), text.size());
  return not_plain(letters) == 0;
}

// As a terminal that shows it would not obey it.
std::string escaped(std::string_view json) {
  constexpr char32_t kDelete = 0x7F;  // below it all is escaped already; '\n' is our own
  std::string out;
  while (!json.empty()) {
    const auto [length, code] = first_character(json);
    const auto character = json.substr(0, std::max<std::size_t>(length, 1));
    if (code >= kDelete && is_obeyed_by_terminals(code)) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(code));
    } else {
      out += character;
    }
    json.remove_prefix(character.size());
  }
  return out;
}

// Items between brackets, on separate lines if there is an indent.
template <class Items, class Add>
void add_items(std::string& text, std::string_view brackets, const Items& items, std::size_t indent,
               std::size_t depth, Add add) {
  text += brackets[0];
  const auto new_line = [&](std::size_t level) {
    if (indent > 0) (text += '\n').append(indent * level, ' ');
  };
  for (auto item = items.begin(); item != items.end(); ++item) {
    if (item != items.begin()) text += ',';
    new_line(depth + 1);
    add(*item);
  }
  if (!items.empty()) new_line(depth);
  text += brackets[1];
}

}  // namespace

Json::Json(std::initializer_list<JsonMember> members) {
  Members& own = value_.emplace<Members>();
  own.reserve(members.size());
  for (const JsonMember& it : members) own.emplace_back(it.name, std::move(it.value));
}

Json Json::array(std::vector<Json> items) {
  Json json;
  json.value_ = std::move(items);
  return json;
}

Json Json::object() {
  return Json(std::initializer_list<JsonMember>{});
}

Json& Json::operator[](std::string_view name) {
  auto& members = std::get<Members>(value_);
  const auto found = std::ranges::find(members, name, &Members::value_type::first);
  return found != members.end() ? found->second : members.emplace_back(name, Json()).second;
}

void Json::add(std::string name, Json value) {
  std::get<Members>(value_).emplace_back(std::move(name), std::move(value));
}

void Json::push_back(Json item) {
  std::get<List>(value_).push_back(std::move(item));
}

Json& Json::back() {
  return std::get<List>(value_).back();
}

std::string Json::text(std::size_t indent) const {
  std::string text;
  add_text(text, indent, 0);
  return text;
}

std::string Json::printable(std::size_t indent) const {
  return escaped(text(indent));
}

void Json::add_text(std::string& text, std::size_t indent, std::size_t depth) const {
  if (const auto* words = std::get_if<std::string>(&value_)) {
    append_json(text, *words);
  } else if (const auto* list = std::get_if<List>(&value_)) {
    add_items(text, "[]", *list, indent, depth,
              [&](const Json& item) { item.add_text(text, indent, depth + 1); });
  } else if (const auto* members = std::get_if<Members>(&value_)) {
    add_items(text, "{}", *members, indent, depth, [&](const auto& member) {
      append_json(text, member.first);
      text += indent > 0 ? ": " : ":";
      member.second.add_text(text, indent, depth + 1);
    });
  } else if (const auto* number = std::get_if<double>(&value_)) {
    append_json(text, *number);
  } else if (const auto* whole = std::get_if<std::int64_t>(&value_)) {
    text += std::to_string(*whole);
  } else if (const auto* natural = std::get_if<std::uint64_t>(&value_)) {
    text += std::to_string(*natural);
  } else if (const auto* flag = std::get_if<bool>(&value_)) {
    text += *flag ? "true" : "false";
  } else {
    text += "null";
  }
}

void append_json(std::string& to, std::string_view text) {
  if (is_plain(text)) {
    ((to += '"') += text) += '"';
  } else {
    to += dumped(text);
  }
}

void append_json(std::string& to, double number) {
  if (number == 1) {
    to += "1.0";
  } else if (number == 0 && !std::signbit(number)) {
    to += "0.0";
  } else {
    to += dumped(number);
  }
}

}  // namespace lockstep::host
