// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/mesh/mesh_check.h"

namespace nef::python {

/// A mesh that bounds no solid, with the guilty elements.
class MeshError : public InputError {
 public:
  MeshError(const std::string& what, std::vector<MeshProblem> problems)
      : InputError(what), problems_(std::move(problems)) {}
  [[nodiscard]] const std::vector<MeshProblem>& problems() const { return problems_; }

 private:
  std::vector<MeshProblem> problems_;
};

/// Gives each note as a nef.InputWarning, at the line that called the function of the extension module, or, for
/// functions that the package itself calls, `level` - 1 frames above it.
void warn(const Messages& messages, int level = 1);

/// A message of the library in the words of Python: options of programs become arguments, "--at-least" is "at_least".
std::string in_words_of_python(std::string text);

/// Makes the exceptions of nef.errors out of those of the suite, for all extension modules. Called once.
void register_errors();

}  // namespace nef::python
