// docs/deadlocks.md: what `check` says of members that may wait for ever, beside circles of
// barriers.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <span>
#include <string>

#include "language/pipeline.h"

namespace lockstep::host::test {
namespace {

struct AdviceRow {
  std::string_view claim, declared, tree, told, run, options = {};
};

void check_rows(std::span<const AdviceRow> rows) {
  for (const AdviceRow& row : rows) {
    INFO(row.claim);
    Pipeline pipeline(
        fmt::format("<root lockstep=\"1\"><plugin name=\"motion\"/><plugin name=\"robot\"/>{}"
                    "<BehaviorTree ID=\"T\">\n{}</BehaviorTree></root>",
                    row.declared, row.tree),
        row.options);
    pipeline.advise();
    CHECK(pipeline.told() == row.told);
    CHECK(pipeline.run().starts_with(row.run));
  }
}

TEST_CASE("keep: members that are held for each other while one keeps what both need") {
  constexpr std::string_view kPool = R"(<resources name="pool"/>)";
  constexpr std::string_view kBoth =
      R"(<resources name="pool"/><barrier name="b" barriers="0.5"/>)";
  constexpr AdviceRow kRows[] = {
      {"children of a synchronized node", kPool, R"(<ParallelRelative delta="0.2">
<UseResources name="u1" pool="pool" resources="A" keep="true"><Advance step="0.05"/></UseResources>
<UseResources name="u2" pool="pool" resources="A"><Advance step="0.05"/></UseResources>
</ParallelRelative>)",
       "3:1 warning: held nodes may deadlock: ParallelRelative -> pool -> ParallelRelative",
       "running"},
      {"below its children", kPool, R"(<ParallelAbsolute barriers="0.5">
<Parallel><UseResources name="u1" pool="pool" resources="A;B" keep="true"><Advance step="0.05"/>
</UseResources></Parallel>
<ForceSuccess><UseResources name="u2" pool="pool" resources="B;C"><Advance step="0.05"/>
</UseResources></ForceSuccess></ParallelAbsolute>)",
       "3:1 warning: held nodes may deadlock: ParallelAbsolute -> pool -> ParallelAbsolute",
       "running"},
      {"each has a member of a barrier in it", kBoth, R"(<Parallel>
<UseResources name="u1" pool="pool" resources="A" keep="true"><SyncProgress barrier="b">
<Advance step="0.05"/></SyncProgress></UseResources>
<UseResources name="u2" pool="pool" resources="A"><SyncProgress barrier="b">
<Advance step="0.05"/></SyncProgress></UseResources></Parallel>)",
       "5:1 warning: held nodes may deadlock: pool -> b -> pool", "running"},
      {"each is in a member of a barrier", kBoth, R"(<Parallel>
<SyncProgress barrier="b"><UseResources name="u1" pool="pool" resources="A" keep="true">
<Advance step="0.05"/></UseResources></SyncProgress>
<SyncProgress barrier="b"><UseResources name="u2" pool="pool" resources="A">
<Advance step="0.05"/></UseResources></SyncProgress></Parallel>)",
       "5:27 warning: held nodes may deadlock: pool -> b -> pool", "running"},
      {"not without keep: each gets its turn", kBoth, R"(<Parallel>
<UseResources name="u1" pool="pool" resources="A"><SyncProgress barrier="b">
<Advance step="0.05"/></SyncProgress></UseResources>
<UseResources name="u2" pool="pool" resources="A"><SyncProgress barrier="b">
<Advance step="0.05"/></SyncProgress></UseResources></Parallel>)",
       "", "success"},
      {"not with other resources", kPool, R"(<ParallelRelative delta="0.2">
<UseResources pool="pool" resources="A" keep="true"><Advance step="0.05"/></UseResources>
<UseResources pool="pool" resources="B"><Advance step="0.05"/></UseResources>
</ParallelRelative>)",
       "", "success"},
      {"not below a node that never holds", kPool, R"(<ParallelRelative delta="1">
<UseResources pool="pool" resources="A" keep="true"><Advance step="0.05"/></UseResources>
<UseResources pool="pool" resources="A"><Advance step="0.05"/></UseResources>
</ParallelRelative>)",
       "", "success"},
      {"not in one child of it: they are held together", kPool, R"(<ParallelRelative delta="0.2">
<Parallel><UseResources pool="pool" resources="A" keep="true"><Advance step="0.05"/></UseResources>
<UseResources pool="pool" resources="A"><Advance step="0.05"/></UseResources></Parallel>
<Advance step="0.01"/></ParallelRelative>)",
       "", "success"},
      {"not where the other one needs them only behind the last barrier", kPool,
       R"(<ParallelAbsolute barriers="0.5">
<UseResources pool="pool" resources="A" keep="true"><Advance step="0.05"/></UseResources>
<Sequence memory="true"><Advance step="0.05"/>
<UseResources pool="pool" resources="A"><Advance step="0.05"/></UseResources></Sequence>
</ParallelAbsolute>)",
       "", "success"},
      {"but where it needs them before", kPool, R"(<ParallelAbsolute barriers="0.75">
<UseResources name="u1" pool="pool" resources="A" keep="true"><Advance step="0.05"/></UseResources>
<Sequence memory="true"><Advance step="0.05"/>
<UseResources name="u2" pool="pool" resources="A"><Advance step="0.05"/></UseResources></Sequence>
</ParallelAbsolute>)",
       "3:1 warning: held nodes may deadlock: ParallelAbsolute -> pool -> ParallelAbsolute",
       "running"},
      {"not where it has given them back before the barrier", kPool,
       R"(<ParallelAbsolute barriers="0.75">
<Sequence memory="true">
<UseResources pool="pool" resources="A" keep="true"><Advance step="0.05"/></UseResources>
<Advance step="0.05"/></Sequence>
<UseResources pool="pool" resources="A"><Advance step="0.05"/></UseResources>
</ParallelAbsolute>)",
       "", "success"},
      {"resources from an entry: by its start value", R"(<resources name="pool" resources="A"/>)",
       R"(<ParallelRelative delta="0.2">
<UseResources name="u1" pool="pool" resources="{r}" keep="true"><Advance step="0.05"/></UseResources>
<UseResources name="u2" pool="pool" resources="A"><Advance step="0.05"/></UseResources>
</ParallelRelative>)",
       "3:1 warning: held nodes may deadlock: ParallelRelative -> pool -> ParallelRelative",
       "running", "set.r=A"},
      {"limits from an entry may be anywhere", kPool, R"(<ParallelAbsolute barriers="{b}">
<UseResources name="u1" pool="pool" resources="A" keep="true"><Advance step="0.05"/></UseResources>
<UseResources name="u2" pool="pool" resources="A"><Advance step="0.05"/></UseResources>
</ParallelAbsolute>)",
       "3:1 warning: held nodes may deadlock: ParallelAbsolute -> pool -> ParallelAbsolute",
       "running", "set.b=0.5"},
      {"not known: resources from an entry without a value",
       R"(<resources name="pool" resources="A"/>)",
       R"(<ParallelRelative delta="0.2">
<UseResources name="u1" pool="pool" resources="{r}" keep="true"><Advance step="0.05"/></UseResources>
<UseResources name="u2" pool="pool" resources="A"><Advance step="0.05"/></UseResources>
</ParallelRelative>)",
       "3:48 warning: nothing writes '{r}'", "fault"},
  };
  check_rows(kRows);
}

TEST_CASE("keep: without it and with increment=0, the first in the tree always wins") {
  constexpr AdviceRow kRows[] = {
      {"the first in the tree always wins, though its child is held",
       R"(<resources name="pool" increment="0"/><barrier name="b" barriers="0.5"/>)", R"(<Parallel>
<UseResources pool="pool" resources="A"><Parallel>
<SyncProgress barrier="b"><Advance step="0.05"/></SyncProgress><Advance step="0.1"/></Parallel>
</UseResources>
<UseResources pool="pool" resources="A"><SyncProgress barrier="b">
<Advance step="0.05"/></SyncProgress></UseResources></Parallel>)",
       "1:65 warning: the members of 'pool' may wait indefinitely\n"
       "6:1 warning: held nodes may deadlock: pool -> b -> pool",
       "running"},
  };
  check_rows(kRows);
}

TEST_CASE("fairness is not promised to members of a pool that are held") {
  constexpr std::string_view kPool = R"(<resources name="pool"/>)";
  constexpr std::string_view kBoth =
      R"(<resources name="pool"/><barrier name="b" barriers="0.5"/>)";
  constexpr AdviceRow kRows[] = {
      {"below a synchronized node", kPool, R"(<Parallel><ParallelRelative name="r" delta="0.1">
<UseResources name="u1" pool="pool" resources="A"><Advance step="0.1"/></UseResources>
<Advance step="0.1"/></ParallelRelative>
<UseResources name="u2" pool="pool" resources="A"><Advance step="0.1"/></UseResources></Parallel>)",
       "3:1 note: 'pool' is not fair to 'u1', from which 'r' withholds ticks", "success"},
      {"inside of a barrier, once for a pool", kBoth, R"(<Parallel>
<SyncProgress barrier="b">
<UseResources name="u1" pool="pool" resources="A"><Advance step="0.1"/></UseResources></SyncProgress>
<SyncProgress barrier="b">
<UseResources name="u2" pool="pool" resources="A"><Advance step="0.1"/></UseResources></SyncProgress>
</Parallel>)",
       "4:1 note: 'pool' is not fair to 'u1', from which 'b' withholds ticks, and to 1 more",
       "success"},
      {"not where nobody outside needs the same", kPool,
       R"(<ParallelRelative delta="0.1"><Parallel>
<UseResources pool="pool" resources="A"><Advance step="0.1"/></UseResources>
<UseResources pool="pool" resources="A"><Advance step="0.1"/></UseResources></Parallel>
<UseResources pool="pool" resources="B"><Advance step="0.1"/></UseResources></ParallelRelative>)",
       "", "success"},
      {"not below a node that never holds", kPool, R"(<ParallelAbsolute barriers="">
<UseResources pool="pool" resources="A"><Advance step="0.1"/></UseResources>
<UseResources pool="pool" resources="A"><Advance step="0.1"/></UseResources></ParallelAbsolute>)",
       "", "success"},
      {"not around a barrier", kBoth, R"(<Parallel>
<UseResources pool="pool" resources="A"><SyncProgress barrier="b"><Advance step="0.1"/>
</SyncProgress></UseResources>
<UseResources pool="pool" resources="A"><SyncProgress barrier="b"><Advance step="0.1"/>
</SyncProgress></UseResources></Parallel>)",
       "", "success"},
  };
  check_rows(kRows);
}

TEST_CASE("members that may never run: the others wait for them for ever") {
  constexpr std::string_view kWait = R"(<barrier name="b" barriers="0.5"/>)";
  constexpr std::string_view kIgnore = R"(<barrier name="b" barriers="0.5" idle="ignore"/>)";
  constexpr AdviceRow kRows[] = {
      {"a branch", kWait, R"(<Parallel>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress>
<IfThenElse name="if"><IsOpen open="false"/><SyncProgress name="m" barrier="b"><Advance step="0.1"/>
</SyncProgress><AlwaysSuccess/></IfThenElse></Parallel>)",
       "4:45 note: the others at 'b' wait for 'm' indefinitely if 'if' does not run it", "running"},
      {"not the condition", kWait, R"(<Parallel>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress>
<IfThenElse><SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress><AlwaysSuccess/>
</IfThenElse></Parallel>)",
       "", "success"},
      {"a branch of WhileDoElse", kWait, R"(<Parallel>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress>
<WhileDoElse name="w"><IsOpen open="false"/><SyncProgress name="m" barrier="b"><Advance step="0.1"/>
</SyncProgress><AlwaysSuccess/></WhileDoElse></Parallel>)",
       "4:45 note: the others at 'b' wait for 'm' indefinitely if 'w' does not run it", "running"},
      {"a branch of Switch, also the first", kWait, R"(<Parallel>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress>
<Switch name="s" on="1" cases="0">
<Sequence><SyncProgress name="m" barrier="b"><Advance step="0.1"/></SyncProgress></Sequence>
<AlwaysSuccess/></Switch></Parallel>)",
       "5:11 note: the others at 'b' wait for 'm' indefinitely if 's' does not run it", "running"},
      {"a later child of a Fallback", kWait, R"(<Parallel>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress>
<Fallback name="f" memory="true"><AlwaysSuccess/>
<SyncProgress name="m" barrier="b"><Advance step="0.1"/></SyncProgress></Fallback></Parallel>)",
       "5:1 note: the others at 'b' wait for 'm' indefinitely if 'f' does not run it", "running"},
      {"not the first child of a Fallback", kWait, R"(<Parallel>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress>
<Fallback memory="true"><SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress>
<AlwaysSuccess/></Fallback></Parallel>)",
       "", "success"},
      {"a RunOnce that is ticked again", kWait, R"(<Repeat times="2"><Parallel>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress>
<RunOnce name="o"><SyncProgress name="m" barrier="b"><Advance step="0.1"/></SyncProgress></RunOnce>
</Parallel></Repeat>)",
       "4:19 note: the others at 'b' wait for 'm' indefinitely if 'o' does not run it", "running"},
      {"not a RunOnce that is not", kWait, R"(<Parallel>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress>
<RunOnce><SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress></RunOnce></Parallel>)",
       "", "success"},
      {"a Rate that is ticked again", kWait, R"(<Repeat times="2"><Parallel>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress>
<Rate name="r" seconds="900">
<SyncProgress name="m" barrier="b"><Advance step="0.1"/></SyncProgress></Rate>
</Parallel></Repeat>)",
       "5:1 note: the others at 'b' wait for 'm' indefinitely if 'r' does not run it", "running"},
      {"a script that ends it", kWait, R"(<Parallel>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress>
<Sequence name="s" success_if="true"><SyncProgress name="m" barrier="b"><Advance step="0.1"/>
</SyncProgress></Sequence></Parallel>)",
       "4:38 note: the others at 'b' wait for 'm' indefinitely if 's' does not run it", "running"},
      {"not a script that skips it", kWait, R"(<Parallel>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress>
<SyncProgress barrier="b" skip_if="true"><Advance step="0.1"/></SyncProgress></Parallel>)",
       "", "success"},
      {"not with idle=ignore", kIgnore, R"(<Parallel>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress>
<IfThenElse><IsOpen open="false"/><SyncProgress barrier="b"><Advance step="0.1"/>
</SyncProgress><AlwaysSuccess/></IfThenElse></Parallel>)",
       "", "success"},
      {"not what is around all of the members", kWait, R"(<IfThenElse><IsOpen open="false"/>
<AlwaysSuccess/><Parallel>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress></Parallel></IfThenElse>)",
       "", "success"},
  };
  check_rows(kRows);
}

TEST_CASE("members that begin again after a failure: a barrier that ignores idle ones may open") {
  constexpr std::string_view kWait = R"(<barrier name="b" barriers="0.5"/>)";
  constexpr std::string_view kIgnore = R"(<barrier name="b" barriers="0.5" idle="ignore"/>)";
  constexpr std::string_view kNote =
      "3:1 note: after a failure of 'm', 'b' does not wait for it while 'w' runs";
  constexpr AdviceRow kRows[] = {
      {"a Wait in front of it", kIgnore,
       R"(<Parallel><Retry attempts="9"><Sequence memory="true"><Wait name="w" seconds="0.03"/>
<SyncProgress name="m" barrier="b"><Advance step="0.1"/></SyncProgress></Sequence></Retry>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress></Parallel>)",
       kNote, "success"},
      {"a Delay around it", kIgnore,
       R"(<Parallel><Retry attempts="9"><Delay name="w" seconds="0.03">
<SyncProgress name="m" barrier="b"><Advance step="0.1"/></SyncProgress></Delay></Retry>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress></Parallel>)",
       kNote, "success"},
      {"in a Repeat, and farther out", kIgnore,
       R"(<Parallel><ForceSuccess><Repeat times="2"><Sequence memory="true"><Delay name="w" seconds="0.03"><AlwaysSuccess/></Delay><Parallel>
<SyncProgress name="m" barrier="b"><Advance step="0.1"/></SyncProgress></Parallel></Sequence></Repeat></ForceSuccess>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress></Parallel>)",
       kNote, "success"},
      {"not with idle=wait: it stays closed", kWait,
       R"(<Parallel><Retry attempts="9"><Sequence memory="true"><Wait seconds="0.03"/>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress></Sequence></Retry>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress></Parallel>)",
       "", "success"},
      {"not without the Retry", kIgnore, R"(<Parallel><Sequence memory="true"><Wait seconds="0.03"/>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress></Sequence>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress></Parallel>)",
       "", "success"},
      {"not with a Retry around the barrier", kIgnore,
       R"(<Retry attempts="9"><Sequence memory="true"><Wait seconds="0.03"/><Parallel>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress></Parallel></Sequence></Retry>)",
       "", "success"},
      {"not with a Wait behind it, or around the Retry", kIgnore,
       R"(<Parallel><Sequence memory="true"><Wait seconds="0.03"/><Retry attempts="9">
<Sequence memory="true"><SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress>
<Wait seconds="0.03"/></Sequence></Retry></Sequence>
<SyncProgress barrier="b"><Advance step="0.1"/></SyncProgress></Parallel>)",
       "", "success"},
  };
  check_rows(kRows);
}

}  // namespace
}  // namespace lockstep::host::test
