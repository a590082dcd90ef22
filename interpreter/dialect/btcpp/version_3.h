// Words of files without BTCPP_format="4": what they are called since, and those that are gone.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "base/core/node_type.h"
#include "language/document/document.h"
#include "language/document/reporter.h"

namespace lockstep::host::btcpp {

struct Renamed {
  std::string_view before;
  std::string_view since;
};

std::span<const Renamed> renamed_nodes();

// The node that is called like that since version 4; "" if the name says the same in both.
std::string_view node_since_4(std::string_view id);

// The attribute of a node as version 4 calls it.
std::string_view attribute_since_4(const NodeType& type, std::string_view name);

// The attributes of a node as version 4 calls them. Reports what has another meaning there.
std::vector<Attribute> attributes_since_4(std::string_view tag,
                                          std::span<const Attribute> attributes,
                                          const NodeType& type, const Reporter& report);

// The replacement of a node that version 4 does not have; "" for every other node.
std::string_view hint_for_gone(std::string_view id);

// Whether it is one of both.
bool is_old_name(std::string_view id);

// The names of nodes before version 4, in a document that is older.
std::vector<std::string_view> old_names(const Document& document);

}  // namespace lockstep::host::btcpp
