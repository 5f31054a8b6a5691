// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "nef/base/monitor.h"
#include "nef/boolean/result/untouched.h"
#include "nef/sphere_map/label_function.h"

namespace nef {

/// The complex marked f(mark in a, mark in b) everywhere: the whole pipeline of a binary operation. Nothing if that is
/// `a`, item for item.
/// The query structures are asked for only if some component of one operand lies apart from the
/// other's boundary. On the threads of `monitor`; the complex is the same, item for item, for any number
/// of them.
std::optional<Complex> overlay_complexes(const Complex& a, const Complex& b, const LabelFunction& f,
                                         const std::function<const QueryStructure&()>& queries_a,
                                         const std::function<const QueryStructure&()>& queries_b,
                                         const Monitor& monitor);

}  // namespace nef
