// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the surface is drawn: a vertex a height, shaded by the finer normals. View frame: x right, y up, z to the viewer.

const kVertexShader = `#version 300 es
in float depth;                                    // metres, camera frame
uniform int columns;
uniform vec4 box;                                  // x, y, width, height in pixels
uniform float stride;
uniform vec4 camera;                               // fx, fy, cx, cy
uniform vec3 centre;                               // of the turning, camera frame
uniform mat3 turn;
uniform float eye, aspect;                         // distance of the viewer, metres; width / height
out vec2 place;                                    // 0 to 1 in the box
void main() {
  vec2 sampled = vec2(gl_VertexID % columns, gl_VertexID / columns) * stride;
  place = (sampled + 0.5) / box.zw;
  vec3 p = vec3((sampled + box.xy - camera.zw) / camera.xy * depth, depth) - centre;
  vec3 q = turn * vec3(p.x, -p.y, -p.z) - vec3(0, 0, eye);
  const float f = 3.7;                             // cotangent of half the field of view, 15 degrees
  float near = 0.02 * eye, far = 20.0 * eye;
  gl_Position = vec4(q.xy * f / vec2(max(aspect, 1.0), max(aspect, 1.0) / aspect),
                     (q.z * (far + near) + 2.0 * far * near) / (near - far), -q.z);
}`;

const kFragmentShader = `#version 300 es
precision highp float;
in vec2 place;
uniform sampler2D normals, albedo, delta;
uniform int row, material;                         // row of the normals: 0 refined, 1 sensor
uniform mat3 turn;
uniform vec3 light;                                // towards the lamp, view frame
out vec4 color;
vec3 normal() {
  vec2 texel = 0.5 / vec2(textureSize(normals, 0));
  vec2 at = clamp(place * 0.5, texel, 0.5 - texel) + vec2(0, 0.5 * float(row));
  vec2 xy = vec2(texture(normals, at).r, texture(normals, at + vec2(0.5, 0)).r) * 2.0 - 1.0;
  return vec3(xy.x, -xy.y, sqrt(max(0.0025, 1.0 - dot(xy, xy))));
}
void main() {
  vec3 own = normalize(normal());
  vec3 n = turn * own;
  float lit = max(0.0, dot(n, light)), head = max(0.0, n.z);
  float shade = 0.85 * lit + 0.12 * head + 0.01;
  float gloss = pow(max(0.0, dot(n, normalize(light + vec3(0, 0, 1)))), 60.0);
  vec3 linear = vec3(0.8 * shade);
  if (material == 1) linear = pow(texture(albedo, place).rgb, vec3(2.2)) * shade;
  if (material == 2) linear = vec3(0.42, 0.2, 0.12) * shade + 0.55 * gloss * step(0.0, dot(n, light));
  if (material == 4) linear = pow(texture(delta, place).rgb, vec3(2.2)) * (0.35 + 0.65 * shade);
  vec3 shown = material == 3 ? own * 0.5 + 0.5 : pow(linear, vec3(1.0 / 2.2));
  color = vec4(gl_FrontFacing ? shown : 0.35 * shown, 1);
}`;

/** @throws Error with the compiler's words */
function linkedProgram(gl) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, kVertexShader], [gl.FRAGMENT_SHADER, kFragmentShader]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}
