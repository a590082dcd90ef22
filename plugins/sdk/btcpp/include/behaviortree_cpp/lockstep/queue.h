// Queues of items, which a tree shares by pointer. Included by decorators/loop_node.h and
// actions/pop_from_queue.hpp.
#pragma once

#include <deque>
#include <list>
#include <memory>
#include <mutex>

#include "behaviortree_cpp/basic_types.h"

namespace BT {

template <class T>
using SharedQueue = std::shared_ptr<std::deque<T>>;

template <class T>
struct ProtectedQueue {
  std::list<T> items;
  std::mutex mtx;
};

namespace lockstep_detail {

// "1;2;3"
template <class Item>
struct TextReader<SharedQueue<Item>> {
  static SharedQueue<Item> read(StringView text) {
    auto queue = std::make_shared<std::deque<Item>>();
    for (const StringView part : splitString(text, ';')) {
      queue->push_back(convertFromString<Item>(part));
    }
    return queue;
  }
};

}  // namespace lockstep_detail
}  // namespace BT
