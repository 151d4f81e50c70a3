// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/interface.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "viewer/gl/display_loss.h"
#include "viewer/window/font.h"

namespace rakelight {
namespace {

constexpr float kLetterHeight = 15;

/// Dear ImGui's units for a length of 1 at a scale of 1: where the system scales windows itself, the scale is in them.
float unit_of(GLFWwindow* window) {
  float scale = 1, unused = 1;
  glfwGetWindowContentScale(window, &scale, &unused);
  int pixels = 1, units = 1, ignored = 0;
  glfwGetFramebufferSize(window, &pixels, &ignored);
  glfwGetWindowSize(window, &units, &ignored);
  return units > 0 && pixels > 0 ? scale * static_cast<float>(units) / static_cast<float>(pixels) : scale;
}

}  // namespace

Interface::Interface(GLFWwindow* window) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::StyleColorsDark();
  const float unit = unit_of(window);
  ImGui::GetStyle().ScaleAllSizes(unit);
  ImGui::GetStyle().Colors[ImGuiCol_WindowBg].w = 0.85f;
  load_font(kLetterHeight * unit);
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Interface::~Interface() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Interface::begin_frame() const {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  require_display();  // without one, the window's size that was just asked for is no number
  ImGui::NewFrame();
}

void Interface::end_frame() const {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Interface::wants_mouse() const { return ImGui::GetIO().WantCaptureMouse; }

}  // namespace rakelight
