// Text from a template and values: mustache, with <% and %> in place of its braces, which source
// files have themselves.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep::host {

// The values that a template names. In <%#name%>…<%/name%>, a text that is not "" is shown once,
// and a list once for each of its rows.
struct Values {
  std::map<std::string, std::string> texts = {};
  std::map<std::string, std::vector<Values>> lists = {};
};

// `name` is that of a file of templates/, without ".in".
std::string render(std::string_view name, const Values& values);

}  // namespace lockstep::host
