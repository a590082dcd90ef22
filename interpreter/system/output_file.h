// Writes a file that a user names. An existing file with that name is kept until the new one is
// ready; until then the new file has a temporary name in the same directory. A symbolic link to a
// file, or to nothing, is refused, so that output never goes to a different file. A named pipe or a
// device, such as /dev/null, is written directly.
#pragma once

#include <string>

namespace lockstep::host {

class OutputFile {
 public:
  // Opens it for appending; on failure error() has the reason. Waits for the reader of a pipe.
  explicit OutputFile(std::string path);
  // Closes it, and removes it if it still has its temporary name.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  int descriptor() const { return file_; }
  // "" if there is no error, else "cannot open 'run.jsonl': Permission denied".
  const std::string& error() const { return error_; }

  // Renames it to its final name, replacing an existing file. Returns false, with errno, on
  // failure.
  bool take_name();
  // Removes it if it still has its temporary name.
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

// Whether two names refer to the same file, through links of all kinds. False if a name does not
// exist.
bool is_same_file(const std::string& a, const std::string& b);

}  // namespace lockstep::host
