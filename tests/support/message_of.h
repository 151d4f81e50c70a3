// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
//     EXPECT_THAT(message_of<InputError>([&] { read_stack(folder); }), HasSubstr("mask.png"));
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace rakelight::test {

/// The message of the error that `action` throws; the test fails if it throws none or one of another type.
template <typename Error, typename Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) { return error.what(); } catch (const std::exception& error) {
    ADD_FAILURE() << "threw another type: " << error.what();
    return {};
  }
  ADD_FAILURE() << "threw nothing";
  return {};
}

}  // namespace rakelight::test
