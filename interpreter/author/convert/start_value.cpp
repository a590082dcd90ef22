#include "author/convert/start_value.h"

#include "tree/types/literal.h"

namespace lockstep::host {

ConvertedStart start_to_theirs(std::string_view text, const EntryTypes::Found& entry) {
  const ValueType by_itself = literal_type(text);
  const auto flag = by_itself == ValueType::String ? parse_flag(text) : std::nullopt;
  ConvertedStart same{.text = std::string(text)};
  if (flag && entry.type == ValueType::Bool) same.text = *flag ? "1" : "0";
  if (entry.has_port) return same;
  const bool is_text = entry.type == ValueType::String || (!flag && by_itself == ValueType::String);
  if (!is_text && entry.has_switch && entry.has_script) {
    same.difference =
        "a Switch there makes it a text, to which no script can assign a number: let a Script "
        "write the value";
    return same;
  }
  if (flag && !entry.type && (entry.has_script || !entry.is_open)) {
    same.difference =
        "unless a port has another type, it is a text there and a bool in lockstep's language: "
        "write 1 or 0 if it is a bool";
  } else if (by_itself == ValueType::Int && entry.type == ValueType::Double) {
    same.text += ".0";
  } else if (by_itself != ValueType::String && entry.type == ValueType::String) {
    same.difference =
        "it is a number there and a text in lockstep's language, where a script "
        "assigns a text to the entry: let a Script write the value";
  }
  return same;
}

}  // namespace lockstep::host
