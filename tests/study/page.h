// A page of docs/ that has commands and tables of what comes out of them. A comment in front of a
// table says what its columns are; its study is the last one before it:
//
//   lockstep study trees/paper/example5.xml --runs 1000 --grid noise=0,0.01 --grid …
//
//   <!-- table: barrier_count | noise=0 | noise=0.01; at_barrier=wait progress-distance -->
//
// A column is the name of an axis of the grid: its cells choose the row. Or it is "-": text. Or it
// has values of axes, a measure, node=NODE if there are several, and a statistic: a column of
// summary.csv, or failures or successes, which count. Without one it is the box: "**median** [lower
// quartile, upper quartile] minimum … maximum", or one number if all are the same. What stands
// after ";" belongs to every column. "a/b" makes two numbers of a cell: "noise=0
// at_barrier=wait/tick median" is "80.0, 80.4".
//
//   <!-- compare: barrier_count | noise=0→0.01; progress-distance -->
//
// compares two cells for each cell of the table: "→" in a column, or in the first cell of a row, is
// between their values. The cell has what `lockstep study compare` prints of them: the shift, and
// in brackets its interval; or one number if all are the same.
#pragma once

#include <string>

namespace lockstep::host::test {

// Makes the studies of the page and compares every number of the tables that follow them.
void check_page(const std::string& file, int studies, int numbers);

}  // namespace lockstep::host::test
