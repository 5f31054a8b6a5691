// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/formats/matlab.h"

#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <memory>

#include "apps/visual_hull/formats/foreign_parser.h"
#include "apps/visual_hull/scene/natural_order.h"
#include "apps/visual_hull/scene/pose.h"
#include "nef/base/error.h"

namespace nef::visual_hull {
namespace {

using Matrix34d = Eigen::Matrix<double, 3, 4>;

struct FileCloser {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct VariableFreer {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};

// The numbers of a real variable in MATLAB's order (columns first); nothing for other classes.
std::vector<double> numbers_of(const matvar_t& v) {
  std::vector<double> numbers;
  if (v.data == nullptr || v.isComplex != 0) return numbers;
  std::size_t count = 1;
  for (int i = 0; i < v.rank; ++i) count *= v.dims[i];
  if (v.class_type == MAT_C_DOUBLE) {
    const auto* data = static_cast<const double*>(v.data);
    numbers.assign(data, data + count);
  } else if (v.class_type == MAT_C_SINGLE) {
    const auto* data = static_cast<const float*>(v.data);
    numbers.assign(data, data + count);
  }
  return numbers;
}

bool is_matrix(const matvar_t& v) { return v.rank >= 2 && v.dims[0] == 3 && v.dims[1] == 4; }

Matrix34d matrix_at(const std::vector<double>& numbers, std::size_t index) {
  return Eigen::Map<const Matrix34d>(numbers.data() + 12 * index);  // Eigen keeps columns together, too
}

// The 3x4 matrices of a variable, none if it holds anything else.
std::vector<Matrix34d> matrices_of(const matvar_t& v) {
  std::vector<Matrix34d> matrices;
  if (v.class_type == MAT_C_CELL) {
    const auto* cells = static_cast<matvar_t* const*>(v.data);
    const std::size_t count = v.data_size > 0 ? v.nbytes / static_cast<std::size_t>(v.data_size) : 0;
    for (std::size_t i = 0; i < count && cells != nullptr; ++i) {
      if (cells[i] == nullptr || !is_matrix(*cells[i])) return {};
      const std::vector<double> numbers = numbers_of(*cells[i]);
      if (numbers.size() != 12) return {};
      matrices.push_back(matrix_at(numbers, 0));
    }
  } else if (is_matrix(v)) {
    const std::vector<double> numbers = numbers_of(v);
    for (std::size_t i = 0; 12 * (i + 1) <= numbers.size(); ++i) matrices.push_back(matrix_at(numbers, i));
  }
  return matrices;
}

struct Variable {
  std::string name;
  std::vector<Matrix34d> matrices;
};

bool fits(const std::string& name, const std::string& pattern) {
  const std::size_t star = pattern.find('*');
  if (star == std::string::npos) return name == pattern;
  const std::string after = pattern.substr(star + 1);
  return name.size() + 1 >= pattern.size() && name.compare(0, star, pattern, 0, star) == 0 &&
         name.compare(name.size() - after.size(), after.size(), after) == 0;
}

std::vector<Variable> read_variables(const std::string& file, std::string& all_names) {
  Mat_LogInitFunc("visual_hull", [](int, char*) {});  // errors are ours to tell
  const std::unique_ptr<mat_t, FileCloser> mat(Mat_Open(file.c_str(), MAT_ACC_RDONLY));
  if (!mat) throw nef::InputError(file + ": cannot be read as a MATLAB file");
  std::vector<Variable> variables;
  while (true) {
    const std::unique_ptr<matvar_t, VariableFreer> v(Mat_VarReadNext(mat.get()));
    if (!v) break;
    const std::string name = v->name != nullptr ? v->name : "";
    all_names += (all_names.empty() ? "" : ", ") + name;
    std::vector<Matrix34d> matrices = matrices_of(*v);
    if (!matrices.empty()) variables.push_back({name, std::move(matrices)});
  }
  return variables;
}

Scene scene_in(const std::string& file, const std::string& variable) {
  std::string names;
  std::vector<Variable> variables = read_variables(file, names);
  if (!variable.empty()) {
    variables.erase(
        std::remove_if(variables.begin(), variables.end(), [&](const Variable& v) { return !fits(v.name, variable); }),
        variables.end());
  }
  if (variables.empty()) {
    throw nef::InputError(fmt::format("{}: there are no 3x4 matrices{} among its variables ({})", file,
                                      variable.empty() ? "" : " of the name " + variable,
                                      names.empty() ? "none" : names));
  }
  const bool singles =
      std::all_of(variables.begin(), variables.end(), [](const Variable& v) { return v.matrices.size() == 1; });
  if (variables.size() > 1 && !singles) {
    std::string found;
    for (const Variable& v : variables) found += (found.empty() ? "" : ", ") + v.name;
    throw nef::InputError(file + ": several variables are 3x4 matrices (" + found + "): name one with --matrices");
  }
  // P9 before P10.
  std::stable_sort(variables.begin(), variables.end(),
                   [](const Variable& a, const Variable& b) { return naturally_before(a.name, b.name); });
  Scene scene;
  scene.format = "MATLAB file, " + (variables.size() > 1 ? "one variable per view" : "variable " + variables[0].name);
  for (const Variable& v : variables) {
    for (const Matrix34d& m : v.matrices) {
      scene.views.push_back(make_view(variables.size() > 1 ? v.name : std::to_string(scene.views.size() + 1), m));
    }
  }
  return scene;
}

}  // namespace

bool is_matlab_file(const std::string& bytes) { return bytes.rfind("MATLAB 5.0 MAT-file", 0) == 0; }

Scene read_matlab(const std::filesystem::path& file, const std::string& variable) {
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(file, ignored);
  return read_with_limits(file, "libmatio", ignored ? 0 : size, [&] { return scene_in(file.string(), variable); });
}

}  // namespace nef::visual_hull
