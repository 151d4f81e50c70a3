// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/solver/placement.h"

namespace rakelight {

Placement::Placement(const PixelGrid& grid) : grid_(grid), layout_(grid.box.size()) {}

}  // namespace rakelight
