#include "python/src/shared_objects.h"

namespace maxwrench::python {

Shared share(const py::object& object) {
  return {new py::object(object), [](const py::object* kept) {
            const py::gil_scoped_acquire lock;
            delete kept;
          }};
}

std::string attribute_of(const py::object& object, const char* name, const std::string& otherwise) {
  const py::object value = py::getattr(object, name, py::none());
  return value.is_none() ? otherwise : py::str(value).cast<std::string>();
}

bool flag_of(const py::object& object, const char* name) {
  return py::getattr(object, name, py::bool_(false)).cast<bool>();
}

}  // namespace maxwrench::python
