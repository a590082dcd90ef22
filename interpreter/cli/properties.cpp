#include "cli/properties.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>
#include <string_view>
#include <utility>

#include "base/core/wording.h"
#include "cli/console.h"
#include "language/document/file.h"

namespace lockstep::host {
namespace {

class PropertyReader {
 public:
  // Behind those of a tree file.
  PropertyReader(const PropertyNames& names, std::vector<Property> of_file)
      : names_(names), properties_(std::move(of_file)) {}

  // The text is that line of what is called `source`.
  void read(std::string_view text, const std::string& source, std::uint32_t line) {
    auto property = Property::parse(text, names_);
    if (property) return add(std::move(*property), {source, line, 1});
    const PropertyError& error = property.error();
    const std::string_view before = text.substr(0, error.offset);
    const auto line_begin = before.rfind('\n') + 1;  // 0 when there is none
    const auto line_end = std::min(text.find('\n', line_begin), text.size());
    diagnostics_.error(
        "bad-property"_code,
        {source, line + static_cast<std::uint32_t>(std::ranges::count(before, '\n')),
         static_cast<std::uint32_t>(error.offset - line_begin + 1)},
        error.message, error.hint,
        {.text = std::string(text.substr(line_begin, line_end - line_begin)), .column = 1});
  }

  // One on each line that is neither blank nor begins with #.
  void read_file(const std::string& path) {
    constexpr std::size_t kMostBytes = std::size_t{64} << 20u;
    auto text = host::read_file(path, kMostBytes, FileKinds::RegularOrPipe);
    if (text && text->size() > kMostBytes) text = problem("it has more than 64 MiB");
    if (!text) {
      diagnostics_.error("unreadable-file"_code, {path},
                         fmt::format("cannot read it: {}", text.error().message));
      return;
    }
    std::istringstream file(std::move(*text));
    std::uint32_t number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      const auto first = line.find_first_not_of(" \t\r");
      if (first == std::string::npos || line[first] == '#') continue;
      read(line, path, number);
    }
  }

  std::optional<std::vector<Property>> result() {
    if (!diagnostics_.has_errors()) return std::move(properties_);
    print_diagnostics(diagnostics_, Severity::Error);
    return std::nullopt;
  }

 private:
  // Findings, scenarios and lines about a property have its name.
  void add(Property property, const SourceLocation& location) {
    const auto same = std::ranges::find(properties_, property.name(), &Property::name);
    if (same == properties_.end()) return properties_.push_back(std::move(property));
    if (same->text() == property.text()) return;
    diagnostics_.error("duplicate-name"_code, location,
                       fmt::format("there is a property '{}' already: {}", brief(property.name()),
                                   brief(same->text())),
                       "give each its own name");
  }

  const PropertyNames& names_;
  Diagnostics diagnostics_;
  std::vector<Property> properties_;
};

}  // namespace

void add_property_options(CLI::App& app, PropertyOptions& options) {
  app.add_option("--property", options.texts,
                 "A property, such as 'grip: never grip.running and not gripper.held'; may be "
                 "repeated. See `lockstep docs properties`")
      ->type_name("TEXT")
      ->allow_extra_args(false);
  app.add_option("--property-file", options.files,
                 "A file with a property on each line; # begins a comment; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
}

std::optional<std::vector<Property>> all_properties(std::vector<Property> of_file,
                                                    const PropertyOptions& options,
                                                    const std::function<PropertyNames()>& names) {
  if (options.texts.empty() && options.files.empty()) return of_file;
  const PropertyNames known = names();
  PropertyReader reader(known, std::move(of_file));
  for (const std::string& text : options.texts) reader.read(text, "--property", 1);
  for (const std::string& file : options.files) reader.read_file(file);
  return reader.result();
}

}  // namespace lockstep::host
