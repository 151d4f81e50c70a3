// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The photometric term of a depth step over runs of pixels: for each corner of a pixel (refine/steps/normals.h) the normal,
// its energy and the derivatives of Eq. (31), corrected. All four corners are computed; those that do not exist have weight 0.
#pragma once

#include "refine/kernels/stencil_kernels.h"

namespace rakelight::kernels {

/// Consecutive pixels of one row. Pointers are to the run's first pixel. zeta is relative to any constant, with one
/// readable pixel to the left and a vector to the right.
struct CornerRun {
  const float *above, *here, *below;  ///< zeta of the row and of its neighbours
  const unsigned char* present;       ///< bit k: corner k exists; padded
  float fx, fy, x, y;                 ///< focal lengths and u - cx, v - cy of the first pixel
  int count;
};

/// e(n) of the run's pixels: pointers to the ten numbers (PhotometricTensors::Part); padded.
struct TensorRun {
  const float* part[10];
};

/// What a row's pixels add to the normal equations, by the direction of the corner's differences; index of a pair of
/// directions is the corner's. Arrays start at the run's first pixel.
struct EquationRow {
  float *xx[2], *yy[2], *bx[2], *by[2], *xy[4];  ///< towards right and left; down and up; the four corners
};

/// Four numbers a pixel, interleaved: of the corners right-down, left-down, right-up, left-up.

/// max(0, e) of each existing corner, 0 of the others.
void corner_energies(const CornerRun& run, const TensorRun& tensors, float* energies);

/// share / sqrt(1 + e / half) of each existing corner, 0 of the others. @param share [pixel], padded
void corner_weights(const CornerRun& run, const TensorRun& tensors, const float* share, float half,
                    float* weights);

/// Sum of weight e over the run.
float weighted_energy(const CornerRun& run, const TensorRun& tensors, const float* weights);

/// Half Hessian and negative half gradient of the weighted energy. @return the weighted energy
/// @param turning  whether the normal's length counts (Gauss-Newton) or is frozen (the paper's fixed point)
float corner_equations(const CornerRun& run, const TensorRun& tensors, const float* weights, bool turning,
                       const EquationRow& equations);

/// The system's rows of a run, gathered from the equations of its row and of the rows above and below.
void gather_equations(const EquationRow& above, const EquationRow& here, const EquationRow& below, int count,
                      const EntryRow& system, float* rhs);

/// Unit normals, interleaved, from the mean gradient over the existing corners; (0, 0, -1) without any.
void mean_normals(const CornerRun& run, float* normals);

}  // namespace rakelight::kernels
