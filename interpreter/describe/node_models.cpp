#include <fmt/format.h>

#include "base/core/diagnostics.h"
#include "describe/node_reference.h"
#include "describe/xsd.h"
#include "tree/check/models.h"
#include "tree/check/node_check.h"

namespace lockstep::host {
namespace {

std::string_view port_tag(Direction direction) {
  if (direction == Direction::Input) return "input_port";
  return direction == Direction::Output ? "output_port" : "inout_port";
}

std::string cpp_type(const Parameter& it) {
  if (it.type == ValueType::Object) return std::string(it.object->name());
  return std::string(cpp_type_of(it.type));
}

std::string port_model(const Parameter& it) {
  const std::string tag(port_tag(it.direction));
  std::string text =
      fmt::format("      <{} name=\"{}\" type=\"{}\"", tag, it.name, xsd_escaped(cpp_type(it)));
  if (it.default_text) {
    text += fmt::format(" default=\"{}\"", xsd_escaped(printable(*it.default_text)));
  }
  return text + fmt::format(">{}</{}>\n", xsd_escaped(printable(it.doc)), tag);
}

}  // namespace

std::string nodes_as_models(NodeTypes types) {
  return fmt::format("<root BTCPP_format=\"4\">\n{}</root>\n", tree_nodes_model(types));
}

std::string tree_nodes_model(NodeTypes types) {
  std::string text = "  <TreeNodesModel>\n";
  for (const NodeType* type : types) {
    const auto tag = explicit_tag(type->category);
    if (tag.empty()) continue;
    text += fmt::format("    <{} ID=\"{}\">\n", tag, type->id);
    for (const Parameter& it : type->parameters) text += port_model(it);
    text += fmt::format("    </{}>\n", tag);
  }
  return text + "  </TreeNodesModel>\n";
}

}  // namespace lockstep::host
