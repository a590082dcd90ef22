// The leaves of two plugins that exchange objects. What a parcel has in it says what its functions
// do: "deaf to_bytes" is one whose to_bytes fails.
#include <unistd.h>
#include <csignal>
#include <lockstep/leaf.hpp>
#include <memory>
#include <stdexcept>

namespace {

// Its owners are the parcels that are not of a tree.
const auto g_parcels = std::make_shared<int>();

struct Parcel {
  std::string content;
  std::shared_ptr<int> counted = {};
};

// By a signal that ends the process also where a sanitizer listens for it.
void die() {
  std::signal(SIGSEGV, SIG_DFL);
  std::raise(SIGSEGV);
}

struct Office {
  Office() = default;
  ~Office() noexcept(false) {
    if (g_parcels.use_count() > 1) throw std::runtime_error("parcels are left");
  }
};

std::string to_text(const Parcel& parcel) {
  if (parcel.content == "segv in to_text") die();
  return "[" + parcel.content + "]";
}

bool from_text(std::string_view text, Parcel& parcel) {
  if (text == "segv in from_text") die();
  parcel.content = text;
  return text != "none";
}

#ifndef PARCEL_WITHOUT_BYTES
std::string to_bytes(const Parcel& parcel) {
  if (parcel.content == "throw in to_bytes") throw std::runtime_error("glued");
  if (parcel.content == "large") return std::string((std::size_t{64} << 20) + 1, 'x');
  return parcel.content;
}

bool from_bytes(std::string_view bytes, Parcel& parcel) {
  if (bytes == "throw in from_bytes") throw std::runtime_error("torn");
  if (bytes == "segv in from_bytes") die();
  parcel.content = bytes;
  parcel.counted = g_parcels;
  return bytes != "damaged";
}
#endif

}  // namespace

LOCKSTEP_OBJECT_TYPE(Parcel, "test.Parcel");

namespace {

struct SendPorts : lockstep::Ports {
  Input<std::string> content{this, "content", required, "what is in it"};
  Output<std::shared_ptr<const Parcel>> parcel{this, "parcel", "the parcel"};
};

class Send : public lockstep::Action<SendPorts> {
 public:
  Status tick() override {
    return parcel.set(std::make_shared<Parcel>(Parcel{content.get(), g_parcels})) ? Status::Success
                                                                                  : Status::Failure;
  }
};

struct ReceivePorts : lockstep::Ports {
  Input<std::shared_ptr<const Parcel>> parcel{this, "parcel", required, "the parcel"};
  Output<std::string> content{this, "content", "what is in it"};
  Output<bool> is_same{this, "is_same", "whether it is the one of the tick before"};
  Output<std::int64_t> process{this, "process", "where"};
};

class Receive : public lockstep::Action<ReceivePorts> {
 public:
  Status tick() override {
    const auto it = parcel.get();
    content.set(it->content);
    is_same.set(it == last_);
    process.set(getpid());
    last_ = it;
    return Status::Success;
  }

 private:
  std::shared_ptr<const Parcel> last_;
};

struct WatchPorts : lockstep::Ports {
  Input<lockstep::Any> parcel{this, "parcel", "{parcel}", "the parcel, or anything else"};
  Output<bool> seen{this, "seen", "whether it is another one than before"};
};

class Watch : public lockstep::Action<WatchPorts> {
 public:
  Status tick() override {
    seen.set(parcel.changed());
    return Status::Success;
  }
};

}  // namespace
