// SPDX-License-Identifier: Apache-2.0
#include "binding/base/call.h"

namespace nef::python {
namespace {

// Each extension module has calls of its own to wait for.
void wait_at_exit() {
  static bool done = false;  // guarded by the interpreter's lock
  if (done) return;
  done = true;
  py::module_::import("atexit").attr("register")(py::cpp_function(&wait_for_abandoned_calls));
}

}  // namespace

bool in_main_thread() {
  wait_at_exit();
  // The main thread never changes while the interpreter lives (after a fork it is the one that forked).
  const py::object threading = owned(outliving_python([] { return PyImport_ImportModule("threading"); }));
  const py::object main =
      owned(outliving_python([&] { return PyObject_CallMethod(threading.ptr(), "main_thread", nullptr); }));
  const py::object ident = owned(outliving_python([&] { return PyObject_GetAttrString(main.ptr(), "ident"); }));
  return PyThread_get_thread_ident() == py::cast<unsigned long>(ident);
}

std::atomic<int>& abandoned_calls() {
  static std::atomic<int> count{0};
  return count;
}

void wait_for_abandoned_calls() {
  constexpr std::chrono::milliseconds kStep{10};
  constexpr int kSteps = 500;
  const LockReleased unlocked;
  for (int i = 0; i < kSteps && abandoned_calls() > 0; ++i) std::this_thread::sleep_for(kStep);
}

ProgressFunction::ProgressFunction(const py::object& function) {
  if (function.is_none()) return;
  if (PyCallable_Check(function.ptr()) == 0) throw py::type_error("progress must be a function or None");
  function_ = std::shared_ptr<py::object>(new py::object(function), [](py::object* held) {
    const LockHeld locked;
    PyObject* const last = held->release().ptr();
    delete held;
    outliving_python([last] { Py_DECREF(last); });  // may run a __del__
  });
}

py::object progress_variable() {
  // Guarded by the interpreter's lock. Never released, as the interpreter may be gone before static objects are.
  static PyObject* variable = nullptr;
  if (variable == nullptr) variable = PyContextVar_New("nef.progress", Py_None);
  if (variable == nullptr) throw py::error_already_set();
  return py::reinterpret_borrow<py::object>(variable);
}

ProgressFunction progress_of_context() {
  PyObject* function = nullptr;
  if (PyContextVar_Get(progress_variable().ptr(), nullptr, &function) != 0) throw py::error_already_set();
  return ProgressFunction(py::reinterpret_steal<py::object>(function));
}

nef::ProgressFunction told_by(const ProgressFunction& progress, const Monitor& monitor) {
  if (!progress) return {};
  return [progress, monitor](const char* phase, std::size_t done, std::size_t total) {
    progress(monitor, phase, done, total);
  };
}

}  // namespace nef::python
