#include "author/scaffold/render.h"

#include <algorithm>
#include <kainjow/mustache.hpp>
#include <stdexcept>

#include "author/scaffold/templates.h"

namespace lockstep::host {
namespace {

using kainjow::mustache::data;

data data_of(const Values& values) {
  data made(data::type::object);
  for (const auto& [name, text] : values.texts) {
    text.empty() ? made.set(name, data(data::type::bool_false)) : made.set(name, data(text));
  }
  for (const auto& [name, rows] : values.lists) {
    data list(data::type::list);
    for (const Values& row : rows) list.push_back(data_of(row));
    made.set(name, list);
  }
  return made;
}

// A line with one tag of a section and nothing else is no line of the result. The library has that
// rule only where the section is shown, and takes a blank line below for such a line, so the tag
// goes to the line below it, with a mark that is taken away in the end.
constexpr char kMark = '\1';

std::string without_tag_lines(std::string_view text) {
  std::string joined;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string_view line = text.substr(0, end);
    const bool is_tag = line.starts_with("<%") && line.find("%>\n") == line.find("%>") &&
                        std::string_view("#^/").find(line[2]) != std::string_view::npos;
    joined += is_tag ? std::string(line.substr(0, line.size() - 1)) + kMark : std::string(line);
    text.remove_prefix(end);
  }
  return joined;
}

}  // namespace

std::string render(std::string_view name, const Values& values) {
  const auto found = std::ranges::find(kTemplates, name, &Template::name);
  if (found == std::end(kTemplates)) {
    throw std::logic_error("there is no template '" + std::string(name) + "'");
  }
  kainjow::mustache::mustache text("{{=<% %>=}}" + without_tag_lines(found->text));
  text.set_custom_escape([](const std::string& value) { return value; });
  if (!text.is_valid()) throw std::logic_error(text.error_message());
  std::string result = text.render(data_of(values));
  std::erase(result, kMark);
  return result;
}

}  // namespace lockstep::host
