// The text of a recording that is in several files, as one text: one behind the other. Also those
// that are written while it is read.
#pragma once

#include <cstdint>
#include <istream>
#include <memory>
#include <optional>
#include <streambuf>
#include <string>
#include <vector>

#include "base/compression/decompressed.h"

namespace lockstep::host {

// A text that may be in several files.
class TextOfFiles : public std::streambuf {
 public:
  // The file that has a byte of the text, and the line in it.
  struct Place {
    std::string file;
    std::uint64_t line = 0;  // from 1; 0: it cannot be counted
  };
  // May read the file again. Nothing: it is of one file.
  virtual std::optional<Place> place_of(std::uint64_t byte) = 0;
};

class RecordingParts final : public TextOfFiles {
 public:
  // Its parts are beside where the recording would be: record/part_names.h.
  explicit RecordingParts(const std::string& recording);

  std::optional<Place> place_of(std::uint64_t byte) override;

 private:
  // A file. Where a run continued after a cut, its text up to the first tick that the next part has
  // again; behind it comes a part without a file: the lines {"lost":…} and {"continued":…}.
  struct Part {
    std::string path;                        // "": it has no file
    std::string lines = {};                  // then
    std::optional<std::uint64_t> size = {};  // of its text, once it is known
    bool is_cut = false;                     // it ends there, whatever comes in the file
  };

  int_type underflow() override;
  pos_type seekoff(off_type offset, std::ios_base::seekdir way, std::ios_base::openmode) override;
  pos_type seekpos(pos_type position, std::ios_base::openmode) override;

  void open(std::size_t part);
  bool knows_next();
  std::size_t read();
  std::uint64_t size_of(std::size_t part);
  void look_for_next_process();
  void continue_with(const std::string& resumed);
  void end_before(std::uint64_t tick);

  const std::string recording_;
  std::vector<Part> parts_;
  std::string process_;  // the recording of the process that has the last part
  std::size_t at_ = 0;   // the part that is open
  bool is_open_ = false;
  std::unique_ptr<DecompressedFile> file_;  // none: a part without one
  std::uint64_t begin_ = 0;                 // of its text, in all
  std::vector<char> text_;
  std::uint64_t end_ = 0;  // behind what has been read, in all
  bool ends_line_ = true;  // what has been read
};

// A recording by its name: a file, or its parts where there is no such file, and behind these the
// recordings of the runs that continued it after cuts. Not open: errno says why.
class NamedRecording {
 public:
  // Follows: at the end, the reader looks for the file of a process that continues the run.
  enum class Reading : bool { Once, Follows };
  explicit NamedRecording(const std::string& path, Reading reading = Reading::Once);
  bool is_open() const { return parts_ != nullptr || file_->is_open(); }
  std::istream& text() { return parts_ != nullptr ? all_ : file_->text(); }

 private:
  std::unique_ptr<RecordingParts> parts_;
  std::istream all_{nullptr};
  std::unique_ptr<DecompressedFile> file_;
};

}  // namespace lockstep::host
