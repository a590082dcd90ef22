// The law of trees for BehaviorTree.CPP once more, slow and obvious: it walks the document, an
// object for each node, and looks every key up by its name. It shares nothing with engine/.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/core/status.h"
#include "property/kept_state.h"
#include "property/leaf_behavior.h"
#include "support/event_log.h"

namespace lockstep::host::test::law {

// "name op operand", or a constant without a name. `op`: == != < > for conditions, := = += else.
struct Script {
  std::string name = {}, op = {};
  std::string other = {};  // a name, if there is one
  std::variant<double, std::string> value = 0.0;
};

struct Element {
  std::string tag;  // "Act" and "Cond" are scripted leaves
  std::map<std::string, std::string> attributes = {};
  std::map<std::string, Script> scripts = {};  // _skipIf, …, code, if
  std::vector<Element> children = {};
  // Of a leaf: what it returns, tick by tick, the last one stays; R.5: and its progress then.
  std::string letters = {};
};

// A period with more of them is a fault.
inline constexpr int kMostTicksAtOnce = 100;

// The trees by their IDs.
using Document = std::map<std::string, Element>;

struct Entry {
  std::variant<std::monostate, double, std::string> value = {};
  unsigned writes = 0;
  bool is_int = false;   // else any, or a text
  bool is_text = false;  // of a SetBlackboard with a text, or copied from such a one
};

class Node;
struct World;

class Reference {
 public:
  // Runs the tree "Main". The document must outlive this.
  // `behavior`: of the leaves, in place of their letters; it outlives this.
  explicit Reference(const Document& document, LeafBehavior* behavior = nullptr);
  ~Reference();

  // The result of one period, a tenth of a second after the last one; nothing after a fault.
  std::optional<Status> tick();
  // Into an entry of the main tree.
  void write(const std::string& entry, double value);
  // All that it keeps between two periods, and back. No duration in the document is longer than
  // `longest`, and no node looks at how often an entry was written.
  std::string save(Nanoseconds longest);
  void restore(const std::string& state, Nanoseconds longest);
  // Nodes are numbered in pre-order.
  std::size_t nodes() const;
  Status status(std::size_t node) const;
  bool ticked(std::size_t node) const;  // in the last period

  EventLog& events();
  // By "sub/key", as the engine names them.
  std::map<std::string, Entry> entries() const;

 private:
  void keep(KeptState& state);

  std::unique_ptr<World> world_;
  std::unique_ptr<Node> root_;
};

}  // namespace lockstep::host::test::law
