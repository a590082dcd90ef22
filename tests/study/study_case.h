// Studies made by the program, in a directory of their own.
#pragma once

#include "support/paths.h"
#include "support/program.h"

namespace lockstep::host::test {

inline const std::string kPaper = LOCKSTEP_SOURCE_DIR "/trees/paper/";
using Strings = std::vector<std::string>;

class StudyCase {
 public:
  // `lockstep study` with these arguments, into the directory `out`; the plots have their own
  // tests.
  Outcome study(std::vector<std::string> arguments, const std::string& out) const;
  // The same, which must work.
  void make(std::vector<std::string> arguments, const std::string& out) const;
  Outcome merge(std::vector<std::string> parts, const std::string& out) const;

  std::string path(const std::string& name) const { return directory_.path(name); }
  std::string file(const std::string& name, const std::string& text) const {
    return directory_.file(name, text);
  }
  // runs.csv, summary.csv and study.json, one after the other.
  std::string bytes(const std::string& out) const;
  std::string read(const std::string& out, const std::string& name) const {
    return read_file(path(out) + '/' + name);
  }

 private:
  TemporaryDirectory directory_;
};

Strings with(Strings arguments, const Strings& more);
void write(const std::string& path, const std::string& text);
// The fields of a line of CSV without quotes.
std::vector<std::string> fields(const std::string& line);
// A column of a CSV file, by its name.
std::vector<double> column(const std::string& csv, const std::string& name);

}  // namespace lockstep::host::test
