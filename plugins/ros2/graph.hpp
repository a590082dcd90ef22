// A leaf that finds nobody asks here whom it could have meant: what there is of another type, of
// another quality of service or under another name. By the thread of ROS.
#pragma once

#include <rmw/types.h>

#include <set>
#include <string>

namespace ros2 {

// For a topic by its whole name. "": one fits, or there is none.
std::string why_nothing_comes(const char* topic, const std::string& type,
                              const rmw_qos_profile_t& qos);
std::string why_nobody_receives(const char* topic, const std::string& type,
                                const rmw_qos_profile_t& qos);

// Who receives the topic or serves the service, by the ids of their ends, without this node. One
// that has come back has another id. Both are whole names. Empty: none.
using Ids = std::set<std::string>;
Ids receivers_of(const std::string& topic);
Ids servers_of(const std::string& service);

// As an element names it. "": there is none of this name, and none of this type.
std::string other_actions(const std::string& name, const std::string& type);
std::string other_services(const std::string& name, const std::string& type);

}  // namespace ros2
