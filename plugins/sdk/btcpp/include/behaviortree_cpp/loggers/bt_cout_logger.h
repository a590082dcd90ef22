// Prints each change of a node's status, when it happens.
#pragma once

#include <cstdio>
#include <iostream>
#include <string>

#include "behaviortree_cpp/loggers/abstract_logger.h"

namespace BT {

class StdCoutLogger : public StatusChangeLogger {
 public:
  explicit StdCoutLogger(const Tree& tree) : StatusChangeLogger(tree.rootNode()) {}
  ~StdCoutLogger() override { unsubscribeFromTreeChanges(); }
  void flush() override { std::cout << std::flush; }

 private:
  void callback(Duration timestamp, const TreeNode& node, NodeStatus before,
                NodeStatus now) override {
    const double seconds = std::chrono::duration<double>(timestamp).count();
    std::printf("[%.3f]: %-25s %s -> %s", seconds, node.name().c_str(), toStr(before, true).c_str(),
                toStr(now, true).c_str());
    std::cout << std::endl;
  }
};

}  // namespace BT
