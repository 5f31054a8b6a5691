// SPDX-License-Identifier: Apache-2.0
//
// The interpreter's lock, released and taken in threads that may outlive the interpreter.
//
// Daemon threads go on while Python ends. A thread that then asks for the lock is ended by Python with pthread_exit,
// which unwinds its stack; in C++ that runs destructors that touch Python without the lock, and ends the whole program
// with "terminate called" at the first function that lets nothing out. Here such a thread stops where it is until the
// process has ended, as Python itself does from version 3.14 on.
#pragma once

#include <cxxabi.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

namespace nef::python {

namespace py = pybind11;

/// Calls a function in which Python may end the thread; the thread waits for the end of the process instead. Nothing of
/// C++ that holds Python objects may be inside, as it would be unwound before: call Python's C functions, one at a
/// time.
template <typename Function>
decltype(auto) outliving_python(const Function& function) {
  try {
    return function();
  } catch (const abi::__forced_unwind&) {
    for (;;) pause();
  }
}

/// The new reference that a C function of Python returned, which may have run code of Python's; throws its error if it
/// returned none.
inline py::object owned(PyObject* result) {
  if (result == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::object>(result);
}

/// Releases the lock, which the thread holds, until the end of a block.
class LockReleased {
 public:
  LockReleased() : state_(PyEval_SaveThread()) {}
  ~LockReleased() {
    outliving_python([this] { PyEval_RestoreThread(state_); });
  }
  LockReleased(const LockReleased&) = delete;
  LockReleased& operator=(const LockReleased&) = delete;

 private:
  PyThreadState* state_;
};

/// Takes the lock, which the thread may hold already, until the end of a block.
class LockHeld {
 public:
  LockHeld() : state_(outliving_python([] { return PyGILState_Ensure(); })) {}
  ~LockHeld() { PyGILState_Release(state_); }
  LockHeld(const LockHeld&) = delete;
  LockHeld& operator=(const LockHeld&) = delete;

 private:
  PyGILState_STATE state_;
};

}  // namespace nef::python
