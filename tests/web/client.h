// A browser's part, with a plain socket: what the monitor answers, byte for byte.
#pragma once

#include <string>
#include <vector>

#include "support/program.h"

namespace lockstep::host::test {

class Client {
 public:
  explicit Client(unsigned port);
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  // False when the other side has closed.
  bool send(const std::string& bytes);
  // No more comes from here.
  void send_end();
  // Reads on until `text` has come, from a place on; false when the other side closes before.
  bool wait_for(const std::string& text, std::size_t from = 0);
  // Until the other side closes. What has come so far, all in all.
  const std::string& finish();
  const std::string& so_far() const { return received_; }

 private:
  bool read_more();

  int socket_ = -1;
  std::string received_;
};

struct Response {
  int status = 0;  // 0: the connection was closed without an answer
  std::string head, body;
};

Response split_response(const std::string& text);
// GET of a path with the headers of a browser.
std::string get_text(unsigned port, const std::string& path, const std::string& headers = "");
Response get(unsigned port, const std::string& path, const std::string& headers = "");
Response post(unsigned port, const std::string& path, const std::string& body,
              const std::string& headers = "");

// A run with a monitor; `arguments` come behind `run`.
class MonitoredRun {
 public:
  explicit MonitoredRun(std::vector<std::string> arguments);
  unsigned port() const { return port_; }
  const std::string& token() const { return token_; }
  Process& process() { return process_; }

 private:
  Process process_;
  unsigned port_ = 0;
  std::string token_;  // in the fragment of the link; "": none
};

}  // namespace lockstep::host::test
