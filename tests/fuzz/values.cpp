// Any text as a value of each type: what parses is written as text that parses to the same value.
// As the barriers of a tree: what is accepted rises and lies in [0, 1].
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "base/core/value.h"
#include "engine/compile.h"
#include "require.h"
#include "run/loading/plugins.h"
#include "tree/resolve.h"

namespace fuzz_values_target {
namespace {

using namespace lockstep::host;
using fuzz::require;

bool is_finite(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return std::isfinite(*number);
  if (const auto* list = std::get_if<std::vector<double>>(&value)) {
    for (const double number : *list) {
      if (!std::isfinite(number)) return false;
    }
  }
  return true;
}

double as_double(const Value& number) {
  const auto* whole = std::get_if<std::int64_t>(&number);
  return whole != nullptr ? static_cast<double>(*whole) : std::get<double>(number);
}

// "2.0" as an int or a double is a double; its text, "2", is an int.
bool is_same(ValueType type, const Value& value, const std::optional<Value>& again) {
  if (type != ValueType::Number) return again == value;
  return again && as_double(*again) == as_double(value);
}

void check_values(std::string_view text) {
  for (const ValueType type : all_value_types()) {
    const auto value = parse_value(type, text);
    if (!value) continue;
    require(holds(*value, type) && is_finite(*value));
    require(is_same(type, *value, parse_value(type, to_text(*value))));
  }
}

// Every byte as XML can say it; those that it cannot are left out.
std::string attribute(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 || c == '\t' || c == '\n' || c == '\r') out += fmt::format("&#{};", byte);
  }
  return out;
}

void check_barriers(std::string_view text) {
  const std::string file = fmt::format(
      "<root lockstep=\"1\"><BehaviorTree ID=\"A\"><ParallelAbsolute barriers=\"{}\">"
      "<AlwaysSuccess/></ParallelAbsolute></BehaviorTree></root>",
      attribute(text));
  Diagnostics diagnostics;
  const auto project = load_project_text("/nowhere/tree.xml", file, {}, diagnostics);
  require(project != nullptr);
  const auto definition = resolve(*project, make_catalog({}), {}, diagnostics);
  require(definition.has_value() != diagnostics.has_errors());
  if (!definition) return;
  double before = -1;
  for (const double barrier : compile(*definition).numbers) {
    require(barrier >= 0 && barrier > before && barrier <= 1);
    before = barrier;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  check_values(text);
  check_barriers(text);
  return 0;
}

}  // namespace fuzz_values_target
