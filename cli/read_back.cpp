// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/read_back.h"

#include <system_error>

namespace rakelight::cli {

ReadBack read_back(const Lights& lights, const std::string& id) {
  ReadBack found;
  try {
    for (const std::string& lit : lights.lit()) {
      if (lit == id) {
        found.lit = true;
      } else {
        found.others += (found.others.empty() ? "" : ", ") + lit;
      }
    }
  } catch (const std::system_error&) { found.read = false; }
  return found;
}

std::string to_string(const ReadBack& found) {
  if (!found.read) return "not read back";
  return std::string(found.lit ? "lit" : "NOT LIT") +
         (found.others.empty() ? "" : ", but so is " + found.others);
}

}  // namespace rakelight::cli
