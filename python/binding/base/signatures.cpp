// SPDX-License-Identifier: Apache-2.0
#include "binding/base/signatures.h"

#include <cstdlib>
#include <cstring>
#include <vector>

#include "binding/base/functions.h"

namespace nef::python {

namespace py = pybind11;

namespace {

// Where a part of a line ends: at one of `ends` outside of brackets and quotes.
std::size_t end_of_part(std::string_view line, std::size_t at, std::string_view ends) {
  int depth = 0;
  char quote = 0;
  for (; at < line.size(); ++at) {
    const char c = line[at];
    if (quote != 0) {
      if (c == '\\') ++at;
      if (c == quote) quote = 0;
    } else if (depth == 0 && ends.find(c) != std::string_view::npos) {
      return at;
    } else if (c == '\'' || c == '"') {
      quote = c;
    } else if (c == '(' || c == '[' || c == '{') {
      ++depth;
    } else if (c == ')' || c == ']' || c == '}') {
      --depth;
    }
  }
  return std::string_view::npos;
}

// "low: handle = 0" without its type.
std::string without_type(std::string_view parameter) {
  const std::size_t colon = parameter.find(": ");
  if (colon == std::string_view::npos) return std::string(parameter);  // "*"
  std::string name(parameter.substr(0, colon));
  const std::size_t equals = end_of_part(parameter, colon, "=");
  if (equals == std::string_view::npos) return name;
  return name + "=" + std::string(parameter.substr(equals + 2));
}

void give_signature(py::handle value) {
  const py::handle function = py::detail::get_function(value);
  if (!function || PyCFunction_Check(function.ptr()) == 0) return;
  PyMethodDef* const definition = reinterpret_cast<PyCFunctionObject*>(function.ptr())->m_ml;
  if (definition->ml_doc == nullptr) return;
  const std::string_view doc = definition->ml_doc;
  const std::size_t line_end = doc.find('\n');
  std::optional<std::string> text = text_signature(doc.substr(0, line_end));
  if (!text) return;
  const std::size_t begin = doc.find_first_not_of('\n', std::min(line_end, doc.size()));
  if (begin != std::string_view::npos) *text += doc.substr(begin, doc.find_last_not_of('\n') + 1 - begin);
  // pybind11 frees the text of its functions.
  char* const copy = strdup(text->c_str());
  if (copy == nullptr) throw std::bad_alloc();
  std::free(const_cast<char*>(definition->ml_doc));  // NOLINT(cppcoreguidelines-no-malloc)
  definition->ml_doc = copy;
}

}  // namespace

std::optional<std::string> text_signature(std::string_view line) {
  const std::size_t open = line.find('(');
  const std::size_t close = open == std::string_view::npos ? open : end_of_part(line, open + 1, ")");
  if (close == std::string_view::npos || line.substr(close + 1).substr(0, 4) != " -> ") return std::nullopt;
  std::string text(line.substr(0, open + 1));
  for (std::size_t at = open + 1; at < close;) {
    const std::size_t end = std::min(end_of_part(line, at, ","), close);
    if (at > open + 1) text += ", ";
    text += without_type(line.substr(at, end - at));
    at = end + 2;
  }
  return text + ")\n--\n\n";
}

void give_signatures(const py::module_& module) { for_each_function(module, give_signature); }

}  // namespace nef::python
