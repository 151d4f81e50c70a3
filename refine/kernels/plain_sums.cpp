// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/kernels/plain_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "refine/kernels/plain_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "refine/kernels/lamp_light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rakelight::kernels {
namespace HWY_NAMESPACE {

/// Vectors of pixels that one load of a lamp's terms serves.
constexpr int kTogether = HWY_TARGET <= HWY_AVX3 ? 4 : 2;

/// W, F and E of one channel at a vector of pixels.
struct ChannelSums {
  Vector3 W;
  V F, E;

  HWY_INLINE void add(const PlainTerms& terms, const std::uint16_t* codes) {
    const D d;
    const hn::Rebind<std::uint16_t, D> shorts;
    const V code = hn::ConvertTo(d, hn::PromoteTo(Ints(), hn::LoadU(shorts, codes)));
    W.x = hn::MulAdd(code, hn::Set(d, terms.step_l[0]), W.x);
    W.y = hn::MulAdd(code, hn::Set(d, terms.step_l[1]), W.y);
    W.z = hn::MulAdd(code, hn::Set(d, terms.step_l[2]), W.z);
    F = hn::MulAdd(code, hn::Set(d, terms.step_phi), F);
    const V I = hn::MulAdd(code, hn::Set(d, terms.step), hn::Set(d, terms.least));
    E = hn::MulAdd(I, I, E);
  }
};

/// sum S^2 = n'G n + 2 g'n + sum phi^2
HWY_INLINE V sum_of_squares(const float* constant, const Vector3& n) {
  const auto at = [&](PlainTerms::Constant which) { return hn::Set(D(), constant[which]); };
  const V two = hn::Set(D(), 2.0f);
  const V x = hn::MulAdd(n.y, at(PlainTerms::xy), hn::MulAdd(n.z, at(PlainTerms::xz), at(PlainTerms::gx)));
  const V y = hn::MulAdd(n.z, at(PlainTerms::yz), at(PlainTerms::gy));
  const V z = at(PlainTerms::gz);
  V sum = at(PlainTerms::phi2);
  sum = hn::MulAdd(n.x, hn::MulAdd(two, x, hn::Mul(n.x, at(PlainTerms::xx))), sum);
  sum = hn::MulAdd(n.y, hn::MulAdd(two, y, hn::Mul(n.y, at(PlainTerms::yy))), sum);
  return hn::MulAdd(n.z, hn::MulAdd(two, z, hn::Mul(n.z, at(PlainTerms::zz))), sum);
}

void plain_sums_of_channel(const TileSurface& surface, const PlainLamp* lamps, const ImageChoice& choice,
                           int c, Stretch stretch, PlainSums& sums, AlbedoSums& albedo) {
  const D d;
  const float* all = sums.constant[c];
  for (int begin = stretch.begin; begin < stretch.end; begin += kTogether * lanes()) {
    ChannelSums at[kTogether];
    for (int j = 0; j < kTogether; ++j) {
      const int k = begin + j * lanes();
      at[j].W = set3(all + PlainTerms::Wx);
      at[j].F = hn::Set(d, all[PlainTerms::F]);
      at[j].E = c == 0 ? hn::Zero(d) : hn::Load(d, sums.E.at + k);
    }
    for (int j = 0; j < choice.count; ++j) {
      const int i = choice.which[j];
      const std::uint16_t* codes = choice.images[i].codes[c] + begin;
      fetch_next<kTogether>(choice.images[i], codes);
      for (int k = 0; k < kTogether; ++k) at[k].add(lamps[i].channel[c], codes + k * lanes());
    }
    for (int j = 0; j < kTogether; ++j) {
      const int k = begin + j * lanes();
      const Vector3 n = load3(surface.normal, k);
      hn::Store(at[j].W.x, d, sums.W[c][0].at + k);
      hn::Store(at[j].W.y, d, sums.W[c][1].at + k);
      hn::Store(at[j].W.z, d, sums.W[c][2].at + k);
      hn::Store(at[j].F, d, sums.F[c].at + k);
      hn::Store(at[j].E, d, sums.E.at + k);
      hn::Store(hn::Add(dot(n, at[j].W), at[j].F), d, albedo.SI[c].at + k);
      hn::Store(sum_of_squares(all, n), d, albedo.SS[c].at + k);
    }
  }
}

void plain_sums(const TileSurface& surface, const PlainLamp* lamps, const ImageChoice& choice,
                Stretch stretch, PlainSums& sums, AlbedoSums& albedo) {
  const D d;
  for (int c = 0; c < 3; ++c) {
    float* all = sums.constant[c];
    for (int k = 0; k < PlainTerms::kConstants; k += lanes()) {
      V sum = hn::Zero(d);
      for (int j = 0; j < choice.count; ++j)
        sum = hn::Add(sum, hn::Load(d, lamps[choice.which[j]].channel[c].constant + k));
      hn::Store(sum, d, all + k);
    }
    plain_sums_of_channel(surface, lamps, choice, c, stretch, sums, albedo);
  }
}

void plain_tensors(const TileSurface& surface, const PlainSums& sums, Stretch stretch, TileTensors& tensors) {
  const D d;
  for (int k = stretch.begin; k < stretch.end; k += lanes()) {
    V G[6], h[3], e0 = hn::Load(d, sums.E.at + k);
    for (V& each : G) each = hn::Zero(d);
    for (V& each : h) each = hn::Zero(d);
    for (int c = 0; c < 3; ++c) {
      const float* all = sums.constant[c];
      const V rho = hn::Load(d, surface.albedo[c].at + k), rho2 = hn::Mul(rho, rho);
      for (int j = 0; j < 6; ++j) G[j] = hn::MulAdd(rho2, hn::Set(d, all[PlainTerms::xx + j]), G[j]);
      for (int j = 0; j < 3; ++j) {
        const V g = hn::Set(d, all[PlainTerms::gx + j]), W = hn::Load(d, sums.W[c][j].at + k);
        h[j] = hn::MulAdd(rho, hn::NegMulAdd(rho, g, W), h[j]);
      }
      const V F = hn::Load(d, sums.F[c].at + k), two = hn::Set(d, 2.0f);
      const V phi2 = hn::Set(d, all[PlainTerms::phi2]);
      e0 = hn::MulAdd(rho, hn::MulSub(rho, phi2, hn::Mul(two, F)), e0);
    }
    TileRow* rows[] = {&tensors.xx, &tensors.xy, &tensors.xz, &tensors.yy, &tensors.yz, &tensors.zz};
    for (int j = 0; j < 6; ++j) hn::Store(G[j], d, rows[j]->at + k);
    hn::Store(h[0], d, tensors.hx.at + k);
    hn::Store(h[1], d, tensors.hy.at + k);
    hn::Store(h[2], d, tensors.hz.at + k);
    hn::Store(e0, d, tensors.e0.at + k);
  }
}

void plain_coupling(const TileSurface& surface, const PlainSums& sums, Stretch stretch,
                    AlbedoCoupling& coupling) {
  const D d;
  for (int c = 0; c < 3; ++c) {
    const auto at = [&](PlainTerms::Constant which) { return hn::Set(d, sums.constant[c][which]); };
    const Vector3 x{at(PlainTerms::xx), at(PlainTerms::xy), at(PlainTerms::xz)},
        y{at(PlainTerms::xy), at(PlainTerms::yy), at(PlainTerms::yz)},
        z{at(PlainTerms::xz), at(PlainTerms::yz), at(PlainTerms::zz)};
    for (int k = stretch.begin; k < stretch.end; k += lanes()) {
      const Vector3 n = load3(surface.normal, k);
      hn::Store(hn::Add(dot(x, n), at(PlainTerms::gx)), d, coupling.Sl[c][0].at + k);
      hn::Store(hn::Add(dot(y, n), at(PlainTerms::gy)), d, coupling.Sl[c][1].at + k);
      hn::Store(hn::Add(dot(z, n), at(PlainTerms::gz)), d, coupling.Sl[c][2].at + k);
      hn::Store(sum_of_squares(sums.constant[c], n), d, coupling.SS[c].at + k);
    }
  }
}

void normal_bounds(const TileSurface& surface, NormalBounds (&bounds)[kTilePixels / kPiecePixels]) {
  const D d;
  int begin = 0;
  for (NormalBounds& piece : bounds) {
    for (int c = 0; c < 3; ++c) {
      V low = hn::Load(d, surface.normal[c].at + begin), high = low;
      for (int k = lanes(); k < kPiecePixels; k += lanes()) {
        const V n = hn::Load(d, surface.normal[c].at + begin + k);
        low = hn::Min(low, n);
        high = hn::Max(high, n);
      }
      piece.least[c] = hn::GetLane(hn::MinOfLanes(d, low));
      piece.most[c] = hn::GetLane(hn::MaxOfLanes(d, high));
    }
    begin += kPiecePixels;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(plain_sums);

void plain_sums(const TileSurface& surface, const PlainLamp* lamps, const ImageChoice& choice,
                Stretch stretch, PlainSums& sums, AlbedoSums& albedo) {
  HWY_DYNAMIC_DISPATCH(plain_sums)(surface, lamps, choice, stretch, sums, albedo);
}

HWY_EXPORT(plain_tensors);

void plain_tensors(const TileSurface& surface, const PlainSums& sums, Stretch stretch, TileTensors& tensors) {
  HWY_DYNAMIC_DISPATCH(plain_tensors)(surface, sums, stretch, tensors);
}

HWY_EXPORT(plain_coupling);

void plain_coupling(const TileSurface& surface, const PlainSums& sums, Stretch stretch,
                    AlbedoCoupling& coupling) {
  HWY_DYNAMIC_DISPATCH(plain_coupling)(surface, sums, stretch, coupling);
}

HWY_EXPORT(normal_bounds);

void normal_bounds(const TileSurface& surface, NormalBounds (&bounds)[kTilePixels / kPiecePixels]) {
  HWY_DYNAMIC_DISPATCH(normal_bounds)(surface, bounds);
}

}  // namespace rakelight::kernels
#endif
