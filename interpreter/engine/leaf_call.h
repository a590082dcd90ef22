// The call of a leaf with everything around it: its mark, its time, the floating-point mode. Also
// the ordinary call, with as little as possible around it; engine/leaf_loop.h has the loop of
// those.
#pragma once

#include <cstdint>
#include <type_traits>

#include "engine/blackboard.h"
#include "engine/node_context.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

// Any call, also one that an exception ends and one within another.
class LeafCall {
 public:
  LeafCall(NodeContext& context, NodeIndex node, const LeafSlot& leaf, PluginFunction function)
      : context_(context),
        mark_(CallMark::this_thread()),
        node_(node),
        function_(function),
        around_(mark_.enter(*leaf.site, function)),
        in_line_(std::exchange(context.in_line_, nullptr)),
        in_leaf_(context.board_.lock.get()) {
    if (context.watch_ != nullptr) begun_ = context.watch_->begin(mark_, leaf.is_timed());
  }
  ~LeafCall() {
    mark_.leave(around_);
    if (context_.watch_ != nullptr) {
      const std::uint32_t place = context_.node(node_).params;
      context_.watch_->end(begun_, place, function_, mark_);
      context_.timer_ = context_.watch_->timer();
    }
    context_.in_line_ = context_.state_.interrupted ? nullptr : in_line_;
  }
  LeafCall(const LeafCall&) = delete;
  LeafCall& operator=(const LeafCall&) = delete;

  // A call with nothing around it but a mark and its time, for a leaf while can_be_in_line. After
  // an exception, which is a fault then, it returns -1, if anything.
  template <PluginFunction kFunction, class Result>
  [[gnu::always_inline]] static Result in_line(NodeContext& context, const LeafSlot& leaf,
                                               Result (*function)(void*)) {
    CallMark& mark = *context.in_line_;
    bool is_usual = true;
    return context.timer_ != nullptr
               ? marked<kFunction, true>(context, mark, leaf, function, is_usual)
               : marked<kFunction, false>(context, mark, leaf, function, is_usual);
  }
  static bool can_be_in_line(const NodeContext& context, const LeafSlot& leaf) {
    return context.in_line_ != nullptr && !leaf.is_timed();
  }
  // Of a leaf that is out. One whose fault was found while it was held has not fallen back: it has
  // the progress that it had, until its Failure. In nodes/leaf.cpp.
  static double last_progress(const NodeContext& context, NodeIndex node);

 private:
  friend class LeafLoop;

  // `is_usual`: nothing has happened but that the leaf has returned.
  template <PluginFunction kFunction, bool kTimed, class Result>
  [[gnu::always_inline]] static Result marked(NodeContext& context, CallMark& mark,
                                              const LeafSlot& leaf, Result (*function)(void*),
                                              bool& is_usual);
  static std::uint32_t place_of(const NodeContext& context, const LeafSlot& leaf) {
    return static_cast<std::uint32_t>(&leaf - context.leaves_.data());
  }
  // In nodes/leaf.cpp. What a tick in line has to do for a result that is not the usual one.
  static Status complete(NodeContext& context, NodeIndex node, LeafSlot& leaf,
                         lockstep_status result);
  static double spoiled_progress(NodeContext& context, NodeIndex node, double reported);
  static void note_exception(NodeContext& context, const LeafSlot& leaf);
  static void note_unusual(NodeContext& context, CallMark& mark, const LeafSlot& leaf,
                           PluginFunction function);

  NodeContext& context_;
  CallMark& mark_;
  const NodeIndex node_;
  const PluginFunction function_;
  const CallMark::Look around_;
  CallMark* const in_line_;
  LeafWatch::Begun begun_;
  const InLeaf in_leaf_;
};

template <PluginFunction kFunction, bool kTimed, class Result>
inline Result LeafCall::marked(NodeContext& context, CallMark& mark, const LeafSlot& leaf,
                               Result (*function)(void*), bool& is_usual) {
  mark.enter_alone(*leaf.site, kFunction);
  constexpr bool kHasResult = !std::is_void_v<Result>;
  [[maybe_unused]] std::conditional_t<kHasResult, Result, int> result = -1;
  try {
    if constexpr (kHasResult) {
      result = function(leaf.self);
    } else {
      function(leaf.self);
    }
  } catch (...) {
    note_exception(context, leaf);
  }
  is_usual = context.is_usual_.is_set();
  if (!is_usual) [[unlikely]]
    note_unusual(context, mark, leaf, kFunction);
  mark.leave_alone();
  if constexpr (kTimed) {
    context.timer_->note(place_of(context, leaf), kFunction, mark);
  }
  if constexpr (kHasResult) return result;
}

}  // namespace lockstep::host
