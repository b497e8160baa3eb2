#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <functional>
#include <string>

namespace maxwrench {
struct Options;
}

namespace maxwrench::python {

namespace py = pybind11;

/// A computation in another thread, which Python can watch and stop.
struct Watch {
  std::atomic<long> evaluations{0};  ///< written by the computation
  std::atomic<bool> stop{false};     ///< written by Python; the computation obeys
  /// The thread of a search in Python, which need not call its objective and so does not see
  /// `stop`; 0: none. Once the computation is to stop, an exception is raised in it.
  std::atomic<unsigned long> python_thread{0};
};

/// The watch of the computation in this thread; null in others.
Watch* watch_of_this_thread();

/// The exception that ends a search in Python.
py::handle search_ended();

/// Runs `compute` in another thread, without the interpreter's lock. Meanwhile the calling thread
/// handles signals, and every tenth of a second calls `callback` with the number of evaluations;
/// if that returns True, or the user presses Ctrl-C, it asks the computation to stop.
///
/// Rethrows what `compute` or `callback` throws. Ctrl-C is an answer, not an exception: the best so
/// far is returned.
///
/// @param callback  a function of one number, or None
/// @param compute   the computation
void run_in_background(const py::object& callback, const std::function<void(Watch&)>& compute);

/// Runs `compute`, which has no partial result, likewise. Ctrl-C raises KeyboardInterrupt.
void run_or_interrupt(const std::function<void()>& compute);

/// Lets Python watch and stop what is computed with these options.
void watch_over(Watch& watch, Options& options);

/// Throws std::invalid_argument unless it is a function, None or False.
void require_callback(const py::object& callback);

/// The callback of a call: that of the caller, or for None a line of progress on a terminal or in a
/// notebook, which goes with this object.
class Callback {
 public:
  /// @param given   a function of one number, None for the line, or False for neither
  /// @param budget  the largest number of evaluations; 0: not known
  /// @param label   what is computed
  Callback(const py::object& given, long budget, const std::string& label);
  ~Callback();
  Callback(const Callback&) = delete;
  Callback& operator=(const Callback&) = delete;
  /// A function of one number, or None.
  const py::object& function() const { return function_; }

 private:
  py::object function_;
  bool is_line_;
};

}  // namespace maxwrench::python
