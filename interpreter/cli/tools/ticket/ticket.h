// A ticket: a file that says which tree `lockstep verify` has proved, under which assumptions.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/after_cut.h"
#include "base/core/problem.h"
#include "run/loading/tree_identity.h"

namespace lockstep::host {

struct Ticket {
  std::string made;  // "2026-11-29T12:00:00Z"
  TreeIdentity identity;
  double rate = 0;         // ticks per second
  std::string conclusion;  // of the verdict
  bool is_proof = false;   // else the search had a limit
  std::uint64_t cuts = 0;  // of the process in a run, at most: those are proved, too
  AfterCut on_resume = AfterCut::StartsAgain;  // of leaves that cannot continue after one
  std::string leaves;                          // the text of the leaf model; "": there was none
  std::vector<std::string> properties;         // without those that are violated
  std::vector<std::string> violated;           // properties; the leaf model accepts that
  std::vector<std::string> accepted;           // all findings that it accepts, a line each
  std::vector<std::string> assumptions;
  std::string key, signature;  // in hexadecimal; "": it is not signed
};

// With SHA-256 in place of texts, and the files of plugins.
TreeIdentity ticket_identity(const Loaded& loaded);

// Signs it if `key`, a file in PEM as `openssl genpkey -algorithm ed25519` writes it, is not "".
Result<void> sign_ticket(Ticket& ticket, const std::string& key);
Result<void> write_ticket(const std::string& path, const Ticket& ticket);
Result<Ticket> read_ticket(const std::string& path);

// Whether the signature, if it has one, is that of its content; and, if `trusted`, a file with
// public keys in PEM, is not "", that it is signed by one of these keys.
Result<void> check_signature(const Ticket& ticket, const std::string& trusted);

}  // namespace lockstep::host
