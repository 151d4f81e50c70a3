// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/solver/sparse_cholesky.h"

#include <cholmod.h>

#include <stdexcept>

// Present when the BLAS behind CHOLMOD is OpenBLAS. Its threads would make the sums depend on their number.
extern "C" void openblas_set_num_threads(int count) __attribute__((weak));

namespace rakelight {
namespace {

/// A view of an Eigen matrix as CHOLMOD sees it; no copy.
cholmod_sparse view_of(const SparseCholesky::Matrix& lower) {
  cholmod_sparse view{};
  view.nrow = static_cast<size_t>(lower.rows());
  view.ncol = static_cast<size_t>(lower.cols());
  view.nzmax = static_cast<size_t>(lower.nonZeros());
  view.p = const_cast<int*>(lower.outerIndexPtr());
  view.i = const_cast<int*>(lower.innerIndexPtr());
  view.x = const_cast<double*>(lower.valuePtr());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

cholmod_dense view_of(const Eigen::VectorXd& vector) {
  cholmod_dense view{};
  view.nrow = static_cast<size_t>(vector.size());
  view.ncol = 1;
  view.nzmax = view.d = view.nrow;
  view.x = const_cast<double*>(vector.data());
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

}  // namespace

struct SparseCholesky::Impl {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  Eigen::Index nonzeros = -1;
  bool valid = false;

  Impl() {
    if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.final_ll = 1;
  }
  ~Impl() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  Eigen::VectorXd solve(int system, const Eigen::VectorXd& b) {
    cholmod_dense rhs = view_of(b);
    cholmod_dense* x = cholmod_solve(system, factor, &rhs, &common);
    if (x == nullptr) throw std::bad_alloc();
    Eigen::VectorXd result = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(x->x), b.size());
    cholmod_free_dense(&x, &common);
    return result;
  }
};

SparseCholesky::SparseCholesky() : impl_(std::make_unique<Impl>()) {}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

bool SparseCholesky::factorize(const Matrix& lower) {
  Impl& m = *impl_;
  cholmod_sparse view = view_of(lower);
  if (m.factor != nullptr && (m.factor->n != view.nrow || m.nonzeros != lower.nonZeros())) {
    cholmod_free_factor(&m.factor, &m.common);
  }
  if (m.factor == nullptr) {
    m.factor = cholmod_analyze(&view, &m.common);
    m.nonzeros = lower.nonZeros();
  }
  if (m.common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  cholmod_factorize(&view, m.factor, &m.common);
  if (m.common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  m.valid = m.common.status == CHOLMOD_OK;
  return m.valid;
}

Eigen::VectorXd SparseCholesky::solve(const Eigen::VectorXd& b) const { return impl_->solve(CHOLMOD_A, b); }

double SparseCholesky::reciprocal_condition() const {
  return impl_->valid ? cholmod_rcond(impl_->factor, &impl_->common) : 0.0;
}

}  // namespace rakelight
