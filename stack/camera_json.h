// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A camera as JSON: in stack.json and in result.json.
#pragma once

#include <nlohmann/json.hpp>

#include "stack/stack.h"
#include "stack/strict_json.h"

namespace rakelight {

/// @throws InputError naming the member, the fault and the cure.
Camera read_camera(ObjectReader& camera);

nlohmann::ordered_json camera_json(const Camera& camera);

}  // namespace rakelight
