// The types of the elements of one leaf type, each made once: what lockstep_leaf_type::describe
// gives.
#pragma once

#include <lockstep/leaf.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "named_leaves.hpp"
#include "ports.hpp"

namespace ros2 {

// The texts that an element gives to its fixed ports.
class FixedTexts {
 public:
  FixedTexts(const lockstep_fixed* fixed, std::uint32_t count)
      : fixed_(fixed), count_(count), named_(named_leaf(fixed_text(fixed, count, kTagPort))) {}
  // "" when it is left out.
  std::string operator[](const lockstep_port& port) const {
    return fixed_text(fixed_, count_, named_ == nullptr ? port.name : named_->name_of(port.name));
  }
  // Null: the tag is that of a leaf type of the plugin.
  const NamedLeaf* named() const { return named_; }
  std::vector<std::string> all() const {
    std::vector<std::string> texts;
    for (std::uint32_t i = 0; i < count_; ++i) {
      texts.emplace_back(fixed_[i].port);
      texts.emplace_back(fixed_[i].text);
    }
    return texts;
  }

 private:
  const lockstep_fixed* fixed_;
  std::uint32_t count_;
  const NamedLeaf* named_;
};

struct Refusal {
  const lockstep_port* port = nullptr;
  Problem problem = {};
};

// `make(texts, refusal)` returns a unique_ptr to an Element, which has a `leaf`, or null.
template <class Element, class Make>
const lockstep_leaf_type* described(const lockstep_fixed* fixed, std::uint32_t count,
                                    lockstep_refusal* why, Make make) {
  static std::mutex mutex;
  // For ever: leaves and hosts point to them.
  static auto& known = *new std::map<std::vector<std::string>, const Element*>;
  const FixedTexts texts(fixed, count);
  const std::lock_guard lock(mutex);
  const auto key = texts.all();
  if (const auto it = known.find(key); it != known.end()) return &it->second->leaf;
  Refusal refusal;
  std::unique_ptr<Element> made = make(texts, refusal);
  if (made == nullptr) {
    const char* const port = refusal.port->name;
    const NamedLeaf* const named = texts.named();
    return refuse(why, named == nullptr ? port : named->name_of(port), refusal.problem);
  }
  made->leaf.data = made.get();
  return &known.emplace(key, made.release()).first->second->leaf;
}

}  // namespace ros2
