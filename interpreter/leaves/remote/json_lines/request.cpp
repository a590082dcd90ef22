#include "leaves/remote/json_lines/request.h"

#include <fmt/format.h>

#include "base/json/json.h"
#include "leaves/plugin/contract/host.h"
#include "leaves/remote/json_lines/line_input.h"
#include "leaves/remote/json_lines/port_json.h"

namespace lockstep::host {

void Request::clear() {
  text_.clear();
  too_long_.clear();
}

void Request::end() {
  const std::size_t size = text_.size() + 1 - line_;
  text_ += "}\n";
  if (size <= LineInput::kLongest) return;
  too_long_ = longest_ == 0
                  ? fmt::format("a request of {} bytes", size)
                  : fmt::format("the port '{}' of {} bytes as JSON", longest_port_, longest_);
  too_long_ += " does not fit a line to its program, which has at most 1 MiB";
}

void Request::port(const lockstep_caller& caller, std::uint32_t port, const Value& value) {
  append_json(text_, caller.ports[port]->name());
  text_ += ':';
  const std::size_t before = text_.size();
  append_json_value(text_, value);
  const std::size_t size = text_.size() - before;
  if (size <= longest_) return;
  longest_ = size;
  longest_port_ = caller.ports[port]->name();
}

Request& Request::begin(std::string_view what, std::uint32_t leaf) {
  line_ = text_.size();
  longest_ = 0;
  ((text_ += R"({"do":")") += what) += R"(","leaf":)";
  text_ += fmt::format_int(leaf).c_str();
  return *this;
}

void Request::name(std::string_view name) {
  text_ += ',';
  append_json(text_, name);
  text_ += ':';
}

Request& Request::field(std::string_view name, double number) {
  this->name(name);
  append_text(number, text_);
  return *this;
}

Request& Request::field(std::string_view name, std::uint64_t number) {
  this->name(name);
  text_ += fmt::format_int(number).c_str();
  return *this;
}

Request& Request::field(std::string_view name, std::string_view text) {
  this->name(name);
  append_json(text_, text);
  return *this;
}

Request& Request::flag(std::string_view name, bool is_set) {
  this->name(name);
  text_ += is_set ? "true" : "false";
  return *this;
}

Request& Request::ports(const lockstep_caller& caller, std::vector<Value>& sent) {
  const bool is_all = sent.size() != caller.ports.size();
  sent.resize(caller.ports.size());
  const char* before = ",\"ports\":{";
  for (std::uint32_t port = 0; port < caller.ports.size(); ++port) {
    Value value = port_value(caller, port);
    if (is_same(value, sent[port])) continue;
    sent[port] = std::move(value);
    text_ += before;
    this->port(caller, port, sent[port]);
    before = ",";
  }
  if (*before == ',' && before[1] == '\0') {
    text_ += '}';
  } else if (is_all) {
    text_ += ",\"ports\":{}";
  }
  return *this;
}

Request& Request::unbound(const lockstep_caller& caller) {
  const char* before = ",\"unbound\":[";
  for (const BoundPort* const port : caller.ports) {
    if (!port->is_unbound()) continue;
    text_ += before;
    append_json(text_, port->name());
    before = ",";
  }
  if (*before == ',' && before[1] == '\0') text_ += ']';
  return *this;
}

Request& Request::fixed(const lockstep_caller& caller) {
  const char* before = ",\"fixed\":{";
  for (std::uint32_t port = 0; port < caller.ports.size(); ++port) {
    if (!caller.ports[port]->parameter->constant) continue;
    text_ += before;
    this->port(caller, port, port_value(caller, port));
    before = ",";
  }
  if (*before == ',' && before[1] == '\0') text_ += '}';
  return *this;
}

}  // namespace lockstep::host
