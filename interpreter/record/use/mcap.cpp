#include "record/use/mcap.h"

#include "record/use/mcap_messages.h"

namespace lockstep::host {

bool write_mcap(RecordingReader& reader, const McapOptions& options, const ExportSink& write) {
  McapMessages messages(reader.header(), options.start_time, write);
  if (options.range.from > 0) reader.skip_to(options.range.from);
  bool is_read = true;
  while (const auto tick = reader.next()) {
    if (tick->tick < options.range.from) continue;
    is_read = tick->tick <= options.range.to;
    if (!is_read) break;
    if (!messages.take(*tick)) return false;
  }
  return messages.finish(is_read ? reader.end() : std::nullopt);
}

}  // namespace lockstep::host
