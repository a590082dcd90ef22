// Any bytes as what a program says that is a plugin: its first line, then answers. They come in two
// parts; the first byte says where they are cut. Each line is an answer, or refused with a reason;
// a first line that is taken is a plugin, or refused as one; and nothing is kept of a line without
// an end but its bytes.
#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/system/file_descriptor.h"
#include "leaves/remote/json_lines/hello.h"
#include "leaves/remote/json_lines/line_input.h"
#include "leaves/remote/json_lines/reply.h"
#include "require.h"
#include "run/loading/plugin_set.h"

namespace fuzz_program_target {
namespace {

using namespace lockstep::host;
using fuzz::require;

void check_hello(const std::string& line) {
  const auto hello = Hello::read(line, "fuzz", Hold::AsItSays);
  if (!hello)
    return require(!hello.error().message.empty(), "a first line is taken, or there is a reason");
  require((*hello)->line() == line, "the line is kept");
  PluginSet plugins;
  Diagnostics diagnostics;
  const bool added = plugins.add((*hello)->plugin(), "fuzz.py", diagnostics);
  require(added != diagnostics.has_errors(), "a plugin, or errors");
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    require(!render(diagnostic, false).empty(), "a diagnostic has a text");
  }
  if (!added) return;
  require(plugins.types().size() == (*hello)->plugin().leaf_type_count, "each leaf is a type");
  for (const NodeType* type : plugins.types()) (*hello)->hold_of(type->id);
}

void check_reply(JsonReader& reader, Reply& reply, std::string& line) {
  if (!read_reply(reader, line, reply).empty()) return;
  const bool is_status = reply.what == Reply::What::Status;
  require(!is_status || (reply.status >= LOCKSTEP_RUNNING && reply.status <= LOCKSTEP_SKIPPED),
          "a status is one of four");
  require(is_status || !reply.sets_ports, "only an answer to a tick sets ports");
  require(!reply.progress || std::isfinite(*reply.progress), "progress is a number");
  require(reply.what != Reply::What::Progress || reply.progress.has_value(),
          "progress alone has progress");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || size > 60'000) return 0;  // what a pipe takes at once
  int ends[2];
  require(pipe2(ends, O_CLOEXEC | O_NONBLOCK) == 0, "a pipe");
  const FileDescriptor out(ends[0]);
  FileDescriptor in(ends[1]);
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::size_t cut = bytes.size() * data[0] / 256;
  LineInput input;
  JsonReader reader;
  Reply reply;
  std::string line, all;
  bool is_first = true;
  for (const std::string_view part : {bytes.substr(0, cut), bytes.substr(cut)}) {
    require(write(in.number(), part.data(), part.size()) == static_cast<ssize_t>(part.size()),
            "a pipe takes it");
    while (input.fill(out.number()) == LineInput::Filled::Some) {
      std::string seen;
      std::size_t place = 0;
      const bool is_there = input.look(place, seen);
      const bool is_next = input.next(line);
      require(is_there == is_next && (!is_next || seen == line), "to look is to see the next line");
      for (bool more = is_next; more; more = input.next(line)) {
        all += line + "\n";
        if (is_first) check_hello(line);
        is_first = false;
        check_reply(reader, reply, line);
      }
    }
  }
  require(!input.is_too_long(), "60 kB are not too long");
  require(all == bytes.substr(0, all.size()) && (bytes.find('\n', all.size()) == bytes.npos),
          "all lines, in order");
  require(input.has_rest() == (all.size() < bytes.size()), "what has no end is the rest");
  return 0;
}

}  // namespace fuzz_program_target
