// Scripts, run slowly and obviously: the words as a tree, walked with copies of values. It follows
// the text of docs/expressions.md, not the compiler.
#pragma once

#include <string>

namespace lockstep::host::test {

// Runs a text both ways on the same entries: n = 3, r = 2.5, t = '7b' and e (empty) without a type,
// @n = 1 (int), di (int), dd (double), dt (string), all empty, and db = true (bool); RED is 2.
// Returns "" or in what they differ.
std::string disagreement(const std::string& script);

}  // namespace lockstep::host::test
