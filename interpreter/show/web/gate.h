// Decides who may ask the monitor at all, before anything else of a request is looked at.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "show/web/answer.h"

namespace lockstep::host {

class Gate {
 public:
  // `name` is the host that the monitor was told to listen on; without a token none is needed.
  Gate(std::string name, std::string token) : name_(std::move(name)), token_(std::move(token)) {}

  // The refusal, or nothing.
  std::optional<WebAnswer> refuse(const WebRequest& request) const;
  const std::string& token() const { return token_; }

 private:
  bool is_own_host(std::string_view host) const;

  const std::string name_, token_;
};

}  // namespace lockstep::host
