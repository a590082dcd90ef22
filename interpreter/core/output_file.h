// A file that a user names to be written anew. What has that name stays as it is until the new file
// is worth it: until then the new one has a temporary name beside it. A symbolic link to a file, or
// to nothing, is refused, so that nobody leads us to another file than the one that is named.
// A named pipe or a device, as /dev/null, is written to as it is.
#pragma once

#include <string>

namespace lockstep {

class OutputFile {
 public:
  // Opens it for appending; error() tells when that is not possible. Waits for the reader of a
  // pipe.
  explicit OutputFile(std::string path);
  // Closes it, and removes it if it has not got its name.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  int descriptor() const { return file_; }
  // "" while all is well, else "cannot open 'run.jsonl': Permission denied".
  const std::string& error() const { return error_; }

  // Gives it its name, in place of what had it. False, with errno, when that is not possible.
  bool take_name();
  // Leaves nothing behind, if it has no name yet.
  void remove() const;
  // These two are async-signal-safe.

 private:
  void open_beside();
  void open_as_it_is();
  void fail(const std::string& reason);

  const std::string path_;
  std::string temporary_;  // "": it has its name
  int file_ = -1;
  std::string error_;
};

// Whether two names are of the same file, through links of all kinds. Names that are not there are
// not.
bool is_same_file(const std::string& a, const std::string& b);

}  // namespace lockstep
