// The XML schema (XSD 1.0) of the tree language, made from the same rows that the checker uses. It
// accepts everything that the checker accepts, and rejects what XSD can express. Pure: returns
// text, uses no files.
//
// All nodes are global elements, and what a node contains is a lax wildcard: nodes that the schema
// knows are checked everywhere, and unknown leaves of plugins are accepted, unless unknown nodes
// are refused: then the wildcard is strict.
#pragma once

#include <span>
#include <string>

#include "base/core/node_type.h"

namespace lockstep::host {

enum class UnknownNodes : bool { Allowed, Refused };

std::string make_xsd(std::span<const NodeType* const> types,
                     UnknownNodes unknown = UnknownNodes::Allowed);

// The schema of leaf files: leaves/leaf_words.h.
std::string make_leaf_xsd();

// The xs:simpleType of a parameter, for attributes that are named `name`. Only within xsd*.cpp.
std::string xsd_type(const Parameter& parameter);
// For attributes and texts of XML.
std::string xsd_escaped(std::string_view text);

}  // namespace lockstep::host
