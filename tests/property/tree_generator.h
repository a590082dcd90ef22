// Draws random trees, node by node.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "property/random_source.h"
#include "property/random_tree.h"

namespace lockstep::host::test {

class TreeGenerator : protected RandomSource {
 public:
  explicit TreeGenerator(std::uint64_t seed) : RandomSource(seed) {}
  virtual ~TreeGenerator() = default;
  Trial trial();

 protected:
  static constexpr int kMaxDepth = 6;

  // The entries of all scripts have a value first.
  static Plan with_entries(Plan plan);
  double fraction();
  void draw_times(Trial& trial);

  virtual Plan node(int depth);
  // A subtree without actions.
  Plan guard(int depth);
  Plan leaf();
  Plan scripted(std::string kind);
  void add_hooks(Plan& plan);
  std::string reading();
  std::string condition();

  Plan barrier(std::string name);
  void barriers(Plan& plan);
  Plan pool(std::string name);
  Plan sync_progress(const std::string& barrier, Plan child);
  // A pool may be used inside of those before it, else no member is inside of another one.
  Plan use_resources(const std::function<Plan()>& child);
  bool has_pool_left() const { return next_pool_ < pools_.size(); }
  // What a group is called where the generator is now.
  std::string written(const std::string& group);

  int budget_ = 0;  // of nodes
  int leaves_ = 0;
  bool faults_ = false;
  bool skips_ = false;                                            // leaves may return Skipped
  bool scripts_ = false;                                          // there are scripts
  std::vector<std::string> barriers_ = {"g0", "g0", "g0", "g1"};  // the first ones more often
  std::vector<std::string> pools_ = {"p", "q"};
  std::size_t next_pool_ = 0;
  GroupNames names_;                        // inside of the SubTrees around
  std::vector<std::string> resource_keys_;  // that UseResources may have
  std::vector<std::string> assignments_;    // of entries of groups

 private:
  Plan bare_node(int depth);
  Plan control(std::string kind, int depth);
  Plan child_of_parallel(int depth);
  Plan branches(std::string kind, int depth);
  Plan cases(int depth);
  Plan decorator(int depth);
  std::string assignment();

  // Scripts of leaves.
  std::string results() const;
  std::string progress();
  std::string growth();
  std::string steps(std::string_view letters, int longest);
  std::string live();
  std::string fault(const std::string& script);
};

}  // namespace lockstep::host::test
