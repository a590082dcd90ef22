// Writes each change of a node's status to a file that Groot2 reads (.btlog): the tree as XML, then
// 9 bytes for each change. Numbers are little-endian.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>

#include "behaviortree_cpp/loggers/abstract_logger.h"
#include "behaviortree_cpp/xml_parsing.h"

namespace BT {

class FileLogger2 : public StatusChangeLogger {
 public:
  FileLogger2(const Tree& tree, const std::filesystem::path& filepath) {
    if (filepath.extension() != ".btlog") {
      throw RuntimeError("FileLogger2: the file '", filepath.string(),
                         "' must have the extension .btlog");
    }
    file_.open(filepath, std::ios::binary | std::ios::trunc);
    if (!file_.is_open()) {
      throw RuntimeError("FileLogger2: cannot write the file '", filepath.string(), "'");
    }
    const std::string document = WriteTreeToXML(tree, true, true);
    began_ = lockstep_now();
    file_ << "BTCPP4-FileLogger2" << '\1';
    lockstep_put(document.size(), 4);
    file_ << document;
    lockstep_put(began_, 8);
    file_.flush();
    subscribeToTreeChanges(tree.rootNode());
  }
  ~FileLogger2() override { unsubscribeFromTreeChanges(); }

  void callback(Duration /*timestamp*/, const TreeNode& node, NodeStatus /*before*/,
                NodeStatus status) override {
    const Transition it{lockstep_now() - began_, node.UID(), static_cast<std::uint8_t>(status)};
    const std::lock_guard lock(mutex_);
    lockstep_put(it.timestamp_usec, 6);
    lockstep_put(it.node_uid, 2);
    lockstep_put(it.status, 1);
  }

  struct Transition {
    std::uint64_t timestamp_usec;  // since the log began
    std::uint16_t node_uid;
    std::uint8_t status;
  };

  void flush() override {
    const std::lock_guard lock(mutex_);
    file_.flush();
    if (!file_.good()) throw RuntimeError("FileLogger2: the file could not be written");
  }

 private:
  static std::uint64_t lockstep_now() {
    const auto time = std::chrono::system_clock::now().time_since_epoch();
    return static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::microseconds>(time).count());
  }
  void lockstep_put(std::uint64_t number, int bytes) {
    for (int i = 0; i < bytes; ++i) file_.put(static_cast<char>(number >> (8 * i)));
  }

  std::mutex mutex_;
  std::ofstream file_;
  std::uint64_t began_ = 0;
};

}  // namespace BT
