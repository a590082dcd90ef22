// "did you mean": the known word nearest to a mistyped one. The cost is bounded, whatever the
// number and length of the words: a document may have a million.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lockstep::host {

// The nearest word to one of two letters or more: the candidate with the smallest edit distance
// (insert, delete, replace, swap of neighbors; case does not count) if that is at most a third of
// the word's length, rounded up, and at most eight; else "". The first of several. A word of more
// than 256 bytes has no nearest word. If there are very many candidates, only the first ones are
// compared.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

// "did you mean 'x'?", of several that are as near "did you mean 'x' or 'y'?"; when nothing is
// near,
// "".
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);

// "did you mean 'x'?" or, when nothing is near, "<what>: 'a', 'b' and 3 more"; "" without
// candidates.
std::string suggest(std::string_view word, std::span<const std::string_view> candidates,
                    std::string_view what);

// The end of a path of a node that reads as `name` does: a '/' within a name is %2F in a path. ""
// if it does not end so.
std::string_view end_that_reads(std::string_view path, std::string_view name);
// The same as suggest() for paths of nodes.
std::string suggest_path(std::string_view name, std::span<const std::string_view> paths,
                         std::string_view what);

// "first; second", or the one that is not empty.
std::string join_hints(std::string first, std::string_view second);

}  // namespace lockstep::host
