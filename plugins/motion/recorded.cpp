#include "recorded.hpp"

#include <simdjson.h>

#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "unpacked.hpp"

namespace motion {
namespace {

namespace dom = simdjson::dom;

// A line of 64 MiB has more than a million nodes. Unused memory costs nothing.
constexpr std::size_t kLongestLine = std::size_t{64} << 20;

// The lines of a file, which may be compressed, as JSON. The last one may be cut, as a kill leaves
// it.
class JsonLines {
 public:
  explicit JsonLines(const std::string& name) : name_(name), file_(name), in_(&file_) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(name, ignored) || !file_.is_open()) {
      fail("cannot be read");
    }
    in_.exceptions(std::ios_base::badbit);  // what a read throws is passed on
  }

  // Nothing at the end.
  std::optional<dom::element> next() {
    const std::size_t length = read_line();
    if (length == 0) return std::nullopt;
    ++line_;
    if (in_.fail() && !in_.eof()) fail("a line that is too long");
    dom::element element;
    if (parser_.parse(text_.get(), length - !in_.eof(), false).get(element) == simdjson::SUCCESS)
      return element;
    if (!in_.eof()) fail("not JSON");
    return std::nullopt;
  }

  [[noreturn]] void fail(const std::string& why) const {
    const std::string line = line_ == 0 ? "" : ":" + std::to_string(line_);
    throw std::runtime_error("'" + name_ + "'" + line + ": " + why);
  }

 private:
  std::size_t read_line() {
    try {
      in_.getline(text_.get(), kLongestLine);
    } catch (const std::runtime_error& damage) {
      ++line_;
      fail(damage.what());
    }
    return static_cast<std::size_t>(in_.gcount());
  }

  std::string name_;
  Unpacked file_;
  std::istream in_;
  std::size_t line_ = 0;
  std::unique_ptr<char[]> text_{new char[kLongestLine + simdjson::SIMDJSON_PADDING]};
  dom::parser parser_;
};

// Its place in the header's list of nodes.
std::size_t place_of(const std::string& node, const dom::element& header, const JsonLines& lines) {
  std::int64_t version = 0;
  if (header["lockstep_recording"].get(version) != simdjson::SUCCESS) {
    lines.fail("not a recording of lockstep");
  }
  if (version != 1) lines.fail("a recording of version " + std::to_string(version) + ", not 1");
  dom::array nodes;
  if (header["nodes"].get(nodes) != simdjson::SUCCESS) lines.fail("a header without nodes");
  std::size_t place = 0;
  for (const dom::element& it : nodes) {
    std::string_view path;
    if (it["path"].get(path) == simdjson::SUCCESS && path == node) return place;
    ++place;
  }
  lines.fail("the recording has no node '" + node + "'; lockstep log csv prints their paths");
}

// Collects the state of one node from the lines: a line has only changes.
class Player {
 public:
  Player(const JsonLines& lines, std::size_t node) : lines_(lines), node_(node) {}

  // False when the activation has ended.
  bool take(const dom::element& line) {
    dom::element ignored;
    if (line["end"].get(ignored) == simdjson::SUCCESS) {
      is_over_ = true;
      return false;
    }
    if (line["continued"].get(ignored) == simdjson::SUCCESS) return true;
    if (line["lockstep_recording"].get(ignored) == simdjson::SUCCESS) return begin_file();
    if (line["lost"].get(ignored) == simdjson::SUCCESS) return true;
    double tick = 0, time = 0;
    dom::array nodes;
    if (line["tick"].get(tick) != simdjson::SUCCESS ||
        line["time_s"].get(time) != simdjson::SUCCESS ||
        line["nodes"].get(nodes) != simdjson::SUCCESS) {
      lines_.fail("not a line of a recording");
    }
    const bool begins_file = std::exchange(begins_file_, false);
    const bool is_after_gap = begins_file && tick > last_tick_ + 1;
    if (begins_file) drop_from(tick);
    last_tick_ = tick;
    for (const dom::element& change : nodes) take_change(change);
    const bool is_first = !std::exchange(has_line_, true);
    // A result that is there from the first line on may be of an activation in another file.
    if (ticks_.empty() && (status_ == "idle" || (status_ != "running" && !is_ticked_))) return true;
    began_before_ |= is_first && tick > 0 && status_ == "running";
    has_gap_ |= is_after_gap && !is_first;
    return add(tick, time);
  }

  RecordedProgress played() {
    RecordedProgress it{Curve(std::move(ticks_)), Curve(std::move(seconds_)), end_};
    if (began_before_) it.lack = "began in an earlier file of the recording";
    if (has_gap_) it.lack += std::string(it.lack.empty() ? "" : ", and ") + "lacks ticks";
    if (!is_over_) {
      it.lack += it.lack.empty() ? "" : ", and ";
      it.lack += "does not end in this one: the recording is truncated, or has another file";
    }
    return it;
  }

 private:
  // Files of one recording, joined. The first line of each has the whole state.
  bool begin_file() {
    status_ = "idle";
    progress_ = 0;
    return begins_file_ = true;
  }

  // What happened again after a cut.
  void drop_from(double tick) {
    while (!ticks_.empty() && ticks_.back().at >= tick - first_tick_) {
      ticks_.pop_back();
      seconds_.pop_back();
    }
  }

  void take_change(const dom::element& change) {
    std::uint64_t index = 0;
    std::string_view status;
    double progress = 0;
    if (change.at(0).get(index) != simdjson::SUCCESS ||
        change.at(1).get(status) != simdjson::SUCCESS ||
        change.at(2).get(progress) != simdjson::SUCCESS || !(progress >= 0 && progress <= 1)) {
      lines_.fail("not a line of a recording");
    }
    if (index != node_) return;
    status_ = status;
    progress_ = progress;
    std::uint64_t ticked = 1;
    is_ticked_ = change.at(3).get(ticked) != simdjson::SUCCESS || ticked != 0;
  }

  // The progress is that before the tick; the result of the tick is one period later.
  bool add(double tick, double time) {
    if (ticks_.empty()) {
      first_tick_ = tick;
      first_time_ = time;
    } else if (tick - first_tick_ <= ticks_.back().at || time - first_time_ <= seconds_.back().at) {
      lines_.fail("a tick that does not come after the one before");
    }
    is_over_ = status_ != "running";
    if (status_ == "idle") return false;  // halted
    ticks_.push_back({tick - first_tick_, progress_});
    seconds_.push_back({time - first_time_, progress_});
    if (status_ == "running") return true;
    end_ = status_ == "success" ? RecordedProgress::End::Success : RecordedProgress::End::Failure;
    return false;
  }

  const JsonLines& lines_;
  std::size_t node_;
  std::string status_ = "idle";
  double progress_ = 0;
  bool is_ticked_ = true, has_line_ = false, begins_file_ = false;
  double last_tick_ = 0;
  bool has_gap_ = false;                         // between the files
  bool began_before_ = false, is_over_ = false;  // is_over_: its end is in the file, or its run's
  double first_tick_ = 0, first_time_ = 0;
  std::vector<Point> ticks_, seconds_;
  RecordedProgress::End end_ = RecordedProgress::End::None;
};

}  // namespace

RecordedProgress read_recording(const std::string& file, const std::string& node) {
  JsonLines lines(file);
  const auto header = lines.next();
  if (!header) lines.fail("not a recording of lockstep");
  Player player(lines, place_of(node, *header, lines));
  for (auto line = lines.next(); line && player.take(*line);) line = lines.next();
  RecordedProgress played = player.played();
  if (played.ticks.empty()) lines.fail("the node '" + node + "' never ran");
  return played;
}

// At once where the names are constants: a file must not be read while a robot moves.
Recorded::Recorded() {
  const auto from = file.try_get(), of = node.try_get();
  if (from && of) read(*from, *of);
}

void Recorded::read(const std::string& from, const std::string& of) {
  if (from == file_ && of == node_) return;
  recorded_ = read_recording(from, of);
  file_ = from;
  node_ = of;
  is_told_ = recorded_.lack.empty();
}

void Recorded::start() {
  read(file.get(), node.get());
  if (!std::exchange(is_told_, true)) {
    log(lockstep::LogLevel::Warning,
        "'" + node_ + "' in '" + file_ + "' " + recorded_.lack +
            "; `lockstep log cat RECORDING > FILE` joins the files of a recording");
  }
  pace_.start(clock.view(), now());
  report_.start(report);
  obey_.start(obey);
}

// The tick that ended the node then ends it now: the one after as many as came before it.
Recorded::Status Recorded::tick() {
  using End = RecordedProgress::End;
  const bool is_last = pace_.has_reached(curve().end(), now());
  report_.sample(now(), curve().progress(pace_.elapsed(now())));
  pace_.tick(obey_.is_told() ? obey_.factor(now()) : 1);
  if (!is_last || recorded_.end == End::None) return Status::Running;
  return recorded_.end == End::Success ? Status::Success : Status::Failure;
}

// What moves in time does so whatever it is told.
double Recorded::set_pace(double factor) {
  return pace_.is_time() ? 1.0 : obey_.set(factor, now());
}

void Recorded::pause() {
  report_.sample(now(), curve().progress(pace_.elapsed(now())));
}

double Recorded::progress() const {
  return report_.of(pace_, now(), [this](double elapsed) { return curve().progress(elapsed); });
}

}  // namespace motion
