#include "cli/tools/ticket/ticket.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/core/diagnostics.h"
#include "base/json/json.h"
#include "base/json/reader.h"
#include "base/system/output_file.h"
#include "cli/tools/ticket/sodium.h"
#include "language/document/file.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

// What comes before the key in the forms of DER that OpenSSL writes: RFC 8410.
constexpr std::string_view kPrivateForm{
    "\x30\x2e\x02\x01\x00\x30\x05\x06\x03\x2b\x65\x70\x04\x22\x04\x20", 16};
constexpr std::string_view kPublicForm{"\x30\x2a\x30\x05\x06\x03\x2b\x65\x70\x03\x21\x00", 12};
constexpr std::string_view kHowToMakeKeys =
    "openssl genpkey -algorithm ed25519 -out key.pem; openssl pkey -in key.pem -pubout -out "
    "trusted.pem";

// All that a signature is of; its text is the same for the same values.
Json content_of(const Ticket& ticket) {
  Json identity = Json::array();
  for (const auto& [name, value] : ticket.identity)
    identity.push_back(Json{{"name", name}, {"value", value}});
  Json all{{"lockstep_ticket", 1},
           {"made", ticket.made},
           {"conclusion", ticket.conclusion},
           {"is_proof", ticket.is_proof},
           {"rate", ticket.rate},
           {"identity", std::move(identity)},
           {"properties", ticket.properties},
           {"assumptions", ticket.assumptions},
           {"leaves", ticket.leaves}};
  if (ticket.cuts > 0) {
    all.add("cuts", ticket.cuts);
    all.add("on_resume", word_of(ticket.on_resume));
  }
  if (!ticket.violated.empty()) all.add("violated", ticket.violated);
  if (!ticket.accepted.empty()) all.add("accepted", ticket.accepted);
  return all;
}

}  // namespace

TreeIdentity ticket_identity(const Loaded& loaded) {
  TreeIdentity identity = identity_of(loaded, sha256);
  constexpr std::size_t kMost = std::size_t{1} << 30u;
  for (const PluginSet::Info& plugin : loaded.plugins->list()) {
    const auto bytes = read_file(plugin.path, kMost);
    identity.emplace_back(fmt::format("the file of the plugin '{}'", plugin.name),
                          bytes ? sha256(*bytes) : "");
  }
  return identity;
}

Result<void> sign_ticket(Ticket& ticket, const std::string& key) {
  if (key.empty()) return {};
  const auto blocks = pem_blocks(key, "PRIVATE KEY");
  if (!blocks) return tl::unexpected(blocks.error());
  std::array<unsigned char, crypto_sign_SEEDBYTES> seed;
  const bool is_key = blocks->size() == 1 && blocks->front().starts_with(kPrivateForm) &&
                      blocks->front().size() == kPrivateForm.size() + seed.size();
  if (!is_key)
    return problem(fmt::format("'{}' is no private key of Ed25519 in PEM", printable(key)),
                   std::string(kHowToMakeKeys));
  std::ranges::copy(blocks->front().substr(kPrivateForm.size()), seed.begin());
  const Signed made = sign(content_of(ticket).text(), seed);
  ticket.key = hex({reinterpret_cast<const char*>(made.key.data()), made.key.size()});
  ticket.signature =
      hex({reinterpret_cast<const char*>(made.signature.data()), made.signature.size()});
  return {};
}

Result<void> write_ticket(const std::string& path, const Ticket& ticket) {
  Json all = content_of(ticket);
  if (!ticket.signature.empty())
    all.add("signature", Json{{"key", ticket.key}, {"ed25519", ticket.signature}});
  return write_output(path, all.printable(2) + "\n");
}

Result<Ticket> read_ticket(const std::string& path) {
  constexpr std::size_t kMost = std::size_t{64} << 20u;
  auto text = read_file(path, kMost);
  if (!text)
    return problem(fmt::format("cannot read '{}': {}", printable(path), text.error().message));
  Ticket ticket;
  std::uint64_t version = 0;
  const auto read_row = [&](JsonValue item) {
    auto& [name, value] = ticket.identity.emplace_back();
    item.object().read({{"name", into(name)}, {"value", into(value)}});
  };
  const auto read_flag = [&](JsonValue value) {
    if (!value.get(ticket.is_proof)) throw JsonError("'is_proof' is neither true nor false");
  };
  const auto read_on_resume = [&](JsonValue value) {
    const auto word = after_cut_named(value.text());
    if (!word) throw JsonError("'on_resume' is neither restart, failure nor success");
    ticket.on_resume = *word;
  };
  const auto read_signature = [&](JsonValue value) {
    value.object().read({{"key", into(ticket.key)}, {"ed25519", into(ticket.signature)}});
  };
  try {
    JsonReader().read(*text, [&](JsonObject all) {
      all.read({{"lockstep_ticket", into(version)},
                {"made", into(ticket.made)},
                {"conclusion", into(ticket.conclusion)},
                {"is_proof", read_flag},
                {"rate", into(ticket.rate)},
                {"identity", [&](JsonValue it) { it.each_item(read_row); }},
                {"properties", into(ticket.properties)},
                {"assumptions", into(ticket.assumptions)},
                {"leaves", into(ticket.leaves)},
                {"cuts", into(ticket.cuts), kMayLack},
                {"on_resume", read_on_resume, kMayLack},
                {"violated", into(ticket.violated), kMayLack},
                {"accepted", into(ticket.accepted), kMayLack},
                {"signature", read_signature, kMayLack}});
    });
  } catch (const JsonError& error) {
    return problem(fmt::format("'{}' is no ticket: {}", printable(path), error.what()),
                   "`lockstep verify TREE.xml --ticket FILE` writes one");
  }
  if (version != 1)
    return problem(fmt::format("'{}' is a ticket of version {}, which this lockstep does not know",
                               printable(path), version));
  return ticket;
}

Result<void> check_signature(const Ticket& ticket, const std::string& trusted) {
  std::vector<std::string> keys;
  if (!trusted.empty()) {
    const auto blocks = pem_blocks(trusted, "PUBLIC KEY");
    if (!blocks) return tl::unexpected(blocks.error());
    for (const std::string& it : *blocks) {
      if (it.starts_with(kPublicForm) && it.size() == kPublicForm.size() + sizeof(PublicKey))
        keys.push_back(hex(it.substr(kPublicForm.size())));
    }
    if (keys.empty())
      return problem(fmt::format("'{}' has no public key of Ed25519 in PEM", printable(trusted)),
                     std::string(kHowToMakeKeys));
    if (ticket.signature.empty()) return problem("the ticket is not signed");
    if (std::ranges::find(keys, ticket.key) == keys.end())
      return problem("the ticket is signed with a key that is not trusted",
                     fmt::format("the key is {}", printable(ticket.key)));
  }
  if (ticket.signature.empty()) return {};
  Signed by;
  const bool is_good = from_hex(ticket.key, by.key.data(), by.key.size()) &&
                       from_hex(ticket.signature, by.signature.data(), by.signature.size()) &&
                       is_signed(content_of(ticket).text(), by);
  if (is_good) return {};
  return problem("the ticket was changed after it was signed");
}

}  // namespace lockstep::host
