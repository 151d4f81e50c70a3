# SPDX-FileCopyrightText: 2026 The Rakelight authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Program, libraries, headers and a package that find_package(rakelight) understands.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
