#include "show/web/gate.h"

#include <arpa/inet.h>

#include "show/web/token.h"

namespace lockstep::host {
namespace {

// "robot" of "robot:8080"; "" if there is more.
std::string_view without_port(std::string_view host) {
  const auto close = host.starts_with('[') ? host.find(']') : 0;
  const auto colon = close < host.size() ? host.find(':', close) : host.npos;
  if (colon == host.npos) return host;
  const std::string_view port = host.substr(colon + 1);
  const bool is_port = port.find_first_not_of("0123456789") == port.npos;
  return is_port ? host.substr(0, colon) : std::string_view();
}

bool is_address(std::string_view host) {
  in_addr v4{};
  in6_addr v6{};
  if (host.starts_with('[') && host.ends_with(']')) {
    return inet_pton(AF_INET6, std::string(host.substr(1, host.size() - 2)).c_str(), &v6) == 1;
  }
  return inet_pton(AF_INET, std::string(host).c_str(), &v4) == 1;
}

}  // namespace

// A page of elsewhere may have a name that leads here. It cannot have an address or our names.
bool Gate::is_own_host(std::string_view host) const {
  const std::string_view name = without_port(host);
  if (name.empty()) return false;
  return name == "localhost" || name == name_ || is_address(name);
}

std::optional<WebAnswer> Gate::refuse(const WebRequest& request) const {
  if (!request.host || !is_own_host(*request.host)) {
    return refusal(421, {"this is the monitor of lockstep, not that host"});
  }
  if (request.origin && *request.origin != "http://" + *request.host) {
    return refusal(403, {"pages of other hosts are rejected"});
  }
  const bool is_open = token_.empty() || (request.path == "/" && request.method == "GET");
  if (!is_open && !is_token(token_, request.token.value_or(""))) {
    return refusal(403, {"the token is missing or wrong",
                         "it is in the link that lockstep printed; a program sends it as the "
                         "header X-Lockstep-Token"});
  }
  return std::nullopt;
}

}  // namespace lockstep::host
