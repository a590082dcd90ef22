// The name of a type as it is written.
#pragma once

#include <string>
#include <typeindex>
#include <typeinfo>

#include "behaviortree_cpp/lockstep/inline.h"

namespace BT {

std::string demangle(const char* name);
std::string demangle(const std::type_index& index);
std::string demangle(const std::type_info& info);

namespace lockstep_detail {

// For a person: "std::map<std::string, double>".
std::string readable(const std::type_index& type);

}  // namespace lockstep_detail
}  // namespace BT

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/demangle_util.h"  // IWYU pragma: export
#endif
