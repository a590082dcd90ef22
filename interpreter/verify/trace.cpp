#include "verify/trace.h"

#include <algorithm>

namespace lockstep::host {

Tracer::Tracer(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
               Nanoseconds period, const SearchResult& found)
    : tree_(tree),
      models_(models),
      found_(found),
      stepper_(tree, models, properties, period),
      labeller_(tree, models, properties.size()) {}

Step Tracer::step_of(const CycleStep& wanted) {
  stepper_.load(found_.store[wanted.from], wanted.from == 0);
  const auto to = found_.store[wanted.edge.to];
  Step step{wanted.from, 0};
  do {
    const Status status = stepper_.tick();
    const bool goes_on = status == Status::Running && !stepper_.ticker().faulted();
    const bool is_label =
        std::ranges::equal(labeller_.of(stepper_), found_.graph.labels[wanted.edge.label]);
    if (goes_on && is_label && std::ranges::equal(stepper_.fold(), to)) return step;
    ++step.combination;
  } while (stepper_.next());
  return step;  // not reached: the edge is of this search
}

std::vector<Step> Tracer::steps_of(std::span<const CycleStep> edges) {
  std::vector<Step> steps;
  for (const CycleStep& it : edges) steps.push_back(step_of(it));
  return steps;
}

void Tracer::play(std::span<const Step> run, const After& after) {
  for (std::size_t tick = 0; tick < run.size(); ++tick) {
    const Step& step = run[tick];
    stepper_.load(found_.store[step.from], step.from == 0);
    Status status = stepper_.tick();
    for (std::uint32_t i = 0; i < step.combination; ++i) {
      stepper_.next();
      status = stepper_.tick();
    }
    after(stepper_, status, tick);
  }
}

LeafScripts Tracer::scripts(std::span<const Step> run) {
  LeafScripts scripts;
  scripts.ticks = run.size();
  play(run, [&](Stepper&, Status, std::size_t) { add_words(scripts); });
  return scripts;
}

void Tracer::add_words(LeafScripts& scripts) {
  const auto marks = stepper_.leaves().marks();
  for (std::size_t leaf = 0; leaf < marks.size(); ++leaf) {
    const LeafMark& mark = marks[leaf];
    if (!mark.ticked && !mark.drifted) continue;
    auto& words = scripts.leaves[tree_.path(tree_.leaves[leaf].node)];
    if (mark.drifted) {
      words.push_back({.kind = LeafWord::Kind::Held, .progress = mark.held_progress});
    }
    if (!mark.ticked) continue;
    LeafWord word{.kind = mark.faulted ? LeafWord::Kind::Fault : LeafWord::Kind::Tick,
                  .status = mark.result,
                  .progress = mark.result == Status::Running ? mark.progress : 0};
    const auto& outputs = models_.leaves[leaf].outputs;
    for (std::size_t i = 0; i < mark.written.size(); ++i) {
      const auto& output = outputs[i % outputs.size()];
      word.written.emplace_back(tree_.leaves[leaf].type->parameters[output.port].name,
                                to_text(output.values[mark.written[i]]));
    }
    words.push_back(std::move(word));
  }
}

}  // namespace lockstep::host
