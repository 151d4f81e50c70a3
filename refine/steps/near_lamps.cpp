// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamps.h"

#include <Eigen/Dense>
#include <cmath>

#include "refine/pixel_blocks.h"

namespace rakelight {
namespace {

constexpr int kLamp = 9;     // unknowns of a lamp
constexpr int kAim = 3;      // of the common aim
constexpr int kShape = 7;    // of the broad shape
constexpr int kShared = kAim + kShape;
constexpr int kSample = 5 + kShared;  // unknowns that one sample depends on: 3 of position, its channel's e and phi

constexpr double kAmbientShare = 0.2;   // expected ambient light, share of a lamp's
constexpr double kAimDeviation = 0.1;   // expected distance of the aim from the middle of the seen surface, metres
constexpr double kCorrelation = 100;    // samples whose errors agree: so many count as one against what is expected

using SampleVector = Eigen::Matrix<double, kSample, 1>;
using ShapeVector = Eigen::Matrix<double, kShape, 1>;

/// Two unit vectors that span the plane across `direction`.
Eigen::Matrix<float, 3, 2> tangents_of(const Eigen::Vector3f& direction) {
  Eigen::Matrix<float, 3, 2> tangents;
  tangents.col(0) = direction.unitOrthogonal();
  tangents.col(1) = direction.cross(tangents.col(0));
  return tangents;
}

/// Lamps, aim and shape as the fit moves them.
struct Unknowns {
  std::vector<Lamp> lamps;
  LampScene scene;
  ShapeVector shape = ShapeVector::Zero();
};

/// One pixel of the fit.
struct FitPixel {
  int p = 0;
  Eigen::Vector3f point, normal;                     ///< at shape 0
  Eigen::Matrix<float, 1, kShape> B;                 ///< d zeta / d shape
  Eigen::Matrix<float, 3, kShape> normal_by_shape;   ///< d n / d shape
  double prior_weight = 0, miss = 0;                 ///< lambda_z of the pixel, zeta - z0 there
};

/// Values of the broad changes of zeta at a pixel.
Eigen::Matrix<float, 1, kShape> broad_changes(float x, float y, float zeta) {
  Eigen::Matrix<float, 1, kShape> B;
  B << 1, x, y, x * x, x * y, y * y, zeta;
  return B;
}

/// Depth relative to the centre's, which keeps the shape's unknowns well scaled.
float relative_zeta(const SurfaceState& state, int p) {
  return static_cast<float>(state.zeta[p] - std::log(static_cast<double>(state.scene.center.z())));
}

FitPixel fit_pixel(const BroadShape* shape, const SurfaceState& state, int p) {
  FitPixel pixel;
  pixel.p = p;
  pixel.point = state.points.col(p);
  pixel.normal = state.normals.col(p);
  pixel.B.setZero();
  pixel.normal_by_shape.setZero();
  if (!shape) return pixel;
  const float x = pixel.point.x() / pixel.point.z(), y = pixel.point.y() / pixel.point.z();
  pixel.B = broad_changes(x, y, relative_zeta(state, p));
  // raw normal (fx zeta_u, fy zeta_v, -1 - u~ zeta_u - v~ zeta_v) = (zeta_x, zeta_y, -1 - x zeta_x - y zeta_y) by x, y
  const float d = -1.0f / pixel.normal.dot(Eigen::Vector3f(x, y, 1));
  const Eigen::Vector3f raw = d * pixel.normal;
  Eigen::Matrix<float, 2, kShape> gradient;
  gradient << 0, 1, 0, 2 * x, y, 0, raw.x(),
              0, 0, 1, 0, x, 2 * y, raw.y();
  Eigen::Matrix<float, 3, 2> J;
  J << 1, 0, 0, 1, -x, -y;
  J /= d;
  pixel.normal_by_shape = (J - pixel.normal * (pixel.normal.transpose() * J)) * gradient;
  const int cell = shape->prior.cells.cell_of[static_cast<size_t>(p)];
  const auto size = static_cast<double>(shape->prior.cells.pixels_of[static_cast<size_t>(cell)].size());
  pixel.prior_weight = shape->prior.cell_weight[cell] / size;
  pixel.miss = state.zeta[p] - shape->prior.cell_target[cell];
  return pixel;
}

std::vector<FitPixel> fit_pixels(const Observations& images, const BroadShape* shape, const SurfaceState& state,
                                 int wanted) {
  std::vector<FitPixel> pixels;
  const int stride = std::max(1, images.pixels / wanted);
  for (int p = 0; p < images.pixels; p += stride) pixels.push_back(fit_pixel(shape, state, p));
  return pixels;
}

/// Normal equations of the fit: lamps in turn, then aim, then shape.
struct Equations {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  double energy = 0, samples = 0;
};

/// Global numbers of a sample's unknowns.
std::array<int, kSample> unknowns_of(int image, int images, int c) {
  std::array<int, kSample> at{kLamp * image, kLamp * image + 1, kLamp * image + 2, kLamp * image + 3 + c,
                              kLamp * image + 6 + c};
  for (int k = 0; k < kShared; ++k) at[static_cast<size_t>(5 + k)] = kLamp * images + k;
  return at;
}

/// Sums of one channel of a run of pixels.
struct ChannelSums {
  std::vector<Eigen::Matrix<double, kSample, kSample>> A;  ///< [image] of w J J'
  std::vector<SampleVector> b;                             ///< [image] of w J r
  Eigen::MatrixXd Q;                                       ///< what the albedo takes away: sum of q q'
};

class Fit {
 public:
  Fit(const Observations& images, const BroadShape* shape, const SurfaceState& state, int pixels)
      : images_(images), state_(state), pixels_(fit_pixels(images, shape, state, pixels)),
        aim_(state.points.rowwise().mean()) {}

  double energy(const Unknowns& at) const {
    return sum_over_blocks(static_cast<int>(pixels_.size()), 0.0, [&](int begin, int end) {
      double sum = 0;
      for (int k = begin; k < end; ++k) sum += pixel_energy(at, pixels_[static_cast<size_t>(k)]);
      return sum;
    });
  }

  Equations equations(const Unknowns& at) const;

  /// What is known of a rig beforehand, against errors of variance `variance`: little ambient light, and axes that meet
  /// in the object. It decides only where the images do not.
  double prior_energy(const Unknowns& at, double variance) const;
  void add_prior(const Unknowns& at, double variance, Equations& equations) const;

 private:
  struct Place {
    Eigen::Vector3f offset, normal;
  };
  static Place place(const Unknowns& at, const FitPixel& pixel) {
    const Eigen::Matrix<float, kShape, 1> c = at.shape.cast<float>();
    const float grown = std::exp(pixel.B.dot(c));
    return {pixel.point * grown - at.scene.center, (pixel.normal + pixel.normal_by_shape * c).normalized()};
  }
  static double prior_miss(const Unknowns& at, const FitPixel& pixel) {
    return pixel.miss + pixel.B.cast<double>().dot(at.shape);
  }
  float weight(int image, int p) const {
    return state_.weight[static_cast<size_t>(image) * static_cast<size_t>(images_.pixels) + static_cast<size_t>(p)];
  }
  double pixel_energy(const Unknowns& at, const FitPixel& pixel) const;
  void add_pixel(const Unknowns& at, const FitPixel& pixel, std::array<ChannelSums, 3>& sums,
                 Equations& total) const;

  const Observations& images_;
  const SurfaceState& state_;
  std::vector<FitPixel> pixels_;
  Eigen::Vector3f aim_;  ///< where the axes are expected to meet
};

double Fit::pixel_energy(const Unknowns& at, const FitPixel& pixel) const {
  const Place here = place(at, pixel);
  Eigen::Array3d SS = Eigen::Array3d::Zero(), SI = SS, II = SS;
  for (int i = 0; i < images_.images; ++i) {
    const auto w = static_cast<double>(weight(i, pixel.p));
    if (w == 0) continue;
    const Lamp& lamp = at.lamps[static_cast<size_t>(i)];
    const float value =
        lamp.near ? incidence_of(lamp, {}, here.offset, here.normal, at.scene.lobe_exponent, false).value : 0;
    const Eigen::Vector3f far_value = lamp.near ? Eigen::Vector3f() : Eigen::Vector3f(lamp.l * here.normal).cwiseMax(0.0f);
    for (int c = 0; c < 3; ++c) {
      if (!images_.usable_in(i, c)[pixel.p]) continue;
      const auto S = static_cast<double>((lamp.near ? lamp.strength[c] * value : far_value[c]) + lamp.phi[c]);
      const auto I = static_cast<double>(images_.channel(i, c)[pixel.p]);
      SS[c] += w * S * S;
      SI[c] += w * S * I;
      II[c] += w * I * I;
    }
  }
  const double miss = prior_miss(at, pixel);
  double sum = pixel.prior_weight * miss * miss;
  for (int c = 0; c < 3; ++c) sum += SS[c] > 1e-12 ? II[c] - std::max(0.0, SI[c]) * SI[c] / SS[c] : II[c];
  return sum;
}

void Fit::add_pixel(const Unknowns& at, const FitPixel& pixel, std::array<ChannelSums, 3>& sums,
                    Equations& total) const {
  const Place here = place(at, pixel);
  const int images = images_.images;
  const Eigen::Vector3f point = here.offset + at.scene.center;
  std::vector<SampleVector> z(static_cast<size_t>(images), SampleVector::Zero());
  std::vector<Eigen::Vector3d> S(static_cast<size_t>(images), Eigen::Vector3d::Zero());
  for (int i = 0; i < images; ++i) {
    const Lamp& lamp = at.lamps[static_cast<size_t>(i)];
    SampleVector& zi = z[static_cast<size_t>(i)];
    zi[4] = 1;
    if (!lamp.near) {
      S[static_cast<size_t>(i)] = ((lamp.l * here.normal).cwiseMax(0.0f) + lamp.phi).cast<double>();
      continue;
    }
    const Incidence v =
        incidence_of(lamp, tangents_of(lamp.direction), here.offset, here.normal, at.scene.lobe_exponent, true);
    zi.head<3>() = v.lamp.cast<double>();
    zi[3] = static_cast<double>(v.value);
    zi.segment<kAim>(5) = v.aim.cast<double>();
    zi.tail<kShape>() = (v.point.dot(point) * pixel.B + v.normal.transpose() * pixel.normal_by_shape)
                            .transpose()
                            .cast<double>();
    S[static_cast<size_t>(i)] = (lamp.strength * v.value + lamp.phi).cast<double>();
  }
  for (int c = 0; c < 3; ++c) {
    double SS = 0, SI = 0;
    const auto w_of = [&](int i) {
      return images_.usable_in(i, c)[pixel.p] ? static_cast<double>(weight(i, pixel.p)) : 0.0;
    };
    for (int i = 0; i < images; ++i) {
      const double w = w_of(i), Si = S[static_cast<size_t>(i)][c];
      SS += w * Si * Si;
      SI += w * Si * static_cast<double>(images_.channel(i, c)[pixel.p]);
    }
    if (SS <= 1e-12 || SI <= 0) continue;
    const double rho = SI / SS;
    ChannelSums& sum = sums[static_cast<size_t>(c)];
    Eigen::VectorXd q = Eigen::VectorXd::Zero(sum.Q.rows());
    for (int i = 0; i < images; ++i) {
      const double w = w_of(i), Si = S[static_cast<size_t>(i)][c];
      if (w == 0) continue;
      const Lamp& lamp = at.lamps[static_cast<size_t>(i)];
      const double e = static_cast<double>(lamp.strength[c]), r = static_cast<double>(images_.channel(i, c)[pixel.p]) - rho * Si;
      SampleVector J = rho * z[static_cast<size_t>(i)];
      J.head<3>() *= e;
      J.tail<kShared>() *= e;
      sum.A[static_cast<size_t>(i)].noalias() += w * J * J.transpose();
      sum.b[static_cast<size_t>(i)] += w * r * J;
      q.segment<5>(5 * i) += w * Si * J.head<5>();
      q.tail<kShared>() += w * Si * J.tail<kShared>();
      total.energy += w * r * r;
      total.samples += w;
    }
    sum.Q.selfadjointView<Eigen::Lower>().rankUpdate(q, 1 / SS);
    total.samples -= 1;
  }
  const double miss = prior_miss(at, pixel);
  total.energy += pixel.prior_weight * miss * miss;
  const ShapeVector B = pixel.B.transpose().cast<double>();
  total.A.bottomRightCorner<kShape, kShape>() += pixel.prior_weight * B * B.transpose();
  total.b.tail<kShape>() -= pixel.prior_weight * miss * B;
}

Equations Fit::equations(const Unknowns& at) const {
  const int images = images_.images, size = kLamp * images + kShared;
  constexpr int kRun = 256;  // pixels a partial sum: enough to share among threads, few enough to hold
  const int runs = (static_cast<int>(pixels_.size()) + kRun - 1) / kRun;
  const int parts = std::min(8, runs);
  std::vector<Equations> all(static_cast<size_t>(parts));
  cv::parallel_for_(cv::Range(0, parts), [&](const cv::Range& range) {
    for (int part = range.start; part < range.end; ++part) {
      Equations& total = all[static_cast<size_t>(part)];
      total.A = Eigen::MatrixXd::Zero(size, size);
      total.b = Eigen::VectorXd::Zero(size);
      std::array<ChannelSums, 3> sums;
      for (ChannelSums& sum : sums) {
        sum.A.assign(static_cast<size_t>(images), Eigen::Matrix<double, kSample, kSample>::Zero());
        sum.b.assign(static_cast<size_t>(images), SampleVector::Zero());
        sum.Q = Eigen::MatrixXd::Zero(5 * images + kShared, 5 * images + kShared);
      }
      for (size_t k = static_cast<size_t>(part); k < pixels_.size(); k += static_cast<size_t>(parts))
        add_pixel(at, pixels_[k], sums, total);
      for (int c = 0; c < 3; ++c) {
        const ChannelSums& sum = sums[static_cast<size_t>(c)];
        std::vector<int> dense(static_cast<size_t>(5 * images + kShared));
        for (int i = 0; i < images; ++i) {
          const auto at_ = unknowns_of(i, images, c);
          for (int a = 0; a < 5; ++a) dense[static_cast<size_t>(5 * i + a)] = at_[static_cast<size_t>(a)];
          for (int a = 0; a < kSample; ++a) {
            total.b[at_[static_cast<size_t>(a)]] += sum.b[static_cast<size_t>(i)][a];
            for (int b = 0; b < kSample; ++b)
              total.A(at_[static_cast<size_t>(a)], at_[static_cast<size_t>(b)]) += sum.A[static_cast<size_t>(i)](a, b);
          }
        }
        for (int k = 0; k < kShared; ++k) dense[static_cast<size_t>(5 * images + k)] = kLamp * images + k;
        for (int a = 0; a < sum.Q.rows(); ++a)
          for (int b = 0; b < sum.Q.rows(); ++b)
            total.A(dense[static_cast<size_t>(a)], dense[static_cast<size_t>(b)]) -= sum.Q(std::max(a, b), std::min(a, b));
      }
    }
  });
  Equations sum = all[0];
  for (size_t k = 1; k < all.size(); ++k) {
    sum.A += all[k].A;
    sum.b += all[k].b;
    sum.energy += all[k].energy;
    sum.samples += all[k].samples;
  }
  return sum;
}

double Fit::prior_energy(const Unknowns& at, double variance) const {
  double sum = static_cast<double>((at.scene.center - aim_).squaredNorm()) / (kAimDeviation * kAimDeviation);
  for (const Lamp& lamp : at.lamps) {
    if (!lamp.near) continue;
    const double ambient = kAmbientShare * static_cast<double>(lamp.strength.maxCoeff());
    sum += static_cast<double>(lamp.phi.squaredNorm()) / (ambient * ambient + 1e-12);
  }
  return kCorrelation * variance * sum;
}

void Fit::add_prior(const Unknowns& at, double variance, Equations& equations) const {
  const auto add = [&](Eigen::Index k, double value, double deviation) {
    const double weight = kCorrelation * variance / (deviation * deviation + 1e-12);
    equations.A(k, k) += weight;
    equations.b[k] -= weight * value;
  };
  const auto images = static_cast<Eigen::Index>(at.lamps.size());
  for (Eigen::Index i = 0; i < images; ++i) {
    const Lamp& lamp = at.lamps[static_cast<size_t>(i)];
    const double ambient = kAmbientShare * static_cast<double>(lamp.strength.maxCoeff());
    for (int c = 0; c < 3; ++c) add(kLamp * i + 6 + c, static_cast<double>(lamp.phi[c]), ambient);
  }
  for (int k = 0; k < kAim; ++k)
    add(kLamp * images + k, static_cast<double>(at.scene.center[k] - aim_[k]), kAimDeviation);
}

/// Takes an unknown out of the step.
void lock(Equations& equations, Eigen::Index k) {
  equations.A.row(k).setZero();
  equations.A.col(k).setZero();
  equations.A(k, k) = 1;
  equations.b[k] = 0;
}

void lock_unknowns(const Unknowns& at, bool fixed_positions, bool hold_shape, Equations& equations) {
  const auto images = static_cast<Eigen::Index>(at.lamps.size());
  for (Eigen::Index i = 0; i < images; ++i) {
    const Lamp& lamp = at.lamps[static_cast<size_t>(i)];
    const bool at_infinity = lamp.inverse_distance <= 0 && equations.b[kLamp * i + 2] < 0;
    for (Eigen::Index k = 0; k < kLamp; ++k) {
      const bool position = fixed_positions && k < 3;
      if (!lamp.near || position || (k == 2 && at_infinity)) lock(equations, kLamp * i + k);
    }
  }
  for (Eigen::Index k = 0; k < kShared; ++k)
    if (k < kAim ? fixed_positions : hold_shape) lock(equations, kLamp * images + k);
}

Unknowns moved(const Unknowns& at, const Eigen::VectorXd& step, float max_inverse_distance) {
  Unknowns result = at;
  const auto images = static_cast<Eigen::Index>(at.lamps.size());
  const Eigen::Vector3f aim = step.segment<kAim>(kLamp * images).cast<float>();
  for (Eigen::Index i = 0; i < images; ++i) {
    Lamp& lamp = result.lamps[static_cast<size_t>(i)];
    if (!lamp.near) continue;
    const Eigen::Matrix<float, kLamp, 1> s = step.segment<kLamp>(kLamp * i).cast<float>();
    const Eigen::Vector3f d = (lamp.direction + tangents_of(lamp.direction) * s.head<2>()).normalized();
    const float kappa = std::clamp(lamp.inverse_distance + s[2], 0.0f, max_inverse_distance);
    // Seen from the new aim: X - aim = d / kappa - (change of aim), times kappa
    const Eigen::Vector3f seen = d - kappa * aim;
    lamp.direction = seen.normalized();
    lamp.inverse_distance = std::min(kappa / seen.norm(), max_inverse_distance);
    lamp.strength += s.segment<3>(3);
    lamp.phi += s.tail<3>();
  }
  result.scene.center += aim;
  result.shape += step.tail<kShape>();
  return result;
}

/// Calls body(direction, inverse distance) for lamps all over the camera's half of the space about the object, and far
/// ones in the direction at hand.
template <class Body>
void for_each_position(const Eigen::Vector3f& at_hand, const Body& body) {
  constexpr int kDirections = 150;  // about 12 degrees apart
  const double turn = M_PI * (3 - std::sqrt(5.0));
  for (int k = -1; k < kDirections; ++k) {
    const double z = -(k + 0.5) / kDirections, r = std::sqrt(1 - z * z);
    const Eigen::Vector3d direction(r * std::cos(turn * k), r * std::sin(turn * k), z);
    for (const float inverse_distance : {0.0f, 0.5f, 1.0f, 1.4f, 1.8f, 2.3f, 2.8f})
      body(k < 0 ? at_hand : Eigen::Vector3f(direction.cast<float>()), inverse_distance);
  }
}

/// Fits strength and ambient light of a lamp at its place. @return sum |I - rho S| over some pixels
double fit_strength(const Observations& images, const SurfaceState& state, int image, Lamp& lamp) {
  const int stride = std::max(1, images.pixels / 1000);
  std::vector<float> value;
  for (int p = 0; p < images.pixels; p += stride)
    value.push_back(incidence_of(lamp, {}, state.points.col(p) - state.scene.center, state.normals.col(p),
                                 state.scene.lobe_exponent, false)
                        .value);
  double misfit = 0;
  for (int c = 0; c < 3; ++c) {
    const float* I = images.channel(image, c);
    const unsigned char* usable = images.usable_in(image, c);
    Eigen::Matrix2d A = 1e-9 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    const auto row = [&](size_t k, int p) -> Eigen::Vector2d {
      return static_cast<double>(state.albedo(c, p)) * Eigen::Vector2d(static_cast<double>(value[k]), 1);
    };
    for (size_t k = 0; k < value.size(); ++k) {
      const int p = stride * static_cast<int>(k);
      if (!usable[p]) continue;
      const Eigen::Vector2d h = row(k, p);
      A += h * h.transpose();
      b += static_cast<double>(I[p]) * h;
    }
    Eigen::Vector2d s = A.ldlt().solve(b);
    if (s[0] < 0 || s[1] < 0) s = s[0] < 0 ? Eigen::Vector2d(0, b[1] / A(1, 1)) : Eigen::Vector2d(b[0] / A(0, 0), 0);
    for (size_t k = 0; k < value.size(); ++k) {
      const int p = stride * static_cast<int>(k);
      if (usable[p]) misfit += std::abs(s.dot(row(k, p)) - static_cast<double>(I[p]));
    }
    lamp.strength[c] = static_cast<float>(s[0]);
    lamp.phi[c] = static_cast<float>(s[1]);
  }
  return misfit;
}

}  // namespace

Incidence incidence_of(const Lamp& lamp, const Eigen::Matrix<float, 3, 2>& tangents, const Eigen::Vector3f& offset,
                       const Eigen::Vector3f& normal, float m, bool derivatives) {
  const float kappa = lamp.inverse_distance;
  const Eigen::Vector3f &d = lamp.direction, u = d - kappa * offset;
  const float u2 = u.squaredNorm(), du = d.dot(u), un = u.dot(normal);
  if (un <= 0.0f || du <= 0.0f) return {};
  // v.n = (u.n) k with k = (d.u)^m |u|^-(3+m); change of u and d gives d(v.n) = k (du.n) + (u.n) dk.
  const float k = m == 1.0f ? du / (u2 * u2) : std::pow(du / std::sqrt(u2), m) / (u2 * std::sqrt(u2));
  Incidence result;
  result.value = un * k;
  if (!derivatives) return result;
  const Eigen::Vector3f by_u = k * normal + result.value * (m / du * d - (3 + m) / u2 * u);
  const Eigen::Vector3f by_d = by_u + result.value * m / du * u;
  result.lamp << tangents.transpose() * by_d, -offset.dot(by_u);
  result.aim = result.value * kappa * ((m - 2) * d - m / du * u);
  result.point = -kappa * by_u;
  result.normal = k * u;
  return result;
}

Lamp near_from_far(const Lamp& far, float inverse_distance) {
  Lamp lamp = far;
  lamp.near = true;
  const Eigen::Vector3f sum = far.l.colwise().sum().transpose();
  if (sum.norm() > 0) lamp.direction = sum.normalized();
  lamp.strength = far.l.rowwise().norm();
  lamp.inverse_distance = inverse_distance;
  return lamp;
}

std::vector<Lamp> search_near_lamps(const Observations& images, const SurfaceState& state) {
  std::vector<Lamp> lamps = state.lamps;
  cv::parallel_for_(cv::Range(0, images.images), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      Lamp& lamp = lamps[static_cast<size_t>(i)];
      if (!lamp.near) continue;
      double least = std::numeric_limits<double>::infinity();
      for_each_position(Eigen::Vector3f(lamp.direction), [&](const Eigen::Vector3f& direction, float inverse_distance) {
        Lamp candidate = lamp;
        candidate.direction = direction;
        candidate.inverse_distance = inverse_distance;
        const double misfit = fit_strength(images, state, i, candidate);
        if (misfit >= least) return;
        least = misfit;
        lamp = candidate;
      });
    }
  });
  return lamps;
}

Eigen::VectorXd fit_near_lamps(const Observations& images, const BroadShape* shape, const NearLampOptions& options,
                               SurfaceState& state) {
  const Fit fit(images, shape, state, options.pixels);
  Unknowns at{state.lamps, state.scene};
  double damping = 1e-4, variance = -1;
  for (int step = 0; step < options.steps; ++step) {
    Equations equations = fit.equations(at);
    if (variance < 0) variance = equations.energy / std::max(1.0, equations.samples);
    fit.add_prior(at, variance, equations);
    lock_unknowns(at, options.fixed_positions, shape == nullptr, equations);
    const double before = fit.energy(at) + fit.prior_energy(at, variance);
    for (int attempt = 0; attempt < 6; ++attempt, damping *= 10) {
      Eigen::MatrixXd damped = equations.A;
      damped.diagonal() *= 1 + damping;
      damped.diagonal().array() += 1e-12 * equations.A.trace() / static_cast<double>(equations.A.rows());
      const Eigen::VectorXd delta = damped.ldlt().solve(equations.b);
      if (!delta.allFinite()) continue;
      const Unknowns candidate = moved(at, delta, options.max_inverse_distance);
      const double after = fit.energy(candidate) + fit.prior_energy(candidate, variance);
      if (!(after <= before)) continue;
      at = candidate;
      damping = std::max(damping * 0.1, 1e-8);
      break;
    }
  }
  Eigen::VectorXd change = Eigen::VectorXd::Zero(images.pixels);
  if (shape) {
    for (int p = 0; p < images.pixels; ++p) {
      const float x = state.points(0, p) / state.points(2, p), y = state.points(1, p) / state.points(2, p);
      change[p] = broad_changes(x, y, relative_zeta(state, p)).cast<double>().dot(at.shape);
    }
  }
  state.lamps = at.lamps;
  state.scene = at.scene;
  return change;
}

std::vector<LampUncertainty> near_lamp_uncertainty(const Observations& images, const BroadShape* shape,
                                                   const NearLampOptions& options, const SurfaceState& state) {
  std::vector<LampUncertainty> result(state.lamps.size());
  const Unknowns at{state.lamps, state.scene};
  const Fit fit(images, shape, state, options.pixels);
  Equations equations = fit.equations(at);
  const double variance = equations.energy / std::max(1.0, equations.samples);
  fit.add_prior(at, variance, equations);
  lock_unknowns(at, options.fixed_positions, shape == nullptr, equations);
  equations.A.diagonal().array() += 1e-12 * equations.A.trace();
  const Eigen::MatrixXd inverse = equations.A.ldlt().solve(Eigen::MatrixXd::Identity(equations.A.rows(), equations.A.rows()));
  for (size_t i = 0; i < state.lamps.size(); ++i) {
    const Lamp& lamp = state.lamps[i];
    const auto k = kLamp * static_cast<Eigen::Index>(i);
    const Eigen::Matrix3d position = variance * inverse.block<3, 3>(k, k);
    const double kappa = std::max(1e-3, static_cast<double>(lamp.inverse_distance));
    Eigen::Matrix3d J;  // d X / d (tangents, kappa), X = centre + d / kappa
    J.leftCols<2>() = tangents_of(lamp.direction).cast<double>() / kappa;
    J.col(2) = -lamp.direction.cast<double>() / (kappa * kappa);
    LampUncertainty& u = result[i];
    u.position_covariance = J * position * J.transpose();
    u.distance_deviation = std::sqrt(std::max(0.0, position(2, 2))) / (kappa * kappa);
    u.direction_deviation = std::sqrt(std::max(0.0, position(0, 0) + position(1, 1)));
  }
  return result;
}

Eigen::Vector3d lamp_position(const Lamp& lamp, const LampScene& scene) {
  const double kappa = std::max(1e-3, static_cast<double>(lamp.inverse_distance));
  return scene.center.cast<double>() + lamp.direction.cast<double>() / kappa;
}

}  // namespace rakelight
