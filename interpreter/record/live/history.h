// The lines of a run up to now, for one client: what its recording has, as far as it goes, then
// what the log has.
#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/core/clock.h"
#include "record/live/line_log.h"
#include "record/live/stream.h"

namespace lockstep::host {

class History final : public Stream {
 public:
  static constexpr std::chrono::milliseconds kPatience{300};

  // `recording` is the file that the run writes; "": none. If there is one, and a line with the
  // whole state `is_coming`, it goes on with that one.
  History(const LineLog& log, const std::string& recording, bool is_coming);

  bool is_endless() const override { return false; }
  Piece read(std::span<char> to) override;

 private:
  bool is_seam_there();
  std::optional<std::string_view> next();
  std::optional<std::string_view> next_recorded();
  std::string_view next_logged();

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  const LineLog& log_;
  std::unique_ptr<std::FILE, Close> file_;
  std::optional<std::uint64_t> full_;  // the last line with the whole state, when it was asked for
  const Nanoseconds asked_;
  bool waits_;                   // for another one
  std::string line_;             // of the file
  std::uint64_t until_ = 0;      // the tick with which the log begins
  std::uint64_t next_tick_ = 0;  // of the file
  bool is_at_header_ = true;
  std::uint64_t event_;     // the next of the log
  std::string_view rest_;   // of the line that is being read
  std::uint64_t read_ = 0;  // the event that it is of, and 1 more; 0: none
};

}  // namespace lockstep::host
