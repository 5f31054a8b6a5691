// SPDX-License-Identifier: Apache-2.0
//
// A set is a shared body, its complex with the structure for questions, or a step that waits. Waiting steps are a list,
// each with the one before it; whoever looks at one collects the operands back to the last set that is there, and
// applies them all at once.
#include "nef/polyhedron.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "nef/complex/predicates_of_sets.h"
#include "nef/location/query_structure.h"
#include "nef/synthesis/complex_builder.h"

namespace nef {

namespace {

Complex constant(LabelId mark) {
  PlaneTable none;
  return ComplexBuilder(none, {}).finish(mark);
}

}  // namespace

struct Polyhedron::Body {
  explicit Body(Complex&& from) : complex(std::move(from)) {}

  Complex complex;
  // Built when first asked for; call_once makes that safe for readers in several threads.
  mutable std::once_flag once;
  mutable std::unique_ptr<const QueryStructure> queries;

  // The empty set has none, so that making one, or moving from a set, costs nothing.
  static const Body& of(const std::shared_ptr<const Body>& body) {
    if (body) return *body;
    static const Body empty(constant(0));
    return empty;
  }
};

// One step of a loop. What it was made from is let go of once it has been computed.
class Polyhedron::WaitingStep {
 public:
  // The first step on `base`.
  WaitingStep(Step kind, std::shared_ptr<const Body> base, std::shared_ptr<const Body> with)
      : kind_(kind),
        base_vertices_(count(base)),
        vertices_(count(with)),
        base_(std::move(base)),
        with_(std::move(with)) {}
  // The next one behind `before`.
  WaitingStep(std::shared_ptr<const WaitingStep> before, std::shared_ptr<const Body> with)
      : kind_(before->kind_),
        base_vertices_(before->base_vertices_),
        vertices_(before->vertices_ + count(with)),
        before_(std::move(before)),
        with_(std::move(with)) {}
  WaitingStep(const WaitingStep&) = delete;
  WaitingStep& operator=(const WaitingStep&) = delete;
  // Lists may be long, so that steps go one after the other instead of each within the next one.
  ~WaitingStep() { drop_steps_before(); }

  // True if so small a set may stand beside so large a one until somebody looks.
  static bool can_wait(std::size_t vertices, std::size_t base_vertices) {
    constexpr std::size_t kMuchSmaller = 8;
    return kMuchSmaller * vertices <= base_vertices;
  }

  [[nodiscard]] bool is_computed() const { return is_computed_.load(std::memory_order_acquire); }

  // True if such a step with so many vertices may follow this one.
  [[nodiscard]] bool takes(Step kind, std::size_t vertices) const {
    return kind == kind_ && !is_computed() && can_wait(vertices, base_vertices_) &&
           vertices_ + vertices <= base_vertices_;
  }

  const std::shared_ptr<const Body>& body(const Monitor& monitor) const {
    if (is_computed()) return body_;
    const std::scoped_lock lock(computing_);
    if (is_computed()) return body_;
    std::vector<Polyhedron> operands{Polyhedron(with_)};
    std::shared_ptr<const Body> base = base_;
    for (std::shared_ptr<const WaitingStep> each = before_; each;) each = each->collect(operands, base);
    operands.push_back(Polyhedron(std::move(base)));
    std::reverse(operands.begin(), operands.end());
    body_ = applied(operands, monitor).body_;
    base_.reset();
    with_.reset();
    drop_steps_before();
    is_computed_.store(true, std::memory_order_release);
    return body_;
  }

 private:
  static std::size_t count(const std::shared_ptr<const Body>& body) { return Body::of(body).complex.vertex_count(); }

  // Of the base and what follows.
  [[nodiscard]] Polyhedron applied(std::span<const Polyhedron> operands, const Monitor& monitor) const {
    if (kind_ == Step::kUnite) return unite_all(operands, monitor);
    return subtract(operands.front(), unite_all(operands.subspan(1), monitor), monitor);
  }

  // Adds the operand of this step and tells its base, or what it has become. Returns the step before it, null if there
  // is none.
  std::shared_ptr<const WaitingStep> collect(std::vector<Polyhedron>& operands,
                                             std::shared_ptr<const Body>& base) const {
    const std::scoped_lock lock(computing_);
    if (is_computed()) {
      base = body_;
      return nullptr;
    }
    operands.push_back(Polyhedron(with_));
    base = base_;
    return before_;
  }

  void drop_steps_before() const {
    while (before_ && before_.use_count() == 1) before_ = before_->take_before();
    before_.reset();
  }
  // Locked, since a thread that held this step until now may have computed it.
  std::shared_ptr<const WaitingStep> take_before() const {
    const std::scoped_lock lock(computing_);
    return std::move(before_);
  }

  Step kind_;
  std::size_t base_vertices_;
  std::size_t vertices_;  // of the operands of this step and of those before it
  mutable std::mutex computing_;
  mutable std::atomic<bool> is_computed_ = false;
  mutable std::shared_ptr<const Body> body_;  // once it is computed
  // Until then:
  mutable std::shared_ptr<const Body> base_;           // of a first step
  mutable std::shared_ptr<const WaitingStep> before_;  // of any other
  mutable std::shared_ptr<const Body> with_;
};

Polyhedron::Polyhedron() = default;

Polyhedron Polyhedron::everything() { return Polyhedron(constant(1)); }

Polyhedron::Polyhedron(Complex&& complex) : body_(std::make_shared<Body>(std::move(complex))) {}

std::optional<Polyhedron> Polyhedron::waiting(Step kind, const Polyhedron& a, const Polyhedron& b) {
  const std::size_t vertices = b.complex().vertex_count();
  Polyhedron result;
  if (vertices == 0) return std::nullopt;
  if (a.waits()) {
    if (!a.step_->takes(kind, vertices)) return std::nullopt;
    result.step_ = std::make_shared<WaitingStep>(a.step_, b.body());
  } else {
    if (!WaitingStep::can_wait(vertices, a.complex().vertex_count())) return std::nullopt;
    result.step_ = std::make_shared<WaitingStep>(kind, a.body(), b.body());
  }
  return result;
}

bool Polyhedron::waits() const { return step_ && !step_->is_computed(); }

void Polyhedron::compute(const Monitor& monitor) const { static_cast<void>(body(monitor)); }

const std::shared_ptr<const Polyhedron::Body>& Polyhedron::body(const Monitor& monitor) const {
  return step_ ? step_->body(monitor) : body_;
}

Complex Polyhedron::take_complex() && {
  const std::shared_ptr<const Body> own = body();
  body_.reset();
  step_.reset();
  // Bodies are made as what may change, and nobody else sees one that is held once.
  if (own.use_count() != 1) return Body::of(own).complex;
  std::atomic_thread_fence(std::memory_order_acquire);  // after what the last other holder did
  return std::move(const_cast<Body&>(*own).complex);
}

const Complex& Polyhedron::complex() const { return Body::of(body()).complex; }

bool Polyhedron::is_empty() const { return complex().vertex_count() == 0 && complex().volumes[kOuterVolume].mark == 0; }

bool Polyhedron::is_everything() const {
  return complex().volumes[kOuterVolume].mark != 0 && without_labels(*this).complex().vertex_count() == 0;
}

bool Polyhedron::is_bounded() const { return complex().volumes[kOuterVolume].mark == 0; }

bool Polyhedron::is_open() const { return is_open_set(without_labels(*this).complex()); }

bool Polyhedron::is_closed() const { return is_closed_set(without_labels(*this).complex()); }

bool Polyhedron::is_regular() const { return is_regular_set(without_labels(*this).complex()); }

const QueryStructure& Polyhedron::queries() const {
  const Body& own = Body::of(body());
  std::call_once(own.once, [&own] { own.queries = std::make_unique<const QueryStructure>(own.complex); });
  return *own.queries;
}

}  // namespace nef
