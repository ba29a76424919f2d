#pragma once
#include <petscksp.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "antilock/core/eigen_memory.hpp"

namespace antilock::distributed {

/// Thrown where a call of PETSc failed on this rank. The other ranks need not know of the failure.
/// The run is then aborted, because they may wait for this rank for ever.
struct PetscFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws PetscFailure where a call of PETSc failed. PETSc itself prints nothing (see Session).
inline void ok(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw PetscFailure(std::string("PETSc: ") + (text != nullptr ? text : "unknown error"));
}

/// A PETSc object that is destroyed with its owner. PETSc writes a new object to `&handle`.
template <class Object, PetscErrorCode (*destroy)(Object*)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(Object object) : object_(object) {}  ///< takes the ownership
  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Handle() {
    if (object_ != nullptr) destroy(&object_);
  }
  operator Object() const { return object_; }
  Object* operator&() { return &object_; }

 private:
  Object object_ = nullptr;
};
using Matrix = Handle<Mat, MatDestroy>;
using Vector = Handle<Vec, VecDestroy>;
using LinearSolver = Handle<KSP, KSPDestroy>;

/// The values of a vector that this rank owns. They must not be used after the end of its scope.
class Entries : public Eigen::Map<Eigen::VectorXd> {
 public:
  explicit Entries(Vec v) : Map(array_of(v), size_of(v)), v_(v) {}
  ~Entries() {
    PetscScalar* values = data();
    VecRestoreArray(v_, &values);
  }
  Entries(const Entries&) = delete;
  Entries& operator=(const Entries&) = delete;
  using Map::operator=;

 private:
  static PetscScalar* array_of(Vec v) {
    PetscScalar* values = nullptr;
    ok(VecGetArray(v, &values));
    return values;
  }
  static PetscInt size_of(Vec v) {
    PetscInt size = 0;
    ok(VecGetLocalSize(v, &size));
    return size;
  }
  Vec v_;
};

}  // namespace antilock::distributed
