// Any text as two arguments and an attribute that uses them, separated by 0x1F: the attribute after
// substitution is what a slow and obvious substitution makes of it, or there are errors.
#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>

#include "language/document/project.h"
#include "require.h"

namespace fuzz_arguments_target {
namespace {

using namespace lockstep::host;
using fuzz::require;

// As XML can say it: other control characters are left out.
std::string clean(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) out += c;
  }
  return out;
}

std::string escape(std::string_view text) {
  std::string out;
  for (const char c : text) out += fmt::format("&#{};", static_cast<int>(c));
  return out;
}

std::string take_part(std::string_view& text) {
  const auto end = std::min(text.find('\x1f'), text.size());
  const auto part = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return clean(part);
}

// Of 'a' and, where it is known, 'b'; nothing: an error.
std::optional<std::string> substituted(const std::string& text, const std::string& a,
                                       const std::optional<std::string>& b) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto rest = std::string_view(text).substr(i);
    if (rest.starts_with("$${")) {
      out += "${";
      i += 2;
    } else if (rest.starts_with("${a}") || (b && rest.starts_with("${b}"))) {
      out += rest[2] == 'a' ? a : *b;
      i += 3;
    } else if (rest.starts_with("${")) {
      return std::nullopt;
    } else {
      out += text[i];
    }
  }
  return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  const std::string a = take_part(rest);  // given, so it is not looked into again
  const std::string b = take_part(rest);  // the default of an <arg>, which may use 'a'
  const std::string used = clean(rest);
  const std::string file = fmt::format(
      "<root lockstep=\"1\"><arg name=\"a\"/><arg name=\"b\" default=\"{}\"/>"
      "<BehaviorTree ID=\"A\"><AlwaysSuccess name=\"{}\"/></BehaviorTree></root>",
      escape(b), escape(used));
  Diagnostics diagnostics;
  const auto project = load_project_text("/nowhere/tree.xml", file, {{"a", a}}, diagnostics);
  require(project != nullptr);
  const auto expected_b = substituted(b, a, std::nullopt);
  const auto expected = substituted(used, a, expected_b.value_or(""));
  require(diagnostics.has_errors() != (expected_b && expected));
  if (diagnostics.has_errors()) return 0;
  const Document& document = *project->documents[0];
  const auto* name = document.find_attribute(4, "name");
  require(name != nullptr && name->value == *expected);
  require(project->arguments.at(1).value == *expected_b);
  return 0;
}

}  // namespace fuzz_arguments_target
