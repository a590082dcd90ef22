#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kHeldSubtreeRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"every running leaf of a held subtree is told once, and again when its tick comes",
   "ParallelAbsolute[barriers=.5](a Parallel(b Inverter(c) Sequence(d)))",
   "a=R.1R.1R.5 b=R.6 c=R.7 d=R.8",
   "R[a b c d] R[a] pause[b c d] R[a] R[a b c d] resume[b c d]"},
  {"a leaf is resumed just before its tick",
   "ParallelAbsolute[barriers=.5](a Parallel(b c))", "a=R.1R.5 b=R.6 c=R.7",
   "R[a b c] R{tick a, pause b, pause c} R{tick a, resume b, tick b, resume c, tick c}"},
  {"a leaf that completed is not told",
   "ParallelAbsolute[barriers=.5](a Parallel(b c))", "a=R.1R.5 b=S c=R.7",
   "R[a b c] R[a] pause[c] R[a c] resume[c]"},
  {"a leaf that has not begun is not told",
   "ParallelAbsolute[barriers=.5](a Fallback(b c))", "a=R.1R.5 b=R.7 c=R",
   "R[a b] R[a] pause[b] R[a b] resume[b]"},
  {"a leaf can be paused again",
   "ParallelAbsolute[barriers=.5](a b)", "a=R~0,.1,.6,.1 b=R.6",
   "R[a b] R[a] pause[b] R[a b] resume[b] R[a] pause[b]"},
  {"a subtree goes on where it stood",
   "ParallelAbsolute[barriers=.5](a Sequence[memory=true](b c))", "a=R.1R.5 b=S c=R.7RS",
   "R[a b c] R[a] pause[c] R[a c] resume[c]"},
  {"the owner's halt reaches a paused leaf, which is not resumed",
   "ParallelAbsolute[barriers=.5](a b)", "a=R.1 b=R.6", "R[a b] R[a] pause[b] stop halt[a b]"},
  {"a leaf that was halted while paused starts anew",
   "Sequence(c? ParallelAbsolute[barriers=.5](a b))", "c=SSFS a=R.1 b=R.6",
   "R[c a b] R[c a] pause[b] F[c] halt[a b] R{start c, tick c, start a, tick a, start b, tick b}"},
  {"a leaf that its own parent leaves when ticks come again is halted, not resumed",
   "ParallelAbsolute[barriers=.5](a Sequence(c? b))", "a=R.1R.1R.6 b=R.6 c=SF",
   "R[a c b] R[a] pause[b] R[a] F[a c] halt[b a]"},

  {"absolute over relative: the inner node counts with its least advanced child",
   "ParallelAbsolute[barriers=.5](a ParallelRelative[delta=1](b c))", "a=R.1 b=R.9 c=R.4R.6",
   "R[a b c] R[a b c] R[a] pause[b c]"},
  {"a child that the inner node still holds stays paused",
   "ParallelAbsolute[barriers=.5](a ParallelRelative[delta=0](b c))", "a=R.1R.6 b=R.5R.8 c=R.8",
   "R[a b c] R[a] pause[b c] R[a b] resume[b] R[a b c] resume[c]"},
  {"a child that the inner node already holds is not paused twice",
   "ParallelAbsolute[barriers=.9](a ParallelRelative[delta=0](b c))", "a=R.1 b=R.5R.92 c=R.95",
   "R[a b c] R[a b] pause[c] R[a] pause[b]"},
  {"relative over absolute: the inner barriers are the inner node's own",
   "ParallelRelative[delta=.5](a ParallelAbsolute[barriers=.3](b c))", "a=R.3 b=R.1R.4 c=R.3",
   "R[a b c] R[a b] pause[c] R[a b c] resume[c]"},
  {"absolute in relative in absolute: each level holds for itself",
   "ParallelAbsolute[barriers=.5](a ParallelRelative[delta=.2](b ParallelAbsolute[barriers=.3](c d)))",
   "a=R.1 b=R.3R.6 c=R.3R.9 d=R.1R.7",
   "R[a b c d] R[a b d] pause[c] R[a c d] pause[b] resume[c] R[a] pause[c d]"},
};
// clang-format on

}  // namespace

TEST_CASE("held subtrees, and synchronized nodes in each other") {
  check_rows(kHeldSubtreeRows);
}

}  // namespace lockstep::host::test
