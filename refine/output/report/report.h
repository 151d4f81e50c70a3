// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// report.html: the result as one page that opens in any browser and needs nothing else (docs/report.md).
#pragma once

#include <string>

#include "refine/refine.h"

namespace rakelight {

/// A report is never larger than this: pictures get smaller until it fits.
inline constexpr std::size_t kMaxReportBytes = 5'000'000;

/// The page, UTF-8. It loads nothing, and texts from the stack are data in it, never markup.
/// @param stack what the result was made from, whose frames are shown; null: the page says that it has none
std::string report_html(const RefineResult& result, const LightStack* stack);

}  // namespace rakelight
