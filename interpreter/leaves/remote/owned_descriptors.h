// The tables of a plugin, as another process describes it, with everything that they point to.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "leaves/remote/remote_plugin.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

class OwnedDescriptors {
 public:
  OwnedDescriptors() = default;
  OwnedDescriptors(const OwnedDescriptors&) = delete;
  OwnedDescriptors& operator=(const OwnedDescriptors&) = delete;

  const char* keep(std::string_view text) { return texts_.emplace_back(text).c_str(); }
  // With all proxies as its functions. Neither this nor a port moves when another one is added.
  lockstep_leaf_type& add_leaf();
  // Adds a port to the last leaf.
  lockstep_port& add_port();
  // Adds a statement to the last leaf; both texts are kept.
  void add_behavior(std::string_view word, std::string_view value);

  // The patterns of the last leaf, whose elements the other process describes.
  void set_more_ports(std::string_view patterns);

  lockstep_plugin plugin = proxy_plugin();

 private:
  struct Leaf {
    lockstep_leaf_type type = proxy_leaf_type();
    std::vector<const lockstep_port*> ports = {};
    std::vector<lockstep_behavior> behavior = {};
  };
  std::deque<std::string> texts_;
  std::deque<lockstep_port> ports_;
  std::deque<Leaf> leaves_;
  std::vector<const lockstep_leaf_type*> types_;
};

}  // namespace lockstep::host
