// The few forms of scripts in random trees: "x>=y", "x+y", "x:=1-x;y+=2", "r:='A;B'",
// "progress(a0)>=0.5", "owner(p/A)==none".
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace lockstep::host::test {

// Thrown where a node meets a fault: nothing else happens in that tick.
struct ReferenceFault {
  std::size_t node;
};

// The blackboard. An entry that is not in it has no value.
struct Entries {
  std::map<std::string, double> numbers;
  std::map<std::string, std::string> texts;  // also lists
  std::map<std::string, double> readings;    // "status(a0)", as it was before this tick
};

// What a script reads in a SubTree, where pools may have other names: "owner(q/A)" of "owner(p/A)".
using Meanings = std::map<std::string, std::string>;

class MiniScript {
 public:
  // An entry without a value is a fault of `node`.
  MiniScript(Entries& entries, std::size_t node, const Meanings& meanings)
      : entries_(entries), node_(node), meanings_(meanings) {}

  bool holds(const std::string& text) const;
  double number(const std::string& text) const;  // "x" or "x+y"
  void run(const std::string& text) const;

 private:
  void assign(const std::string& statement) const;
  double difference(const std::string& text) const;
  double value(const std::string& text) const;

  Entries& entries_;
  std::size_t node_;
  const Meanings& meanings_;
};

}  // namespace lockstep::host::test
