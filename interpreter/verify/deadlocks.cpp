#include "verify/deadlocks.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "engine/resources.h"
#include "run/live_moments.h"
#include "verify/components.h"
#include "verify/trace.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kMostDeadlocks = 10, kMostTraced = 50;

// A bottom component of the graph is a set of states that no tick leaves, and in which no run ends.
// What is held on all of its edges is held for ever.
class Deadlocks {
 public:
  enum class Pools : std::uint8_t { Exchanging, All };  // of which members count

  Deadlocks(const Tree& tree, const LeafModels& models, double rate, const SearchResult& found,
            Pools pools)
      : pools_(pools),
        tree_(tree),
        moments_(tree),
        found_(found),
        graph_(found.graph),
        held_(holdable(tree)),
        tracer_(tree, models, {}, rate, found) {}

  std::vector<Deadlock> find() {
    std::set<std::vector<bool>> traced;
    for (const Bottom& bottom : bottoms()) {
      std::vector<bool> holders = that_hold(bottom);
      const bool any = std::ranges::find(holders, true) != holders.end();
      const bool is_looked_at = any && traced.size() < kMostTraced;
      is_everywhere_ = is_everywhere_ && is_looked_at;
      if (is_looked_at && traced.insert(holders).second) look_at(bottom.first, holders);
    }
    return std::move(deadlocks_);
  }
  // After it: whether each state that no tick leaves is a deadlock, in which nobody waits for
  // what runs.
  bool is_everywhere() const { return is_everywhere_; }

 private:
  struct Bottom {
    StateId first;
    std::vector<StateId> states;
  };

  // By their first states.
  std::vector<Bottom> bottoms() const {
    std::vector<StateId> states(graph_.expanded());
    std::iota(states.begin(), states.end(), StateId{0});
    Components components(graph_);
    components.find(states, [](StateId, const Edge&) { return true; });
    std::vector<bool> has_way_out(components.count());
    for (const StateId state : states) {
      const EdgeRow edges = graph_.edges_of(state);
      const bool leaves = std::ranges::any_of(edges, [&](const Edge& edge) {
        return edge.to >= graph_.expanded() || components.of(edge.to) != components.of(state);
      });
      if (leaves || graph_.ends[state]) has_way_out[components.of(state)] = true;
    }
    std::vector<Bottom> bottoms;
    std::vector<std::size_t> places(components.count(), kNone);
    for (const StateId state : states) {
      const std::uint32_t component = components.of(state);
      if (has_way_out[component]) continue;
      if (places[component] == kNone) {
        places[component] = bottoms.size();
        bottoms.push_back({state, {}});
      }
      bottoms[places[component]].states.push_back(state);
    }
    return bottoms;
  }

  // Of each node, whether it holds one for ever. Children that change places may be held in turn,
  // each at the place of the other; not where nothing happens at all.
  std::vector<bool> that_hold(const Bottom& bottom) const {
    std::vector<bool> holders(tree_.nodes.size());
    const bool is_frozen = bottom.states.size() == 1 && is_frozen_in(bottom.first);
    for (std::size_t i = 0; i < held_.size(); ++i) {
      const auto [holder, child] = held_[i];
      const bool is_taken_in_turns = is_pool(tree_, holder) && !exchanges(tree_, child - 1);
      if (is_taken_in_turns && pools_ != Pools::All) continue;
      if (found_.symmetry.moves(child) && !is_frozen) continue;
      if (is_held_in_all(bottom, graph_.shape.held_bit(i))) {
        // The run may have another one at that place.
        for (std::size_t j = 0; j < held_.size(); ++j) {
          if (like(held_[j].holder) == like(holder)) holders[held_[j].holder] = true;
        }
      }
    }
    return holders;
  }
  NodeIndex like(NodeIndex node) const { return found_.symmetry.first_like(node); }

  bool is_held_in_all(const Bottom& bottom, std::size_t bit) const {
    return std::ranges::all_of(bottom.states, [&](StateId state) {
      return std::ranges::all_of(graph_.edges_of(state),
                                 [&](const Edge& edge) { return graph_.has(edge, bit); });
    });
  }

  bool is_frozen_in(StateId state) const {
    const LabelShape& shape = graph_.shape;
    return std::ranges::none_of(graph_.edges_of(state), [&](const Edge& edge) {
      for (std::size_t leaf = 0; leaf < shape.leaves; ++leaf) {
        if (graph_.has(edge, shape.worked_bit(leaf)) || graph_.has(edge, shape.ended_bit(leaf))) {
          return true;
        }
      }
      return graph_.has(edge, shape.begun_bit());
    });
  }

  // Behind a tick from that state.
  void look_at(StateId state, const std::vector<bool>& holders) {
    TracedPath traced = tracer_.begin();
    std::vector<StateId> path = found_.path_to(state);
    path.push_back(graph_.edges_of(state).begin()->to);
    tracer_.go(traced, path);
    bool stands = false;  // somebody waits, and not for what runs
    tracer_.play({traced.run.back()}, [&](Stepper& stepper, Status, std::size_t) {
      const Moment& moment = moments_.after_tick(stepper.ticker(), 0, {});
      for (NodeIndex node = 0; node < holders.size(); ++node) {
        if (!holders[node] || !holds_somebody(shape(), moment, node)) continue;
        WaitChain chain = wait_chain(shape(), moment, node);
        stands |= chain.obstacle != Obstacle::Running && chain.obstacle != Obstacle::Denied;
        const bool lasts = std::ranges::all_of(chain.links, [&](const WaitLink& link) {
          return shape().nodes[link.node].is_pool() || holders[link.node];
        });
        if (!lasts) chain = {.links = {chain.links.front()}};
        const NodeIndex decider = decider_of(moment, chain.links.back().awaited);
        add({std::move(chain), decider});
      }
    });
    is_everywhere_ = is_everywhere_ && stands;
  }

  // The lowest node above this one that has done something in this tick, or before.
  NodeIndex decider_of(const Moment& moment, NodeIndex node) const {
    do node = tree_.labels[node].parent;
    while (node != 0 && moment.status(node) == Status::Idle);
    return node;
  }

  // What leads to a circle is not reported beside it.
  void add(Deadlock deadlock) {
    if (deadlocks_.size() == kMostDeadlocks) return;
    const std::vector<WaitLink>& links = deadlock.chain.links;
    std::vector<NodeIndex> nodes;
    for (const WaitLink& link : links) nodes.push_back(link.node);
    if (deadlock.chain.obstacle != Obstacle::Circle) nodes = {nodes.back(), links.back().awaited};
    if (known_.insert(std::move(nodes)).second) deadlocks_.push_back(std::move(deadlock));
  }

  // Its paths may be long: only for a tree in which somebody waits.
  const Shape& shape() {
    if (!shape_) shape_ = shape_of(tree_);
    return *shape_;
  }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  const Pools pools_;
  const Tree& tree_;
  bool is_everywhere_ = true;
  std::optional<Shape> shape_ = {};
  LiveMoments moments_;
  const SearchResult& found_;
  const Graph& graph_;
  const std::vector<Holdable> held_;
  Tracer tracer_;
  std::set<std::vector<NodeIndex>> known_;
  std::vector<Deadlock> deadlocks_;
};

}  // namespace

bool exchanges(const Tree& tree, NodeIndex member) {
  return resources::on_change(tree, member) == resources::OnChange::Exchange;
}

std::vector<Deadlock> deadlocks(const Tree& tree, const LeafModels& models, double rate,
                                const SearchResult& found) {
  return Deadlocks(tree, models, rate, found, Deadlocks::Pools::Exchanging).find();
}

NoEnd why_no_end(const Tree& tree, const LeafModels& models, double rate,
                 const SearchResult& found) {
  Deadlocks deadlocks(tree, models, rate, found, Deadlocks::Pools::All);
  std::vector<Deadlock> all = deadlocks.find();
  if (all.empty()) return {};
  return {std::move(all.front()), deadlocks.is_everywhere()};
}

}  // namespace lockstep::host
