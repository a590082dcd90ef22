#include "leaves/plugin/contract/described_types.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "base/core/plugin_exception.h"
#include "base/system/call_mark.h"
#include "base/system/mutex.h"
#include "leaves/plugin/contract/descriptor_leaf.h"

namespace lockstep::host {
namespace {

using Answer = tl::expected<const lockstep_leaf_type*, ElementRefusal>;

constexpr std::string_view kMalformed = " is malformed: ", kUndescribed = "' cannot be described";

tl::unexpected<ElementRefusal> undescribed(std::string message, std::string hint) {
  return tl::unexpected(ElementRefusal{{}, {std::move(message), std::move(hint)}});
}

// What a tree sees of the ports, in the order of their names.
std::vector<std::string> ports_of(const lockstep_leaf_type& type) {
  std::vector<std::string> ports;
  for (const lockstep_port* const it : std::span(type.ports, type.port_count))
    ports.push_back(fmt::format("{} {} {} {}", it->name, it->type, it->direction, it->flags));
  std::ranges::sort(ports);
  return ports;
}

// Texts that end with a NUL, for the plugin.
struct FixedTable {
  explicit FixedTable(std::span<const FixedText> fixed) {
    for (const auto& [parameter, text] : fixed) {
      texts.emplace_back(parameter, text);
    }
    for (const auto& [parameter, text] : texts) {
      rows.push_back({parameter.c_str(), text.c_str()});
    }
  }
  std::vector<std::pair<std::string, std::string>> texts;
  std::vector<lockstep_fixed> rows;
};

class DescribedTypes final : public ElementTypes {
 public:
  DescribedTypes(const HostedPlugin& plugin, const Descriptors::Leaf& leaf)
      : plugin_(plugin), leaf_(leaf) {}

  tl::expected<const NodeType*, ElementRefusal> type_of(
      std::span<const FixedText> fixed) const override {
    std::vector<std::string> key;
    for (const auto& [parameter, text] : fixed) {
      key.emplace_back(parameter);
      key.emplace_back(text);
    }
    const Lock lock(mutex_);
    if (const auto known = known_.find(key); known != known_.end()) return known->second.type();
    return known_.emplace(std::move(key), make(fixed)).first->second.type();
  }

  std::string asked_again(std::span<const FixedText> fixed) const override {
    const auto before = type_of(fixed);
    // The plugin may write the second answer over the first.
    const auto ports = before ? ports_of(*(*before)->leaf) : std::vector<std::string>();
    const Known again = make(fixed);
    if (again.leaf == nullptr)
      return before ? "is not described twice: " + again.refusal.why.message : std::string();
    if (!before) return "is described only when it is asked again: " + before.error().why.message;
    if (ports_of(again.leaf->type) == ports) return {};
    return "has other ports when it is described again: the same constants give the same ports";
  }

 private:
  struct Known {
    std::unique_ptr<Descriptors::Leaf> leaf;
    ElementRefusal refusal;

    tl::expected<const NodeType*, ElementRefusal> type() const {
      if (leaf == nullptr) return tl::unexpected(refusal);
      return &leaf->node_type;
    }
  };

  Known make(std::span<const FixedText> fixed) const {
    const Answer answer = ask(fixed);
    if (!answer) return {nullptr, answer.error()};
    // What it points to is the plugin's, and so is a crash.
    std::optional<MarkedCall> mark;
    if (plugin_.describer == nullptr)
      mark.emplace(CallSite::of_plugin(plugin_.name), PluginFunction::Describe);
    auto leaf = std::make_unique<Descriptors::Leaf>();
    if (auto refusal = read_leaf(*answer, plugin_.name, *leaf))
      return {nullptr, malformed(*refusal)};
    if (auto refusal = check_against_base(leaf->type)) return {nullptr, malformed(*refusal)};
    leaf->type.id = leaf_.type.id;
    leaf->node_type = node_type_of(plugin_, *leaf);
    return {std::move(leaf), {}};
  }

  // `refusal` is about "it", the leaf type.
  ElementRefusal malformed(const Problem& refusal) const {
    return {{},
            {fmt::format("plugin '{}'{}what it describes for '{}' {}", plugin_.name, kMalformed,
                         leaf_.type.id, refusal.message),
             refusal.hint}};
  }

  std::optional<Problem> check_against_base(const lockstep_leaf_type& described) const {
    if (std::string_view(described.id) != leaf_.type.id || described.kind != leaf_.type.kind) {
      return Problem{fmt::format("is '{}'", described.id),
                     "describe returns a type of the same id and kind"};
    }
    if (described.describe == nullptr) return std::nullopt;
    return Problem{"describes elements again", "set describe to NULL in what it returns"};
  }

  Answer ask(std::span<const FixedText> fixed) const {
    if (plugin_.describer != nullptr) return plugin_.describer->describe(leaf_.type.id, fixed);
    const FixedTable table(fixed);
    lockstep_refusal why{};
    why.struct_size = sizeof why;
    const lockstep_leaf_type* type = nullptr;
    const MarkedCall mark(CallSite::of_plugin(plugin_.name), PluginFunction::Describe);
    const std::string thrown = thrown_by([&] {
      type = leaf_.type.describe(table.rows.data(), static_cast<std::uint32_t>(table.rows.size()),
                                 &why);
    });
    constexpr const char* kHint = "the author of the plugin knows what it needs";
    if (!thrown.empty()) {
      return undescribed(fmt::format("'{}{}: its describe {}", leaf_.type.id, kUndescribed, thrown),
                         kHint);
    }
    if (type != nullptr) return type;
    if (why.message != nullptr) {
      return tl::unexpected(ElementRefusal{std::string(text_or_empty(why.port)),
                                           {why.message, std::string(text_or_empty(why.hint))}});
    }
    return undescribed(fmt::format("'{}{}, and gives no reason", leaf_.type.id, kUndescribed),
                       kHint);
  }

  const HostedPlugin& plugin_;
  const Descriptors::Leaf& leaf_;
  mutable Mutex mutex_;
  mutable std::map<std::vector<std::string>, Known> known_ LOCKSTEP_GUARDED_BY(mutex_);
};

}  // namespace

bool is_breach(const ElementRefusal& refusal) {
  const std::string_view message = refusal.why.message;
  return (message.starts_with("plugin '") && message.find(kMalformed) != message.npos) ||
         message.find(kUndescribed) != message.npos;
}

std::string_view port_without_pattern(const NodeType& type, const NodeType& described) {
  for (const Parameter& it : described.parameters) {
    const bool is_own =
        std::ranges::find(type.parameters, it.name, &Parameter::name) != type.parameters.end();
    if (!is_own && !matches_any(type.more_parameters, it.name)) return it.name;
  }
  return {};
}

std::string describes_nothing(const NodeType& type) {
  return fmt::format(
      "'{}' has no element: describe refuses each choice and default of its fixed "
      "ports",
      type.id);
}

std::unique_ptr<const ElementTypes> described_types(const HostedPlugin& plugin,
                                                    const Descriptors::Leaf& leaf) {
  return std::make_unique<DescribedTypes>(plugin, leaf);
}

}  // namespace lockstep::host
