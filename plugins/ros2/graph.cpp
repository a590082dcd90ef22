#include "graph.hpp"

#include <rcl/error_handling.h>
#include <rcl/graph.h>
#include <rcl/node.h>
#include <rcl_action/graph.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "middleware.hpp"

namespace ros2 {
namespace {

using Get = decltype(&rcl_get_publishers_info_by_topic);
using Endpoint = rmw_topic_endpoint_info_t;

bool keeps_for_late(const rmw_qos_profile_t& qos) {
  return qos.durability == RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
}
bool may_lose(const rmw_qos_profile_t& qos) {
  return qos.reliability == RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT;
}

// Names what the publisher does not offer, and the qos that would do. "": it offers all.
std::string lacks(const rmw_qos_profile_t& offered, const rmw_qos_profile_t& wanted,
                  bool receives) {
  if (may_lose(offered) && !may_lose(wanted)) {
    return receives ? "may lose messages: write qos=\"sensor_data\""
                    : "wants all messages: write qos=\"default\"";
  }
  if (!keeps_for_late(offered) && keeps_for_late(wanted)) {
    return receives ? "keeps none for those who come late: write qos=\"default\""
                    : "wants the last one when it comes late: write qos=\"latched\"";
  }
  return {};
}

// "" if `other` fits.
std::string why_not(const Endpoint& other, const std::string& type, const rmw_qos_profile_t& qos,
                    bool receives) {
  const std::string node = "'" + std::string(other.node_name) + "' ";
  if (other.topic_type != type) {
    return node + (receives ? "publishes " : "receives ") + other.topic_type + ", not " + type;
  }
  const rmw_qos_profile_t& theirs = other.qos_profile;
  const std::string what = receives ? lacks(theirs, qos, true) : lacks(qos, theirs, false);
  return what.empty() ? "" : node + what;
}

// `is_raw`: the name is that of the middleware below.
template <class Visit>
void for_each_endpoint(Get get, const char* topic, bool is_raw, Visit visit) {
  rcutils_allocator_t allocator = rcutils_get_default_allocator();
  auto all = rcl_get_zero_initialized_topic_endpoint_info_array();
  if (get(&Middleware::get().node(), &allocator, topic, is_raw, &all) == RCL_RET_OK) {
    for (std::size_t i = 0; i < all.size; ++i) visit(all.info_array[i]);
  }
  if (rmw_topic_endpoint_info_array_fini(&all, &allocator) != RMW_RET_OK) rcl_reset_error();
  rcl_reset_error();
}

std::string look(Get get, const char* topic, const std::string& type, const rmw_qos_profile_t& qos,
                 bool receives) {
  std::string first;
  bool has_one = false;
  for_each_endpoint(get, topic, false, [&](const Endpoint& it) {
    const std::string why = why_not(it, type, qos, receives);
    has_one |= why.empty();
    if (first.empty()) first = why;
  });
  if (has_one || first.empty()) return {};
  return "nothing goes over the topic '" + std::string(topic) + "': " + first;
}

Ids ids_of(const std::string& topic, bool is_raw) {
  const rcl_node_t& node = Middleware::get().node();
  const std::string name = rcl_node_get_name(&node), space = rcl_node_get_namespace(&node);
  Ids ids;
  for_each_endpoint(
      rcl_get_subscriptions_info_by_topic, topic.c_str(), is_raw, [&](const Endpoint& it) {
        if (it.node_name == name && it.node_namespace == space) return;
        ids.emplace(reinterpret_cast<const char*>(it.endpoint_gid), sizeof it.endpoint_gid);
      });
  return ids;
}

// A name as the graph has it: with the namespace of this node.
std::string whole_name(const std::string& name) {
  char* resolved = nullptr;
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  const auto code = rcl_node_resolve_name(&Middleware::get().node(), name.c_str(), allocator, true,
                                          true, &resolved);
  std::string whole = code == RCL_RET_OK ? resolved : name;
  allocator.deallocate(resolved, allocator.state);
  rcl_reset_error();
  return whole;
}

// `kind` is "action" or "service".
std::string others(const std::string& kind, const std::string& name, const std::string& type,
                   const rcl_names_and_types_t& all) {
  constexpr std::size_t kMost = 3;
  const std::string whole = whole_name(name);
  std::vector<std::string> named;
  for (std::size_t i = 0; i < all.names.size; ++i) {
    const std::string other = all.names.data[i];
    const rcutils_string_array_t& types = all.types[i];
    for (std::size_t j = 0; j < types.size; ++j) {
      const bool is_same_type = types.data[j] == type, is_own = other == whole;
      if (is_same_type && !is_own) named.push_back("'" + other + "'");
      if (is_same_type || !is_own) continue;
      return "the " + kind + " '" + whole + "' is of the type " + types.data[j] + ", not " + type;
    }
  }
  if (named.empty()) return {};
  std::string text = "there is no " + kind + " '" + whole + "'; of its type there " +
                     (named.size() == 1 ? "is " : "are ");
  for (std::size_t i = 0; i < std::min(named.size(), kMost); ++i) {
    text += (i == 0 ? "" : ", ") + named[i];
  }
  return named.size() > kMost ? text + ", …" : text;
}

template <class Fill>
std::string among(const std::string& kind, const std::string& name, const std::string& type,
                  Fill fill) {
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_names_and_types_t all = rcl_get_zero_initialized_names_and_types();
  std::string text;
  if (fill(&Middleware::get().node(), &allocator, &all) == RCL_RET_OK) {
    text = others(kind, name, type, all);
  }
  if (rcl_names_and_types_fini(&all) != RCL_RET_OK) rcl_reset_error();
  rcl_reset_error();
  return text;
}

}  // namespace

std::string why_nothing_comes(const char* topic, const std::string& type,
                              const rmw_qos_profile_t& qos) {
  return look(rcl_get_publishers_info_by_topic, topic, type, qos, true);
}

std::string why_nobody_receives(const char* topic, const std::string& type,
                                const rmw_qos_profile_t& qos) {
  return look(rcl_get_subscriptions_info_by_topic, topic, type, qos, false);
}

Ids receivers_of(const std::string& topic) {
  return ids_of(topic, false);
}

Ids servers_of(const std::string& service) {
  return ids_of("rq" + service + "Request", true);  // as every DDS calls it
}

std::string other_actions(const std::string& name, const std::string& type) {
  return among("action", name, type, rcl_action_get_names_and_types);
}

std::string other_services(const std::string& name, const std::string& type) {
  return among("service", name, type, rcl_get_service_names_and_types);
}

}  // namespace ros2
