// A shared library that is loaded when it is needed first: a command that does not need it starts
// without. A derived struct has the functions that it uses as members:
//
//   struct Zmq : LateLibrary {
//     Zmq() : LateLibrary("libzmq.so.5") {}
//     decltype(&zmq_bind) bind = function("zmq_bind");
//   };
#pragma once

namespace lockstep::host {

class LateLibrary {
 public:
  LateLibrary(const LateLibrary&) = delete;
  LateLibrary& operator=(const LateLibrary&) = delete;

 protected:
  // Throws a std::runtime_error if there is no such library. It stays loaded until the process
  // ends, since it may have threads.
  explicit LateLibrary(const char* file);
  ~LateLibrary() = default;

  class Function {
   public:
    explicit Function(void* address) : address_(address) {}
    template <class Pointer>
    operator Pointer() const {
      return reinterpret_cast<Pointer>(address_);
    }

   private:
    void* address_;
  };
  // Throws a std::runtime_error if the library does not have it.
  Function function(const char* name) const;

 private:
  const char* file_;
  void* handle_;
};

}  // namespace lockstep::host
