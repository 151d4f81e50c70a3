// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The files of the page in this folder (HTML, CSS, JavaScript), which the build puts into the library.
#pragma once

#include <string_view>

namespace rakelight {

/// The text of such a file, e.g. "page.html". @throws std::logic_error if there is none of that name.
std::string_view embedded_file(std::string_view name);

}  // namespace rakelight
