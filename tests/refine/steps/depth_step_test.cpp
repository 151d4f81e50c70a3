// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/depth_step.h"

#include <gtest/gtest.h>

#include <cmath>

#include <random>

#include "refine/steps/curvature_prior.h"
#include "tests/refine/dense_system.h"
#include "tests/refine/exact_surface.h"

namespace rakelight {
namespace {

/// One photometric equation at a pixel: weight (l.n - rest)^2.
struct Row {
  Eigen::Vector3d l;
  double rest, weight;
};

/// Random equations on a few pixels, half-size depth cells, and what a depth step needs of them.
class RandomProblem {
 public:
  explicit RandomProblem(unsigned seed, Stencil stencil = Stencil::symmetric)
      : random_(seed), corners_(make_corners(grid_, stencil)) {
    const size_t pixels = static_cast<size_t>(grid_.size());
    rows_.resize(pixels);
    tensors_ = PhotometricTensors(pixels);
    corner_weight_ = CornerWeights(pixels);
    for (size_t p = 0; p < pixels; ++p) {
      for (int i = 0; i < 5; ++i)
        add_row(p, Eigen::Vector3d(uniform(), uniform(), -1), 0.8 + 0.4 * uniform());
      for (int k = 0; k < kCorners; ++k)
        if (corners_.has(static_cast<int>(p), k))
          corner_weight_[p][static_cast<size_t>(k)] = static_cast<float>(0.6 + 0.4 * uniform());
    }
    prior_.cells = make_cells(grid_, 2);
    const auto cells = static_cast<Eigen::Index>(prior_.cells.size());
    prior_.cell_weight = 3 + vector(cells, 2).array();
    prior_.cell_target = vector(cells, 0.02);
    prior_.start = vector(grid_.size(), 0.02);
  }

  DepthProblem problem() const { return {grid_, corners_, tensors_, corner_weight_, prior_}; }

  double uniform() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  Eigen::VectorXd vector(Eigen::Index size, double spread) {
    return Eigen::VectorXd::NullaryExpr(size, [&] { return spread * uniform(); });
  }

  /// Replaces all equations by such as zeta fulfils exactly (forward stencil), the prior included.
  void make_exact(const Eigen::VectorXd& zeta) {
    for (int p = 0; p < grid_.size(); ++p) {
      auto& rows = rows_[static_cast<size_t>(p)];
      const std::vector<Row> old = std::exchange(rows, {});
      tensors_.set(static_cast<size_t>(p), {});
      if (corners_.first(p) < 0) continue;
      const Corner corner = corner_at(grid_, p, corners_.first(p));
      const Eigen::Vector2f g = corner_gradient(corner, p, zeta);
      const Eigen::Vector3d n = normal_frame(grid_, p).raw(g.x(), g.y()).cast<double>().normalized();
      for (const Row& row : old) add_row(static_cast<size_t>(p), row.l, row.l.dot(n));
    }
    prior_.cell_target = cell_means(prior_.cells, zeta);
    prior_.start = zeta;
  }

  /// Gauss-Newton step by a dense least-squares solve of every row of every corner, linearised here anew.
  Eigen::VectorXd dense_step(const Eigen::VectorXd& zeta) const;

 private:
  void add_row(size_t p, const Eigen::Vector3d& l, double rest) {
    const Row row{l, rest, 0.6 + 0.4 * uniform()};
    rows_[p].push_back(row);
    const Eigen::Vector3f lf = l.cast<float>();
    const auto w = static_cast<float>(row.weight), r = static_cast<float>(rest);
    PhotometricTensor sum = tensors_[p];
    sum.G += w * lf * lf.transpose();
    sum.h += w * r * lf;
    sum.e0 += w * r * r;
    tensors_.set(p, sum);
  }

  std::mt19937 random_;
  PixelGrid grid_ = test::bitten_grid();
  CornerList corners_;
  std::vector<std::vector<Row>> rows_;
  PhotometricTensors tensors_;
  CornerWeights corner_weight_;
  DepthPrior prior_;
};

/// n(zeta_x, zeta_y) in double, written out from Eq. (5).
Eigen::Vector3d normal_at(const PixelGrid& grid, int p, double zx, double zy) {
  const cv::Point at = grid.pixels[static_cast<size_t>(p)];
  const Camera& camera = grid.camera;
  return Eigen::Vector3d(camera.fx * zx, camera.fy * zy,
                         -1 - (at.x - camera.cx) * zx - (at.y - camera.cy) * zy)
      .normalized();
}

Eigen::VectorXd RandomProblem::dense_step(const Eigen::VectorXd& zeta) const {
  std::vector<Eigen::VectorXd> matrix;
  std::vector<double> rest;
  const auto add = [&](double weight, const Eigen::VectorXd& row, double value) {
    matrix.push_back(std::sqrt(weight) * row);
    rest.push_back(std::sqrt(weight) * value);
  };
  for (int p = 0; p < grid_.size(); ++p) {
    for (int k = 0; k < kCorners; ++k) {
      if (!corners_.has(p, k)) continue;
      const Corner corner = corner_at(grid_, p, k);
      const double sx = corner.x_sign > 0 ? 1 : -1, sy = corner.y_sign > 0 ? 1 : -1;
      const double zx = sx * (zeta[corner.x_neighbor] - zeta[p]),
                   zy = sy * (zeta[corner.y_neighbor] - zeta[p]);
      const double h = 1e-6;  // the derivative of n, by differences
      const Eigen::Vector3d n = normal_at(grid_, p, zx, zy);
      const Eigen::Vector3d n_x =
          (normal_at(grid_, p, zx + h, zy) - normal_at(grid_, p, zx - h, zy)) / (2 * h);
      const Eigen::Vector3d n_y =
          (normal_at(grid_, p, zx, zy + h) - normal_at(grid_, p, zx, zy - h)) / (2 * h);
      for (const Row& equation : rows_[static_cast<size_t>(p)]) {
        Eigen::VectorXd row = Eigen::VectorXd::Zero(grid_.size());
        row[corner.x_neighbor] += sx * equation.l.dot(n_x);
        row[corner.y_neighbor] += sy * equation.l.dot(n_y);
        row[p] -= sx * equation.l.dot(n_x) + sy * equation.l.dot(n_y);
        const double weight =
            equation.weight *
            static_cast<double>(corner_weight_[static_cast<size_t>(p)][static_cast<size_t>(k)]);
        add(weight, row, equation.rest - equation.l.dot(n));
      }
    }
    add(prior_.floor, Eigen::VectorXd::Unit(grid_.size(), p), prior_.start[p] - zeta[p]);
  }
  const Eigen::MatrixXd K = test::dense_means(prior_.cells);
  for (Eigen::Index cell = 0; cell < K.rows(); ++cell)
    add(prior_.cell_weight[cell], K.row(cell).transpose(), prior_.cell_target[cell] - K.row(cell).dot(zeta));
  Eigen::MatrixXd A(static_cast<Eigen::Index>(matrix.size()), grid_.size());
  for (Eigen::Index i = 0; i < A.rows(); ++i) A.row(i) = matrix[static_cast<size_t>(i)].transpose();
  return A.colPivHouseholderQr().solve(Eigen::Map<Eigen::VectorXd>(rest.data(), A.rows()));
}

TEST(Tensors, OfSecondOrderLampsHaveTheSlopeOfTheTrueEnergy) {
  const test::ExactSurface sphere = test::exact_sphere(24);
  SurfaceState state =
      test::exact_state(sphere, test::varied_albedo(sphere), test::second_order_lamps(), false);
  Observations images = test::images_of(state);
  test::change_samples(images, [](PlainSamples& samples) {
    for (float& radiance : samples.radiance) radiance *= 0.9f;
  });
  const auto tensors = accumulate_tensors(images, state);
  const auto energy = [&](int p, const Eigen::Vector3d& n) {
    double sum = 0;
    for (int i = 0; i < images.images; ++i) {
      const Lamp& lamp = state.lamps[static_cast<size_t>(i)];
      for (int c = 0; c < 3; ++c) {
        const Eigen::Matrix3d Q = lamp.Q[static_cast<size_t>(c)].cast<double>();
        const double S =
            lamp.l.row(c).cast<double>().dot(n) + n.dot(Q * n) + static_cast<double>(lamp.phi[c]);
        sum += std::pow(
            static_cast<double>(state.albedo(c, p)) * S - static_cast<double>(images.channel(i, c)[p]), 2);
      }
    }
    return sum;
  };
  for (int p = 0; p < sphere.grid.size(); p += 7) {
    const Eigen::Vector3d n = state.normals.col(p).cast<double>();
    const PhotometricTensor tensor = tensors[static_cast<size_t>(p)];
    EXPECT_NEAR(static_cast<double>(tensor.energy(n.cast<float>())), energy(p, n),
                1e-4 + 1e-3 * energy(p, n));
    const Eigen::Vector3d slope = 2 * (tensor.G * n.cast<float>() - tensor.h).cast<double>();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d h = 1e-5 * Eigen::Vector3d::Unit(k);
      EXPECT_NEAR(slope[k], (energy(p, n + h) - energy(p, n - h)) / 2e-5, 1e-3) << p;
    }
  }
}

TEST(DepthSystem, ItsRightSideIsMinusHalfTheEnergysGradient) {
  RandomProblem random(1);
  const DepthProblem problem = random.problem();
  const Eigen::VectorXd zeta = random.vector(problem.grid.size(), 0.02);
  const Eigen::VectorXd rhs =
      test::pixel_rhs(problem.grid, depth_system(problem, zeta, Linearization::gauss_newton));
  for (Eigen::Index p = 0; p < zeta.size(); ++p) {
    const Eigen::VectorXd h = 2e-4 * Eigen::VectorXd::Unit(zeta.size(), p);
    const double slope = (depth_energy(problem, zeta + h) - depth_energy(problem, zeta - h)) / 4e-4;
    EXPECT_NEAR(-2 * rhs[p], slope, 2e-3 * rhs.norm()) << "pixel " << p;
  }
}

TEST(DepthSystem, ComesWithTheEnergyAndIsTheSameInUsedMemory) {
  for (const int scale : {1, 2}) {
    RandomProblem random(6);
    DepthPrior prior = random.problem().prior;
    const DepthProblem plain = random.problem();
    prior.cells = make_cells(plain.grid, scale);
    prior.cell_weight = 3 + random.vector(prior.cells.size(), 2).array();
    prior.cell_target = random.vector(prior.cells.size(), 0.02);
    CurvatureWeights curvature = reachable_differences(plain.grid, {}, {});
    const DepthProblem problem{plain.grid,          plain.corners, plain.tensors,
                               plain.corner_weight, prior,         curvature};
    const Eigen::VectorXd zeta = random.vector(plain.grid.size(), 0.02);
    DepthSystem used = depth_system(plain, random.vector(plain.grid.size(), 0.1), Linearization::fixed_point);
    for (const DepthProblem* each : {&problem, &plain}) {
      EXPECT_DOUBLE_EQ(fill_depth_system(*each, zeta, Linearization::gauss_newton, used),
                       depth_energy(*each, zeta));
      const DepthSystem fresh = depth_system(*each, zeta, Linearization::gauss_newton);
      EXPECT_EQ(used.rhs, fresh.rhs);
      EXPECT_EQ(used.stencil.diagonal, fresh.stencil.diagonal);
      EXPECT_EQ(used.stencil.right, fresh.stencil.right);
      EXPECT_EQ(used.stencil.down, fresh.stencil.down);
      EXPECT_EQ(used.stencil.down_right, fresh.stencil.down_right);
      EXPECT_EQ(used.stencil.down_left, fresh.stencil.down_left);
      EXPECT_EQ(used.curvature.empty(), each->curvature.empty());
    }
  }
}

TEST(DepthStep, GaussNewtonIsADenseLeastSquaresSolveOfEveryRow) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    RandomProblem random(seed);
    const DepthProblem problem = random.problem();
    const Eigen::VectorXd zeta = random.vector(problem.grid.size(), 0.02);
    const DepthSystem system = depth_system(problem, zeta, Linearization::gauss_newton);
    const Eigen::VectorXd expected = random.dense_step(zeta);
    const Eigen::MatrixXd A = test::dense_matrix(problem.grid, problem.prior.cells, system);
    EXPECT_TRUE(A.ldlt().solve(test::pixel_rhs(problem.grid, system)).isApprox(expected, 1e-4));
    Eigen::VectorXd step;
    ASSERT_TRUE(make_cholesky_depth_solver(problem.grid, problem.prior.cells)->solve(system, step));
    EXPECT_TRUE(step.isApprox(expected, 1e-4));
  }
}

TEST(DepthStep, BothLinearizationsRestWhereEveryEquationHolds) {
  RandomProblem random(2, Stencil::forward);
  const Eigen::VectorXd truth = random.vector(random.problem().grid.size(), 0.02);
  random.make_exact(truth);
  for (const Linearization linearization : {Linearization::gauss_newton, Linearization::fixed_point})
    EXPECT_LT(depth_system(random.problem(), truth, linearization).rhs.norm(), 1e-3);
}

TEST(DepthStep, BothLinearizationsComeToTheSameShapeAtZeroResidual) {
  RandomProblem random(3, Stencil::forward);
  const Eigen::VectorXd truth = random.vector(random.problem().grid.size(), 0.01);
  random.make_exact(truth);
  const DepthProblem problem = random.problem();
  const auto solver = make_cholesky_depth_solver(problem.grid, problem.prior.cells);
  for (const Linearization linearization : {Linearization::gauss_newton, Linearization::fixed_point}) {
    DepthOptions options;
    options.linearization = linearization;
    Eigen::VectorXd zeta = truth + random.vector(truth.size(), 0.01);
    for (int i = 0; i < 60; ++i) depth_step(problem, options, *solver, zeta);
    EXPECT_LT((zeta - truth).cwiseAbs().maxCoeff(), 2e-4) << to_string(linearization);
  }
}

TEST(DepthStep, TheEnergyNeverRisesWithBacktracking) {
  int backtracks = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    RandomProblem random(seed);
    const DepthProblem problem = random.problem();
    const auto solver = make_cholesky_depth_solver(problem.grid, problem.prior.cells);
    Eigen::VectorXd zeta = random.vector(problem.grid.size(), 0.2);
    for (int i = 0; i < 10; ++i) {
      const double before = depth_energy(problem, zeta);
      const DepthStepReport report = depth_step(problem, DepthOptions{}, *solver, zeta);
      ASSERT_TRUE(report.solved);
      EXPECT_LE(report.energy_after, report.energy_before);
      EXPECT_DOUBLE_EQ(report.energy_before, before);
      EXPECT_DOUBLE_EQ(report.energy_after, depth_energy(problem, zeta));
      backtracks += report.backtracks;
    }
  }
  EXPECT_GT(backtracks, 0);  // or the test has shown nothing
}

TEST(DepthStep, WithoutBacktrackingTheWholeStepIsTaken) {
  RandomProblem random(4);
  const DepthProblem problem = random.problem();
  DepthOptions options;
  options.max_backtracks = 0;
  const Eigen::VectorXd start = random.vector(problem.grid.size(), 0.2);
  Eigen::VectorXd zeta = start;
  const auto solver = make_cholesky_depth_solver(problem.grid, problem.prior.cells);
  EXPECT_EQ(depth_step(problem, options, *solver, zeta).backtracks, 0);
  EXPECT_TRUE((zeta - start).isApprox(random.dense_step(start), 1e-3));
}

/// A sphere under five lamps, its images spoilt so that residuals are not zero, some channels out of use.
struct SpoiltImages {
  SurfaceState state;
  Observations images;

  explicit SpoiltImages(bool attached_shadows) {
    const test::ExactSurface sphere = test::exact_sphere(16);
    state = test::exact_state(sphere, test::varied_albedo(sphere), test::far_lamps(), attached_shadows);
    images = test::images_of(state);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    test::change_samples(images, [&](PlainSamples& samples) {
      for (float& radiance : samples.radiance) radiance += 0.2f * uniform(random);
      for (unsigned char& usable : samples.usable) usable = uniform(random) < 0.8f;
    });
    for (float& weight : state.weight) weight = uniform(random) < 0.1f ? 0.0f : uniform(random);
  }

  /// sum over images and channels of w (rho (l.n + phi) - I)^2, dark lamps left out of l.n.
  double energy(int p, const Eigen::Vector3f& normal) const {
    double sum = 0;
    for (int i = 0; i < images.images; ++i) {
      for (int c = 0; c < 3; ++c) {
        if (!images.usable(i, c, p)) continue;
        const Lamp& lamp = state.lamps[static_cast<size_t>(i)];
        const bool dark = state.attached_shadows && lamp.l.row(c).dot(state.normals.col(p)) <= 0;
        const float lit = dark ? 0.0f : lamp.l.row(c).dot(normal);
        const float r = state.albedo(c, p) * (lit + lamp.phi[c]) - images.channel(i, c)[p];
        sum += static_cast<double>(state.weight[static_cast<size_t>(i * images.pixels + p)] * r * r);
      }
    }
    return sum;
  }
};

TEST(AccumulateTensors, TheirEnergyIsTheSumOverTheImages) {
  for (const bool attached_shadows : {false, true}) {
    const SpoiltImages spoilt(attached_shadows);
    const auto tensors = accumulate_tensors(spoilt.images, spoilt.state);
    for (int p = 0; p < spoilt.images.pixels; ++p) {
      for (const Eigen::Vector3f& n :
           {Eigen::Vector3f(spoilt.state.normals.col(p)), Eigen::Vector3f(0, 0.6f, -0.8f)})
        EXPECT_NEAR(static_cast<double>(tensors[static_cast<size_t>(p)].energy(n)), spoilt.energy(p, n),
                    1e-4);
    }
  }
}

TEST(CornerWeights, AreTheShareOfTheCornerWithoutEdgeWeighting) {
  RandomProblem random(5);
  const DepthProblem problem = random.problem();
  const auto weights = corner_weights(problem.grid, problem.corners, problem.tensors,
                                      Eigen::VectorXd::Zero(problem.grid.size()), 0);
  for (size_t p = 0; p < weights.size(); ++p)
    for (int k = 0; k < kCorners; ++k)
      EXPECT_EQ(weights[p][static_cast<size_t>(k)],
                problem.corners.has(static_cast<int>(p), k) ? problem.corners.weight[p] : 0.0f);
}

TEST(CornerWeights, FallByTheRootOfTwoAtTheEdgeWeightTimesTheMedianEnergy) {
  const PixelGrid grid = make_pixel_grid({5, 5, 20, 20, 2, 2, {}}, cv::Mat1b(5, 5, uchar{255}));
  const CornerList corners = make_corners(grid, Stencil::symmetric);
  PhotometricTensors tensors(25);
  std::fill_n(tensors.part(PhotometricTensors::e0), 25, 1.0f);
  tensors.part(PhotometricTensors::e0)[12] = 10;
  const auto weights = corner_weights(grid, corners, tensors, Eigen::VectorXd::Zero(25), 10);
  EXPECT_FLOAT_EQ(weights[12][0], 0.25f / std::sqrt(2.0f));
  EXPECT_FLOAT_EQ(weights[11][0], 0.25f / std::sqrt(1.1f));
}

}  // namespace
}  // namespace rakelight
