#include "record/write/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

namespace lockstep::host {
namespace {

// A packet that is longer than the queue could never be written, so the queue has room for several.
// (Only the messages of faults have no limit. A tick that is too long because of them is lost, the
// one after it is not.)
std::size_t queue_of(const Shape& shape, std::size_t wanted) {
  constexpr std::size_t kTicks = 4;
  const std::size_t longest = packet_size(shape.nodes.size(), kPacketCell);
  return std::max(wanted, kTicks * longest);
}

// A recording of a large tree in which little happens is not much longer because of whole states.
constexpr std::uint64_t kWholeShare = 16;

std::unique_ptr<TextEncoder> refuse_mcap() {
  throw std::runtime_error(
      "this program writes JSON Lines only; `lockstep log export run.jsonl --format mcap` makes "
      "MCAP of them");
}

// A name says what is in a file.
FileForm form_of(const RecorderOptions& options) {
  if (options.path.ends_with(".mcap") && !options.encoder) return {.encoder = refuse_mcap};
  const bool compresses = options.compresses || options.path.ends_with(".zst");
  return {.compression = compresses ? Compression::Zstd : Compression::None,
          .encoder = options.encoder};
}

}  // namespace

Recorder::Recorder(const Shape& shape, RecorderOptions options)
    : options_(std::move(options)),
      file_(options_.path, queue_of(shape, options_.queue), form_of(options_),
            {.are_wanted = options_.rotation.is_wanted(),
             .keep = options_.rotation.keep,
             .before = options_.rotation.before}),
      packets_(shape, options_.run),
      next_whole_(options_.whole_each),
      bytes_between_wholes_(kWholeShare * packet_size(shape.nodes.size(), 0)) {}

void Recorder::run_started(const Moment& moment, const RunStart& start) {
  packets_.begin(moment, start.set);
  may_wait_ = !start.real_time;
  // That of a later part gets its own first tick.
  if (options_.rotation.is_wanted())
    file_.set_header(packets_.header({start.period, start.real_time}));
  write(packets_.header(start));
  if (start.first_tick > 0) packets_.add_whole();
}

void Recorder::log(std::string_view who, std::string_view level, std::string_view text) {
  packets_.log(who, level, text);
}

// Also after a failure of the file: the calls of leaves must not depend on a disk.
void Recorder::before_tick(const Moment& moment, std::uint64_t, Nanoseconds) {
  packets_.before_tick(moment);
}

void Recorder::after_tick(const Moment& moment, const TickReport& report) {
  if (!failed()) {
    plan_whole(report.tick);
    plan_part(report);
    if (push_tick(moment, report)) {
      packets_.keep();
      gap_ = 0;
      if (std::exchange(begins_part_, false)) {
        ++parts_;
        part_began_ = report.time;
      }
    } else if (!failed()) {
      if (gap_ == 0) gap_from_ = report.tick;
      ++gap_;
      ++lost_;
    }
  }
  tell_error();
}

// Until a line with it is accepted.
void Recorder::plan_whole(std::uint64_t tick) {
  if (tick < next_whole_ || bytes_since_whole_ < bytes_between_wholes_) return;
  packets_.add_whole();
  next_whole_ = tick + options_.whole_each;
  bytes_since_whole_ = 0;
}

// Likewise.
void Recorder::plan_part(const TickReport& report) {
  if (!part_began_) {  // the first tick is in the first part
    part_began_ = report.time;
    return;
  }
  if (begins_part_ || !wants_part(report.time)) return;
  begins_part_ = true;
  packets_.add_whole();
  next_whole_ = report.tick + options_.whole_each;
  bytes_since_whole_ = 0;
}

bool Recorder::wants_part(Nanoseconds time) {
  const Rotation& limit = options_.rotation;
  if (limit.time.count() > 0 && time - *part_began_ >= limit.time) return true;
  if (limit.bytes == 0) return false;
  // Where time stands still, much may wait in the queue, and the same run gives the same files.
  if (may_wait_) {
    if (bytes_since_look_ < std::min<std::uint64_t>(AppendFile::kFull, limit.bytes / 4))
      return false;
    bytes_since_look_ = 0;
    file_.flush();
  }
  // Before that, the size is that of the file before.
  return file_.part() == parts_ && file_.part_size() >= limit.bytes;
}

bool Recorder::push_tick(const Moment& moment, const TickReport& report) {
  Packet packet = packets_.tick(moment, report);
  add_gap(packet.head);
  packet.head.begins_part = begins_part_ ? 1 : 0;
  bytes_since_whole_ += packet_size(packet);
  bytes_since_look_ += packet_size(packet);
  if (file_.push(packet)) return true;
  if (!may_wait_) return false;
  file_.flush();
  return file_.push(packet);
}

// A gap is written together with the next line: either both are in the file or neither.
void Recorder::add_gap(PacketHead& head) const {
  head.lost = gap_;
  head.lost_from = gap_from_;
}

void Recorder::run_ended(const Moment& moment, const RunEnd& end) {
  const auto patience = end.budget == nullptr ? std::nullopt : end.budget->share();
  if (patience) file_.set_patience(*patience);
  write(packets_.end(moment, end, lost_));
  file_.end();
  tell_error();
  if (patience && file_.ran_out_of_patience()) {
    end.budget->used_up_by(fmt::format("who reads the recording '{}'", options_.path));
  }
}

// The first and the last line are not lost, even if the run has to wait for them.
void Recorder::write(const std::string& text) {
  Packet packet{.text = text};
  add_gap(packet.head);
  file_.write(packet);
  tell_error();
}

void Recorder::tell_error() {
  if (error_told_ || !failed()) return;
  error_told_ = true;
  if (options_.on_error) options_.on_error(error());
}

}  // namespace lockstep::host
