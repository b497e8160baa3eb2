#include "python/src/background.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "maxwrench/interruption.h"
#include "maxwrench/solve.h"
#include "problems/make/bad_value.h"

namespace maxwrench::python {
namespace {

thread_local Watch* current_watch = nullptr;

/// A thread that computes, with its end.
class Worker {
 public:
  Worker(Watch& watch, const std::function<void(Watch&)>& compute)
      : thread_([this, &watch, &compute] {
          current_watch = &watch;
          try {
            compute(watch);
          } catch (...) {
            failure_ = std::current_exception();
          }
          const std::lock_guard lock(mutex_);
          done_ = true;
          ended_.notify_one();
        }) {}
  ~Worker() { thread_.join(); }

  /// Whether it ends within that time.
  bool ends_within(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, time, [this] { return done_; });
  }
  std::exception_ptr failure() const { return failure_; }

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false;
  std::exception_ptr failure_;
  std::thread thread_;  // the last member: it uses the others
};

/// Whether the user has pressed Ctrl-C. Throws what another handler of a signal throws.
bool interrupted() {
  if (PyErr_CheckSignals() == 0) return false;
  if (!PyErr_ExceptionMatches(PyExc_KeyboardInterrupt)) throw py::error_already_set();
  PyErr_Clear();
  return true;
}

bool wants_end(const py::object& callback, long evaluations) {
  if (callback.is_none()) return false;
  const py::object wish = callback(evaluations);
  const bool is_flag = py::isinstance<py::bool_>(wish) ||
                       py::isinstance(wish, py::module_::import("numpy").attr("bool_"));
  return is_flag && static_cast<bool>(py::bool_(wish));
}

}  // namespace

Watch* watch_of_this_thread() { return current_watch; }

py::handle search_ended() {
  // Made when the module is imported, by one thread.
  static const py::handle type =
      py::object(py::module_::import("maxwrench._errors").attr("SearchEnded")).release();
  return type;
}

void run_in_background(const py::object& callback, const std::function<void(Watch&)>& compute) {
  using namespace std::chrono_literals;
  Watch watch;
  std::exception_ptr of_python, of_computation;
  {
    // The lock is released while the worker lives, so that it can call Python and be joined.
    const py::gil_scoped_release released;
    Worker worker(watch, compute);
    for (int round = 1; !worker.ends_within(25ms); ++round) {
      const py::gil_scoped_acquire lock;
      try {
        if (interrupted() || (round % 4 == 0 && wants_end(callback, watch.evaluations))) {
          watch.stop = true;
        }
        if (watch.stop && watch.python_thread != 0) {
          PyThreadState_SetAsyncExc(watch.python_thread.exchange(0), search_ended().ptr());
        }
      } catch (...) {
        if (!of_python) of_python = std::current_exception();
        watch.stop = true;
      }
    }
    of_computation = worker.failure();
  }
  if (of_python) std::rethrow_exception(of_python);
  if (of_computation) std::rethrow_exception(of_computation);
}

void run_or_interrupt(const std::function<void()>& compute) {
  bool stopped = false;
  run_in_background(py::none(), [&](Watch& watch) {
    const Interruption interruption(&watch.stop);
    try {
      compute();
    } catch (const Interrupted&) {
    }
    stopped = watch.stop;
  });
  if (!stopped) return;
  PyErr_SetNone(PyExc_KeyboardInterrupt);
  throw py::error_already_set();
}

void watch_over(Watch& watch, Options& options) {
  options.progress = [&watch](long evaluations) { watch.evaluations = evaluations; };
  options.interrupted = [&watch] { return watch.stop.load(); };
}

void require_callback(const py::object& callback) {
  const bool absent = callback.is_none() || callback.is(py::bool_(false));
  if (absent || PyCallable_Check(callback.ptr()) != 0) return;
  throw BadValue("callback", std::string(py::repr(callback)), "a function, None or False");
}

Callback::Callback(const py::object& given, long budget, const std::string& label)
    : function_(given), is_line_(given.is_none()) {
  if (is_line_) {
    function_ = py::module_::import("maxwrench._progress").attr("progress")(budget, label);
  } else if (given.is(py::bool_(false))) {
    function_ = py::none();
  } else {
    require_callback(given);
  }
}

Callback::~Callback() {
  if (!is_line_) return;
  try {
    function_.attr("close")();
  } catch (py::error_already_set& error) {
    // A destructor cannot throw, so Ctrl-C is sent again.
    if (error.matches(PyExc_KeyboardInterrupt)) {
      PyErr_SetInterrupt();
    } else {
      error.discard_as_unraisable("the line of progress");
    }
  }
}

}  // namespace maxwrench::python
