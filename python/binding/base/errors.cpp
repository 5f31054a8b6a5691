// SPDX-License-Identifier: Apache-2.0
#include "binding/base/errors.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string_view>
#include <utility>

#include "apps/program/expression/expression.h"
#include "nef/export/mesh_losses.h"

namespace nef::python {

namespace py = pybind11;

namespace {

// What programs say otherwise than by the name of an argument; longer texts first.
constexpr std::pair<std::string_view, std::string_view> kPhrases[] = {
    {"with --box x0,y0,z0,x1,y1,z1", "as box=((x0, y0, z0), (x1, y1, z1))"},
    {", or use --start x,y,z", ", or give start="},
    {", or use --goal x,y,z", ", or give goal="},
    {"give --images DIR or --silhouette", "give images="},
    {"--matrices 'world_mat_*'", "matrices='world_mat_*'"},
    {"--turntable N without --K", "a turntable without intrinsics"},
    {"--turntable without --K", "a turntable without intrinsics"},
    {"--way direct", "way='direct'"},
    {"--way cones", "way='cones'"},
    {"--threads 1", "threads=1"},
    {"--as-surface", "surface=True"},
    {"without --strict", "with strict=False"},
    {"with --exact", "with exact=True"},
    {"--simplify", "tolerance"},
    {"--border", "unknown_beyond"},
    {"--K", "intrinsics"},
    {"--widest-box", "growth='box'"},
    {"--time", "seconds"},
    {"nef repair", "nef.repair"},
    {"`nef.repair`", "nef.repair"},
};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// The type of a missing file is a FileNotFoundError of Python, too.
const char* type_of_input_error(const std::string& text) {
  return text.find(": no such file") == std::string::npos ? "InputError" : "MissingFileError";
}

void raise(const char* type, const std::string& text, const py::dict& attributes) {
  const py::object exception = py::module_::import("nef.errors").attr(type);
  const py::object instance = exception(text, **attributes);
  PyErr_SetObject(exception.ptr(), instance.ptr());
}

py::dict guilty_elements(const MeshError& error) {
  py::list vertices;
  py::list edges;
  py::list faces;
  for (const MeshProblem& problem : error.problems()) {
    if (problem.legal) continue;
    for (const std::uint32_t v : problem.vertices) vertices.append(v);
    for (const auto& edge : problem.edges) edges.append(py::make_tuple(edge[0], edge[1]));
    for (const std::uint32_t f : problem.faces) faces.append(f);
  }
  py::dict result;
  result["vertices"] = vertices;
  result["edges"] = edges;
  result["faces"] = faces;
  return result;
}

}  // namespace

std::string in_words_of_python(std::string text) {
  // "--crossings odd (crossings=\"odd\" in Python)"
  constexpr std::string_view kInPython = " in Python)";
  for (std::size_t end = text.find(kInPython); end != std::string::npos; end = text.find(kInPython)) {
    const std::size_t open = text.rfind(" (", end);
    const std::size_t option = open == std::string::npos ? open : text.rfind("--", open);
    if (option == std::string::npos) break;
    text.erase(end, kInPython.size());
    text.erase(option, open + 2 - option);
  }
  for (const auto& [phrase, instead] : kPhrases) {
    for (std::size_t at = text.find(phrase); at != std::string::npos; at = text.find(phrase, at + instead.size())) {
      text.replace(at, phrase.size(), instead);
    }
  }
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at + 1)) {
    const bool begins = at == 0 || text[at - 1] == ' ' || text[at - 1] == '(' || text[at - 1] == '`';
    if (!begins || at + 2 >= text.size() || !is_letter(text[at + 2])) continue;
    text.erase(at, 2);
    for (; at < text.size() && (is_letter(text[at]) || text[at] == '-'); ++at) {
      if (text[at] == '-') text[at] = '_';
    }
  }
  return text;
}

void warn(const Messages& messages, int level) {
  if (messages.empty()) return;
  const py::object category = py::module_::import("nef.errors").attr("InputWarning");
  for (const std::string& message : messages) {
    if (message.starts_with(kOpenPartsClosed)) continue;  // of every difference of two closed sets
    const std::string text = in_words_of_python(message);
    if (PyErr_WarnEx(category.ptr(), text.c_str(), level) != 0) throw py::error_already_set();
  }
}

void register_errors() {
  // pybind11 asks for a function of this type.
  // NOLINTNEXTLINE(performance-unnecessary-value-param)
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const MeshError& error) {
      raise("InputError", in_words_of_python(error.what()), guilty_elements(error));
    } catch (const ExpressionError& error) {
      py::dict attributes;
      attributes["offset"] = error.offset();
      raise("InputError", in_words_of_python(error.what()), attributes);
    } catch (const InputError& error) {
      const std::string text = in_words_of_python(error.what());
      raise(type_of_input_error(text), text, {});
    } catch (const UnsupportedError& error) {
      raise("UnsupportedError", in_words_of_python(error.what()), {});
    } catch (const Error& error) {
      raise("Error", in_words_of_python(error.what()), {});
    }
  });
}

}  // namespace nef::python
