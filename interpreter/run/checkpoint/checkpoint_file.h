// The file of checkpoints, on one thread. It has a head with the facts, and three slots of one
// size: the checkpoint that was synced last, which nothing overwrites before another one is synced;
// and two that are written in turn. So a kill in the middle of a write costs one checkpoint, and a
// power cut those since the last sync. The newest whole slot counts. A state that does not fit
// needs another file with slots of twice the size, which takes the place of this one.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/core/problem.h"
#include "base/system/lock_file.h"
#include "base/system/output_file.h"
#include "run/checkpoint/checkpoint.h"

namespace lockstep::host {

class CheckpointFile {
 public:
  static constexpr unsigned kSlots = 3;

  // Locks it. A link, a directory, a file of another user and what is no checkpoint are refused.
  explicit CheckpointFile(std::string path);

  // "" if there is no error. After one, nothing is written.
  const std::string& error() const { return error_; }

  // A synced file with one checkpoint, as bytes, takes the place of what has the name.
  bool begin(std::string facts, std::string_view checkpoint);
  // The next one.
  bool write(std::string_view checkpoint);
  bool sync();
  // Also after an error, where the file has a place for it: what is synced is this, or older.
  void write_last(std::string_view checkpoint);

 private:
  struct Slots {
    std::unique_ptr<OutputFile> out = nullptr;
    std::uint64_t first = 0, room = 0;  // the place of the first one, the size of each
  };
  bool make(std::string_view checkpoint, std::uint64_t room);
  bool write_slot(const Slots& slots, unsigned slot, std::string_view checkpoint);
  unsigned free_slot() const;
  bool fail();

  const std::string path_;
  std::string error_;
  std::optional<LockFile> lock_;
  Slots slots_;
  std::string facts_;
  std::uint64_t number_ = 0;          // of the last one written
  unsigned newest_ = 0, synced_ = 0;  // slots
};

// What a file has. `checkpoint` is the newest whole one.
struct KeptCheckpoint {
  CheckpointFacts facts;
  Checkpoint checkpoint;
};
// Nothing: there is no file. A problem: there is one that is refused, or damaged.
// To show it, it may be another user's: that of a service.
enum class CheckpointReader { Shows, Continues };
Result<std::optional<KeptCheckpoint>> read_checkpoint_file(
    const std::string& path, CheckpointReader reader = CheckpointReader::Continues);

}  // namespace lockstep::host
