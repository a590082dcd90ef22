// Writes what nodes do to a file that chrome://tracing and Perfetto read: a bar for the time in
// which a node runs, a mark for one that is done at once.
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <fstream>
#include <string>

#include "behaviortree_cpp/loggers/abstract_logger.h"

namespace BT {

class MinitraceLogger : public StatusChangeLogger {
 public:
  MinitraceLogger(const Tree& tree, const char* filename_json) : file_(filename_json) {
    if (!file_.is_open()) {
      throw RuntimeError("MinitraceLogger: cannot write the file '", filename_json, "'");
    }
    file_ << "{\"traceEvents\":[";
    subscribeToTreeChanges(tree.rootNode());
  }
  ~MinitraceLogger() override {
    unsubscribeFromTreeChanges();
    file_ << "\n]}\n";
  }

  void callback(Duration timestamp, const TreeNode& node, NodeStatus before,
                NodeStatus now) override {
    if (now == NodeStatus::RUNNING) {
      lockstep_add(timestamp, node, "B", "");
    } else if (before == NodeStatus::RUNNING) {
      lockstep_add(timestamp, node, "E", ",\"args\":{\"status\":\"" + toStr(now) + "\"}");
    } else if (isStatusCompleted(now)) {
      lockstep_add(timestamp, node, "X", ",\"dur\":0,\"args\":{\"status\":\"" + toStr(now) + "\"}");
    }
  }
  void flush() override { file_.flush(); }

 private:
  // A name as JSON.
  static std::string lockstep_quoted(const std::string& name) {
    constexpr const char* kDigits = "0123456789abcdef";
    std::string text = "\"";
    for (const char it : name) {
      const auto code = static_cast<unsigned char>(it);
      if (it == '"' || it == '\\') text += '\\';
      if (code >= 0x20) {
        text += it;
      } else {
        text += std::string("\\u00") + kDigits[code / 16] + kDigits[code % 16];
      }
    }
    return text + "\"";
  }

  // The bars of nodes that run at the same time overlap, so each node has its own row.
  void lockstep_add(Duration timestamp, const TreeNode& node, const char* phase,
                    const std::string& more) {
    const auto time = std::chrono::duration_cast<std::chrono::microseconds>(timestamp).count();
    file_ << (is_first_ ? "\n" : ",\n") << "{\"name\":" << lockstep_quoted(node.name())
          << ",\"cat\":\"" << toStr(node.type()) << "\",\"ph\":\"" << phase << "\",\"ts\":" << time
          << ",\"pid\":" << getpid() << ",\"tid\":" << node.UID() << more << "}";
    is_first_ = false;
  }

  std::ofstream file_;
  bool is_first_ = true;
};

}  // namespace BT
