// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The albedo regularisers of the paper as printed, one channel at a time.
#pragma once

#include <Eigen/SparseCore>

#include "refine/options.h"
#include "refine/pixel_grid.h"

namespace rakelight {

/// Rows sum_k w_k (x_p - x_k) over the four neighbours, w of Eq. (11): intensities I in [0, 1], depth z in the unit of
/// options.depth_sigma; w = 0 where |I - I_k|^2 > options.cutoff (RGBD-Fusion's tau; 0: no cut-off).
Eigen::SparseMatrix<double> anisotropic_laplacian(const PixelGrid& grid, const Eigen::VectorXd& I,
                                                  const Eigen::VectorXd& z, const AlbedoOptions& options);

/// Eq. (10): min |rho S - I|^2 + lambda |W rho|^2. @return false when the system is singular; rho is then untouched.
bool solve_albedo(const Eigen::VectorXd& S, const Eigen::VectorXd& I, const Eigen::SparseMatrix<double>& W,
                  double lambda, Eigen::VectorXd& rho);

/// RGBD-Fusion's local term: min |beta - rest|^2 + lambda_b1 |W beta|^2 + lambda_b2 |beta|^2, rest = I - rho S.
/// @return false when the system is singular; beta is then untouched.
bool solve_local_term(const Eigen::VectorXd& rest, const Eigen::SparseMatrix<double>& W,
                      const AlbedoOptions& options, Eigen::VectorXd& beta);

/// Eq. (20) with both weights divided by lambda_rho2: min lambda |w grad P|^2 + |P - before|^2, w of Eq. (21). The ratio
/// term would count 1e-13 here, below a double's rounding, and is left out. @return false when singular.
bool diffuse_albedo(const PixelGrid& grid, const Eigen::VectorXd& I, double lambda, double sigma,
                    Eigen::VectorXd& P);

}  // namespace rakelight
