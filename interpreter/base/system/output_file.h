// Writes a file that a command makes, under the name that a user gives it. An existing file with
// that name is kept until the new one is ready; until then the new file has no name, so that a
// signal that ends the process leaves nothing behind, or a temporary one in the same directory,
// where the file system has only files with names. The new file gets the owner, the mode and the
// access control list of the existing one; other names of that (hard links) keep the old bytes. One
// that this user may not write is refused. (What people keep and commands change is for
// replace_text.h.) A symbolic link to a file, or to nothing, is refused, so that output never goes
// to a different file. A named pipe or a device, such as /dev/null, is written directly.
#pragma once

#include <string>
#include <string_view>

#include "base/core/problem.h"
#include "base/system/file_descriptor.h"

namespace lockstep::host {

class OutputFile {
 public:
  // Opens it for appending; on failure error() has the reason. Waits for the reader of a pipe.
  explicit OutputFile(std::string path);
  // Removes it if it still has its temporary name.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  int descriptor() const { return file_.number(); }
  // "" if there is no error, else "cannot open 'run.jsonl': Permission denied".
  const std::string& error() const { return error_; }

  // Gives it its final name, replacing an existing file. Returns false, with errno, on failure.
  bool take_name();
  // Removes it if it still has its temporary name.
  void remove() const;
  // These two are async-signal-safe.

 private:
  void open_fresh();
  bool open_without_name();
  bool link_name();
  void open_as_it_is();
  void fail(const std::string& reason);

  const std::string path_;
  std::string temporary_;  // "": it has its name
  std::string nameless_;   // the kernel's path to the file while it has no name; else ""
  FileDescriptor file_;
  std::string error_;
};

// The file that is open and named `fresh` takes the place of that at `path`, if there is one, with
// its owner, mode and access control list. False, with errno. Async-signal-safe.
bool take_name(int file, const char* fresh, const char* path) noexcept;

// All of an output.
Result<void> write_output(const std::string& path, std::string_view text);

// Whether two names refer to the same file, through links of all kinds. False if a name does not
// exist.
bool is_same_file(const std::string& a, const std::string& b);

}  // namespace lockstep::host
