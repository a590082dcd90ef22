#include "unit/plugins/tree_run.h"

#include <stdexcept>

#include "engine/compile.h"
#include "engine/node_kind.h"
#include "support/paths.h"
#include "tree/resolve.h"

namespace lockstep::host::test {
namespace {

void require_none(const Diagnostics& diagnostics) {
  std::string messages;
  for (const Diagnostic& it : diagnostics.all()) messages += it.message + "; " + it.hint + "\n";
  if (!messages.empty()) throw std::invalid_argument(messages);
}

}  // namespace

TreeRunner::TreeRunner(const std::string& plugin, const std::string& nodes) {
  Diagnostics diagnostics;
  project_ = load_project_text(
      "tree.xml",
      "<root lockstep=\"1\"><BehaviorTree ID=\"Test\">" + nodes + "</BehaviorTree></root>", {},
      diagnostics);
  const std::string file = std::string(LOCKSTEP_BINARY_DIR) + "/plugins/" + plugin + ".so";
  plugins_.load_file(file, diagnostics);
  require_none(diagnostics);
  for (const NodeKind* kind : built_in_kinds()) catalog_.add(&kind->type);
  for (const NodeType* type : plugins_.types()) catalog_.add(type);
  const auto definition = resolve(*project_, catalog_, {}, diagnostics);
  plugins_.initialize(diagnostics);
  require_none(diagnostics);
  tree_ = compile(*definition);
}

TreeRunEnd TreeRunner::run(const TreeRunOptions& options) const {
  TreeRunEnd end;
  const Nanoseconds period = from_seconds(1 / options.rate);
  Run run(tree_, {options.seed, options.rate,
                  [&end](std::string_view, lockstep_log_level, std::string_view message) {
                    end.log.emplace_back(message);
                  }});
  Nanoseconds now{0};
  for (; end.status == Status::Running && to_seconds(now) < options.limit; now += period) {
    end.status = run.tick(now);
    if (run.fault() != nullptr) break;
    if (options.after_tick) options.after_tick(run.ticker());
  }
  if (run.fault() != nullptr) end.fault = run.fault()->message;
  end.seconds = to_seconds(now);
  return end;
}

NodeIndex TreeRunner::node(const std::string& name) const {
  for (NodeIndex index = 0; index < tree_.labels.size(); ++index) {
    if (tree_.labels[index].name == name) return index;
  }
  throw std::invalid_argument("no node '" + name + "'");
}

}  // namespace lockstep::host::test
