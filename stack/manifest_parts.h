// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of a manifest that more than one file reads.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>

#include "stack/manifest.h"
#include "stack/strict_json.h"

namespace rakelight {

/// Largest number in a manifest's matrix or position: no rig is 10 km wide.
inline constexpr double kMaxMetres = 1e4;

/// Keeps what a nested reader did not know under the key it was found at.
inline void keep_unknown(nlohmann::json& unknown, const std::string& key, const ObjectReader& reader) {
  nlohmann::json rest = reader.unknown();
  if (!rest.empty()) unknown[key] = std::move(rest);
}

/// A square matrix as a list of rows; `otherwise` if it is missing.
template <int N>
Eigen::Matrix<double, N, N> read_matrix(ObjectReader& object, const std::string& key,
                                        const Eigen::Matrix<double, N, N>& otherwise) {
  const nlohmann::json* rows = object.find(key);
  if (rows == nullptr) return otherwise;
  const std::string cure = "write " + std::to_string(N) + " rows of " + std::to_string(N) + " finite numbers";
  if (!rows->is_array() || rows->size() != N) object.refuse(key, "is no matrix", cure);
  Eigen::Matrix<double, N, N> matrix;
  for (int r = 0; r < N; ++r) {
    const nlohmann::json& row = (*rows)[static_cast<std::size_t>(r)];
    if (!row.is_array() || row.size() != N) object.refuse(key, "is no matrix", cure);
    for (int c = 0; c < N; ++c) {
      const nlohmann::json& element = row[static_cast<std::size_t>(c)];
      if (!element.is_number() || !(std::abs(element.get<double>()) <= kMaxMetres)) {
        object.refuse(key, "is no matrix of usable numbers", cure);
      }
      matrix(r, c) = element.get<double>();
    }
  }
  return matrix;
}

/// The manifest's `lights`; what it does not know goes to unknown["lights"][id]. @throws InputError.
std::vector<Light> read_lights(ObjectReader& manifest, nlohmann::json& unknown);

/// The manifest's `frames`, whose lights are already in `manifest`; unknown keys go to unknown["frames"][index].
/// @throws InputError.
void read_frames(ObjectReader& reader, Manifest& manifest, nlohmann::json& unknown);

}  // namespace rakelight
