#include "describe/tree_matching.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <unordered_map>
#include <unordered_set>

#include "base/core/value.h"
#include "tree/paths.h"

namespace lockstep::host {
namespace {

// Nodes with children are the same if so much of what is below them is.
constexpr double kSimilar = 0.3;
constexpr double kSimilarOfOtherKind = 0.6;
// Leaves with different names are the same if so many of their values are.
constexpr double kEqualValues = 0.5;
// More pairs of children than this are compared in their order only.
constexpr std::size_t kMostPairs = 250'000;

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '@' || c == '.';
}

// A script without the blanks that do not count: those that are not between two words.
std::string without_blanks(std::string_view script) {
  std::string text;
  char quote = 0;
  bool has_blank = false;
  for (const char c : script) {
    if (quote == 0 && std::isspace(static_cast<unsigned char>(c)) != 0) {
      has_blank = true;
      continue;
    }
    if (has_blank && !text.empty() && is_word(text.back()) && is_word(c)) text += ' ';
    has_blank = false;
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '\'' || c == '"') {
      quote = c;
    }
    text += c;
  }
  return text;
}

std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
  hash ^= value + 0x9e3779b97f4a7c15U + (hash << 6U) + (hash >> 2U);
  return hash * 0xff51afd7ed558ccdU;
}

std::uint64_t mix(std::uint64_t hash, std::string_view text) {
  return mix(hash, std::hash<std::string_view>{}(text));
}

bool is_hook(const Definition& definition, const DefinitionNode& node, std::string_view name) {
  if (node.hooks >= definition.hooks.size()) return false;
  const auto& parameters = node.type->parameters;
  return std::ranges::find(parameters, name, &Parameter::name) == parameters.end();
}

class Matcher {
 public:
  Matcher(const MatchedTree& a, const MatchedTree& b) : a_(a), b_(b) {
    matching_.to_new.resize(a.definition.nodes.size(), kNoNode);
    matching_.to_old.resize(b.definition.nodes.size(), kNoNode);
    is_whole_.resize(a.definition.nodes.size());
  }

  Matching run() {
    match_equal_subtrees();
    match_names();
    match_around_equal();
    match_tops();
    match_children_of_matched();
    return std::move(matching_);
  }

 private:
  std::vector<std::uint32_t>& to_new() { return matching_.to_new; }
  std::vector<std::uint32_t>& to_old() { return matching_.to_old; }
  const std::vector<std::uint32_t>& to_old() const { return matching_.to_old; }

  void add(std::uint32_t a, std::uint32_t b) {
    to_new()[a] = b;
    to_old()[b] = a;
  }
  void add_subtree(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t size = a_.size(a);
    for (std::uint32_t i = 0; i < size; ++i) {
      add(a + i, b + i);
      is_whole_[a + i] = true;
    }
  }
  bool same_kind(std::uint32_t a, std::uint32_t b) const {
    return a_.node(a).type->id == b_.node(b).type->id;
  }
  bool same_name(std::uint32_t a, std::uint32_t b) const {
    return is_named(a_.definition, a_.node(a)) && is_named(b_.definition, b_.node(b)) &&
           a_.node(a).name == b_.node(b).name;
  }
  bool are_unnamed(std::uint32_t a, std::uint32_t b) const {
    return !is_named(a_.definition, a_.node(a)) && !is_named(b_.definition, b_.node(b));
  }
  bool is_free(const MatchedTree& tree, const std::vector<std::uint32_t>& partners,
               std::uint32_t index) const {
    return std::all_of(partners.begin() + index, partners.begin() + tree.node(index).end,
                       [](std::uint32_t it) { return it == kNoNode; });
  }

  void match_equal_subtrees() {
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> with_hash;
    for (auto b = static_cast<std::uint32_t>(b_.whole.size()); b-- > 0;) {
      with_hash[b_.whole[b]].push_back(b);  // the first one is at the back
    }
    std::unordered_map<std::string_view, std::uint32_t> with_path;
    for (std::uint32_t b = 0; b < b_.paths.size(); ++b) with_path.emplace(b_.paths[b], b);
    std::unordered_map<std::uint64_t, std::uint32_t> copies;  // among the old nodes
    for (std::uint32_t a = 0; a < a_.whole.size();) {
      const auto same_path = with_path.find(a_.paths[a]);
      // Of leaves without names, the path only counts those that are alike.
      const bool is_telling = a_.size(a) > 1 || is_named(a_.definition, a_.node(a));
      if (is_telling && same_path != with_path.end() &&
          a_.whole[a] == b_.whole[same_path->second] && to_old()[same_path->second] == kNoNode) {
        add_subtree(a, same_path->second);
        a = a_.node(a).end;
      } else {
        ++a;
      }
    }
    std::vector<std::uint32_t> left;
    for (std::uint32_t a = 0; a < a_.whole.size(); ++a) {
      if (to_new()[a] != kNoNode) continue;
      left.push_back(a);
      ++copies[a_.whole[a]];
    }
    std::ranges::stable_sort(left, std::ranges::greater(),
                             [this](std::uint32_t it) { return a_.size(it); });
    for (const std::uint32_t a : left) {
      const auto bucket = with_hash.find(a_.whole[a]);
      if (bucket == with_hash.end() || to_new()[a] != kNoNode || a_.is_top(a)) continue;
      if (!is_free(a_, to_new(), a)) continue;
      if (a_.size(a) == 1 && !is_telling(a, copies[a_.whole[a]], bucket->second.size())) continue;
      const std::uint32_t b = take(bucket->second, a);
      if (b != kNoNode) add_subtree(a, b);
    }
  }

  // The first that is free, or one of the first at the same place.
  std::uint32_t take(std::vector<std::uint32_t>& found, std::uint32_t a) const {
    constexpr std::ptrdiff_t kNearest = 64;
    const auto is_taken = [this](std::uint32_t b) { return !is_free(b_, to_old(), b); };
    while (!found.empty() && is_taken(found.back())) found.pop_back();
    if (found.empty()) return kNoNode;
    const auto last = found.rbegin() + std::min<std::ptrdiff_t>(std::ssize(found), kNearest);
    const auto near = std::find_if(found.rbegin(), last, [&](std::uint32_t b) {
      return !is_taken(b) && a_.paths[a_.node(a).parent] == b_.paths[b_.node(b).parent];
    });
    const auto chosen = near == last ? found.rbegin() : near;
    const std::uint32_t b = *chosen;
    found.erase(std::next(chosen).base());
    return b;
  }

  // A leaf that is the same one, wherever it is.
  bool is_telling(std::uint32_t a, std::size_t here, std::size_t there) const {
    if (is_named(a_.definition, a_.node(a))) return true;
    return here == 1 && there == 1 && !a_.definition.attributes(a_.node(a)).empty();
  }

  void match_around_equal() {
    for (auto a = static_cast<std::uint32_t>(a_.whole.size()); a-- > 0;) {
      if (to_new()[a] != kNoNode || a_.size(a) == 1) continue;
      double best = 0;
      std::uint32_t partner = kNoNode;
      for (const std::uint32_t b : candidates(a)) {
        const double similarity = 2.0 * common_below(a, b) / (a_.size(a) + b_.size(b) - 2);
        const bool is_same = same_kind(a, b);
        if (similarity < (is_same || same_name(a, b) ? kSimilar : kSimilarOfOtherKind)) continue;
        const double score = similarity + (is_same ? 1 : 0) + (same_name(a, b) ? 1 : 0) +
                             (a_.paths[a] == b_.paths[b] ? 0.5 : 0);
        if (score <= best) continue;
        best = score;
        partner = b;
      }
      if (partner != kNoNode) add(a, partner);
    }
  }

  // The nodes of the other tree that are nearest around what is matched below this one.
  std::vector<std::uint32_t> candidates(std::uint32_t a) const {
    constexpr std::size_t kMost = 16;
    constexpr int kLevels = 8;
    std::map<std::uint32_t, std::uint32_t> hits;
    for (std::uint32_t i = a + 1; i < a_.node(a).end;) {
      const std::uint32_t partner = matching_.to_new[i];
      if (partner == kNoNode) {
        ++i;
        continue;
      }
      std::uint32_t b = partner;
      for (int level = 0; level < kLevels && !b_.is_top(b); ++level) {
        b = b_.node(b).parent;
        if (to_old()[b] == kNoNode) ++hits[b];
      }
      i = a_.node(i).end;
    }
    std::vector<std::uint32_t> nearest;
    for (const auto& [b, count] : hits) nearest.push_back(b);
    std::ranges::stable_sort(nearest, std::ranges::greater(),
                             [&](std::uint32_t b) { return hits[b]; });
    nearest.resize(std::min(nearest.size(), kMost));
    return nearest;
  }

  // How many of the nodes below the one are matched with nodes below the other one.
  std::uint32_t common_below(std::uint32_t a, std::uint32_t b) const {
    std::uint32_t count = 0;
    for (std::uint32_t i = a + 1; i < a_.node(a).end;) {
      const std::uint32_t partner = matching_.to_new[i];
      const std::uint32_t next = partner != kNoNode && is_whole_[i] ? a_.node(i).end : i + 1;
      if (partner != kNoNode && partner > b && partner < b_.node(b).end) count += next - i;
      i = next;
    }
    return count;
  }

  void match_tops() {
    if (to_new()[0] == kNoNode && to_old()[0] == kNoNode) add(0, 0);
    std::vector<std::uint32_t> of_a, of_b;
    for (std::uint32_t a = a_.node(0).end; a < a_.whole.size(); ++a) of_a.push_back(a);
    for (std::uint32_t b = b_.node(0).end; b < b_.whole.size(); ++b) of_b.push_back(b);
    align(std::move(of_a), std::move(of_b));
  }

  static std::vector<std::uint32_t> children_of(const MatchedTree& tree, std::uint32_t index) {
    std::vector<std::uint32_t> children;
    for (std::uint32_t i = index + 1; i < tree.node(index).end; i = tree.node(i).end) {
      children.push_back(i);
    }
    return children;
  }

  // Those below a node that are not matched, up to those that are.
  static std::vector<std::uint32_t> unmatched_below(const MatchedTree& tree,
                                                    const std::vector<std::uint32_t>& partners,
                                                    std::uint32_t index) {
    std::vector<std::uint32_t> below;
    for (std::uint32_t i = index + 1; i < tree.node(index).end;) {
      const bool is_matched = partners[i] != kNoNode;
      if (!is_matched) below.push_back(i);
      i = is_matched ? tree.node(i).end : i + 1;
    }
    return below;
  }

  void match_children_of_matched() {
    for (std::uint32_t a = 0; a < a_.whole.size(); ++a) match_children(a);
  }

  void match_children(std::uint32_t a) {
    const std::uint32_t b = to_new()[a];
    if (b == kNoNode || is_whole_[a] || a_.size(a) == 1 || b_.size(b) == 1) return;
    align(children_of(a_, a), children_of(b_, b));
    // A node may have come between, or gone.
    align(unmatched_below(a_, to_new(), a), unmatched_below(b_, to_old(), b));
  }

  double equal_values(std::uint32_t a, std::uint32_t b) const {
    const auto of_a = values_of(a_.definition, a_.node(a));
    const auto of_b = values_of(b_.definition, b_.node(b));
    std::size_t all = 0, equal = 0;
    for (const NodeValue& it : of_a) {
      if (!it.is_written) continue;
      ++all;
      const auto other = std::ranges::find(of_b, it.name, &NodeValue::name);
      if (other != of_b.end() && other->text == it.text) ++equal;
    }
    for (const NodeValue& it : of_b) {
      if (it.is_written && std::ranges::find(of_a, it.name, &NodeValue::name) == of_a.end()) ++all;
    }
    return all == 0 ? 1 : static_cast<double>(equal) / static_cast<double>(all);
  }

  // Pairs of what two nodes have below them, the surest first.
  void align(std::vector<std::uint32_t> of_a, std::vector<std::uint32_t> of_b) {
    const auto keep_free = [&] {
      std::erase_if(of_a, [this](std::uint32_t it) { return to_new()[it] != kNoNode; });
      std::erase_if(of_b, [this](std::uint32_t it) { return to_old()[it] != kNoNode; });
    };
    keep_free();
    const auto pair_up = [&](auto may_be, auto score) {
      if (of_a.size() * of_b.size() > kMostPairs) {
        pair_in_order(of_a, of_b, may_be);
      } else {
        for (const std::uint32_t a : of_a) {
          double best = 0;
          std::uint32_t partner = kNoNode;
          for (const std::uint32_t b : of_b) {
            if (to_old()[b] != kNoNode || !may_be(a, b) || is_around_others(a, b)) continue;
            const double value = score(a, b);
            if (value <= best) continue;
            best = value;
            partner = b;
          }
          if (partner != kNoNode) add(a, partner);
        }
      }
      keep_free();
    };
    align_equal(of_a, of_b);
    keep_free();
    const auto always = [](std::uint32_t, std::uint32_t) { return 1.0; };
    const auto values = [this](std::uint32_t a, std::uint32_t b) {
      return equal_values(a, b) + equal_children(a, b);
    };
    pair_up([this](auto a, auto b) { return same_kind(a, b) && same_name(a, b); }, always);
    pair_up([this](auto a, auto b) { return same_name(a, b) && is_leaf(a, b); }, always);
    pair_up([this](auto a, auto b) { return same_kind(a, b) && are_unnamed(a, b); },
            [&](auto a, auto b) { return values(a, b) + 0.01; });
    pair_up(
        [&](auto a, auto b) {
          return same_kind(a, b) && is_leaf(a, b) && values(a, b) >= kEqualValues;
        },
        values);
  }

  // The share of the children that are equal.
  double equal_children(std::uint32_t a, std::uint32_t b) const {
    const auto of_a = children_of(a_, a), of_b = children_of(b_, b);
    if (of_a.empty() || of_b.empty()) return 0;
    std::unordered_set<std::uint64_t> hashes;
    for (const std::uint32_t it : of_a) hashes.insert(a_.whole[it]);
    const auto equal = std::ranges::count_if(
        of_b, [&](std::uint32_t it) { return hashes.contains(b_.whole[it]); });
    return static_cast<double>(equal) / static_cast<double>(std::max(of_a.size(), of_b.size()));
  }

  // A longest common row of equal subtrees.
  void align_equal(std::vector<std::uint32_t> of_a, std::vector<std::uint32_t> of_b) {
    const auto add_equal = [this](std::uint32_t a, std::uint32_t b) {
      if (is_free(a_, to_new(), a) && is_free(b_, to_old(), b)) add_subtree(a, b);
    };
    std::size_t first = 0;
    const auto are_equal = [&](std::size_t i, std::size_t j) {
      return a_.whole[of_a[i]] == b_.whole[of_b[j]];
    };
    for (; first < std::min(of_a.size(), of_b.size()) && are_equal(first, first); ++first) {
      add_equal(of_a[first], of_b[first]);
    }
    while (std::min(of_a.size(), of_b.size()) > first &&
           are_equal(of_a.size() - 1, of_b.size() - 1)) {
      add_equal(of_a.back(), of_b.back());
      of_a.pop_back();
      of_b.pop_back();
    }
    const std::size_t rows = of_a.size() - first, columns = of_b.size() - first;
    if (rows == 0 || columns == 0 || rows * columns > kMostPairs) return;
    // From each place to the ends: how many are equal.
    std::vector<std::uint32_t> most((rows + 1) * (columns + 1));
    const auto at = [&](std::size_t i, std::size_t j) -> std::uint32_t& {
      return most[i * (columns + 1) + j];
    };
    for (std::size_t i = rows; i-- > 0;) {
      for (std::size_t j = columns; j-- > 0;) {
        at(i, j) = are_equal(first + i, first + j) ? at(i + 1, j + 1) + 1
                                                   : std::max(at(i + 1, j), at(i, j + 1));
      }
    }
    for (std::size_t i = 0, j = 0; i < rows && j < columns;) {
      if (are_equal(first + i, first + j)) {
        add_equal(of_a[first + i++], of_b[first + j++]);
      } else if (at(i + 1, j) >= at(i, j + 1)) {
        ++i;
      } else {
        ++j;
      }
    }
  }

  // Each has nodes below it that stay, and none of them below the other one.
  bool is_around_others(std::uint32_t a, std::uint32_t b) const {
    bool has_matched = false;
    for (std::uint32_t i = a + 1; i < a_.node(a).end; ++i) {
      const std::uint32_t partner = matching_.to_new[i];
      if (partner != kNoNode && partner > b && partner < b_.node(b).end) return false;
      has_matched |= partner != kNoNode;
    }
    return has_matched && !is_free(b_, to_old(), b);
  }

  template <class MayBe>
  void pair_in_order(const std::vector<std::uint32_t>& of_a, const std::vector<std::uint32_t>& of_b,
                     MayBe may_be) {
    auto next = of_b.begin();
    for (const std::uint32_t a : of_a) {
      const auto last = next + std::min<std::ptrdiff_t>(of_b.end() - next, 64);
      const auto b = std::find_if(
          next, last, [&](std::uint32_t it) { return to_old()[it] == kNoNode && may_be(a, it); });
      if (b == last) continue;
      add(a, *b);
      next = b + 1;
    }
  }

  // Both have children, or both have none.
  bool is_leaf(std::uint32_t a, std::uint32_t b) const {
    return (a_.size(a) == 1) == (b_.size(b) == 1);
  }

  using Name = std::pair<std::string_view, std::string_view>;  // of its kind and of the node
  // The node of each name that only one has; kNoNode: several have it.
  static std::map<Name, std::uint32_t> unique_names(const MatchedTree& tree) {
    std::map<Name, std::uint32_t> names;
    for (std::uint32_t i = 0; i < tree.whole.size(); ++i) {
      const DefinitionNode& node = tree.node(i);
      if (!is_named(tree.definition, node)) continue;
      const auto [it, is_first] = names.emplace(Name(node.type->id, node.name), i);
      if (!is_first) it->second = kNoNode;
    }
    return names;
  }

  // Nodes that have changed, and perhaps moved, if their names tell it.
  void match_names() {
    const auto of_a = unique_names(a_), of_b = unique_names(b_);
    for (const auto& [name, a] : of_a) {
      const auto found = of_b.find(name);
      if (a == kNoNode || found == of_b.end() || found->second == kNoNode) continue;
      if (to_new()[a] == kNoNode && to_old()[found->second] == kNoNode) add(a, found->second);
    }
    std::unordered_map<std::string_view, std::uint32_t> with_path;
    for (std::uint32_t b = 0; b < b_.paths.size(); ++b) {
      if (to_old()[b] == kNoNode) with_path.emplace(b_.paths[b], b);
    }
    for (std::uint32_t a = 0; a < a_.paths.size(); ++a) {
      if (to_new()[a] != kNoNode) continue;
      const auto found = with_path.find(a_.paths[a]);
      if (found == with_path.end() || to_old()[found->second] != kNoNode) continue;
      if (same_kind(a, found->second) && same_name(a, found->second)) add(a, found->second);
    }
  }

  const MatchedTree &a_, &b_;
  Matching matching_;
  std::vector<bool> is_whole_;  // of the old nodes: matched with an equal subtree
};

// Editors keep what they know of a node in such attributes, and write it anew with each save: _uid.
bool is_of_editor(const WrittenAttribute& it) {
  constexpr std::string_view kRemaps = "_autoremap";
  if (!it.name.starts_with('_')) return false;
  return it.name != kRemaps || it.value == "false" || it.value == "0";
}

}  // namespace

std::vector<NodeValue> values_of(const Definition& definition, const DefinitionNode& node) {
  std::vector<NodeValue> values;
  const auto written = definition.attributes(node);
  // What stands for another robot is where its parent is: its values are of the team.
  const DefinitionNode& parent =
      definition.nodes[&node == definition.nodes.data() ? 0 : node.parent];
  const bool has_element = &node == &parent || node.place.byte != parent.place.byte;
  const auto& parameters = node.type->parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto attribute = std::ranges::find(written, parameters[i].name, &WrittenAttribute::name);
    const bool is_written = attribute != written.end();
    const Port& port = definition.ports[node.first + i];
    const Value* const constant = definition.constant(node, i);
    if (!is_written && constant == nullptr) continue;
    const std::string shown(is_written ? std::string(attribute->value) : to_text(*constant));
    if (is_written && (port.script != Port::kNone || constant == nullptr)) {
      values.push_back(
          {parameters[i].name, port.script == Port::kNone ? shown : without_blanks(shown), shown});
    } else {
      values.push_back({parameters[i].name, to_text(*constant), shown, is_written || !has_element});
    }
  }
  for (const WrittenAttribute& it : written) {
    if (std::ranges::find(parameters, it.name, &Parameter::name) != parameters.end()) continue;
    const bool is_script = is_hook(definition, node, it.name);
    if (is_of_editor(it) && !is_script) continue;
    std::string shown(it.value);
    std::string text = is_script ? without_blanks(shown) : shown;
    values.push_back({it.name, std::move(text), std::move(shown)});
  }
  return values;
}

bool is_named(const Definition& definition, const DefinitionNode& node) {
  if (node.name == node.type->id) return false;
  const auto written = definition.attributes(node);
  const auto id = std::ranges::find(written, "ID", &WrittenAttribute::name);
  return id == written.end() || id->value != node.name;
}

MatchedTree::MatchedTree(const Definition& of) : definition(of), paths(paths_of(of)) {
  const std::size_t size = definition.nodes.size();
  own.resize(size);
  whole.resize(size);
  for (auto i = static_cast<std::uint32_t>(size); i-- > 0;) {
    std::uint64_t hash = mix(mix(1, node(i).type->id), node(i).name);
    // In any order.
    std::uint64_t sum = 0;
    for (const NodeValue& it : values_of(definition, node(i))) {
      if (it.is_written) sum += mix(mix(2, it.name), std::string_view(it.text));
    }
    own[i] = mix(hash, sum);
    hash = own[i];
    for (std::uint32_t child = i + 1; child < node(i).end; child = node(child).end) {
      hash = mix(hash, whole[child]);
    }
    whole[i] = hash;
  }
}

Matching match(const MatchedTree& old_tree, const MatchedTree& new_tree) {
  return Matcher(old_tree, new_tree).run();
}

}  // namespace lockstep::host
