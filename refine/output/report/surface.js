// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface that can be turned and relit.

const kFrontView = {yaw: 0, pitch: 0, zoom: 1};
const radians = (degrees) => degrees * Math.PI / 180;

/** Draws on a canvas what `view` says. */
class SurfaceView {
  constructor(gl, images) {
    this.gl = gl;
    this.program = linkedProgram(gl);
    this.patches = {refined: this.patch('refined'), sensor: this.patch('sensor')};
    Object.values(images).forEach((image, unit) => this.texture(image, unit));
    gl.useProgram(this.program);
    Object.keys(images).forEach((name, unit) => gl.uniform1i(this.at(name), unit));
    this.setScene();
  }

  at(name) { return this.gl.getUniformLocation(this.program, name); }

  /** Vertices and triangles of one of the two surfaces. */
  patch(name) {
    const {gl} = this;
    const depth = decodedDepth(data.surface[name], data.surface);
    const indices = trianglesOf(depth, data.surface, Math.min(result.camera.fx, result.camera.fy));
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, depth, gl.STATIC_DRAW);
    const location = gl.getAttribLocation(this.program, 'depth');
    gl.enableVertexAttribArray(location);
    gl.vertexAttribPointer(location, 1, gl.FLOAT, false, 0, 0);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    return {array, count: indices.length};
  }

  texture(image, unit) {
    const {gl} = this;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, image);
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
  }

  /** What does not change: the camera, and the distance at which the object fills the view. */
  setScene() {
    const {gl} = this;
    const {fx, fy, cx, cy} = result.camera;
    const {x, y, width, height, columns, stride} = data.surface;
    const z = data.centre_m[2];
    gl.uniform1i(this.at('columns'), columns);
    gl.uniform1f(this.at('stride'), stride);
    gl.uniform4f(this.at('box'), x, y, width, height);
    gl.uniform4f(this.at('camera'), fx, fy, cx, cy);
    gl.uniform3f(this.at('centre'), (x + width / 2 - cx) / fx * z, (y + height / 2 - cy) / fy * z, z);
    this.eye = 3.9 * Math.max(width / fx, height / fy) * z / 2;
    this.extent = [width / fx, height / fy];
  }

  draw(view) {
    const {gl} = this;
    const {canvas} = gl;
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * devicePixelRatio));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * devicePixelRatio));
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0.05, 0.055, 0.063, 1);
    gl.enable(gl.DEPTH_TEST);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const aspect = canvas.width / canvas.height;
    gl.uniform1f(this.at('aspect'), aspect);
    gl.uniform1f(this.at('eye'), this.eye * this.fitted(aspect) / view.zoom);
    gl.uniform1i(this.at('row'), view.surface === 'refined' ? 0 : 1);
    gl.uniform1i(this.at('material'), view.material);
    const [cosYaw, sinYaw] = [Math.cos(view.yaw), Math.sin(view.yaw)];
    const [cosPitch, sinPitch] = [Math.cos(view.pitch), Math.sin(view.pitch)];
    gl.uniformMatrix3fv(this.at('turn'), false, [  // columns of Rx(pitch) Ry(yaw)
      cosYaw, sinPitch * sinYaw, -cosPitch * sinYaw, 0, cosPitch, sinPitch, sinYaw, -sinPitch * cosYaw, cosPitch * cosYaw]);
    const [azimuth, elevation] = [radians(view.azimuth), radians(view.elevation)];
    gl.uniform3f(this.at('light'), Math.cos(elevation) * Math.cos(azimuth), Math.cos(elevation) * Math.sin(azimuth),
      Math.sin(elevation));
    const patch = this.patches[view.surface];
    gl.bindVertexArray(patch.array);
    gl.drawElements(gl.TRIANGLES, patch.count, gl.UNSIGNED_INT, 0);
  }

  /** How much of `eye` suffices for the object to fit a canvas of this shape, whose shorter side is the field of view. */
  fitted(aspect) {
    const [width, height] = this.extent;
    const span = Math.max(width, height);
    return (aspect >= 1 ? Math.max(width / aspect, height) : Math.max(width, height * aspect)) / span;
  }
}

/** Mouse, touch, keys and the controls above the canvas change `view`, and `changed` is called. */
function connectControls(canvas, view, changed) {
  const lamps = {azimuth: byId('azimuth'), elevation: byId('elevation')};
  const moveLight = (azimuth, elevation) => {
    lamps.azimuth.value = view.azimuth = (Math.round(azimuth) + 540) % 360 - 180;
    lamps.elevation.value = view.elevation = Math.min(90, Math.max(5, elevation));
    changed();
  };
  const turn = (yaw, pitch) => {
    view.yaw += yaw;
    view.pitch = Math.min(1.5, Math.max(-1.5, view.pitch + pitch));
    changed();
  };
  const zoom = (factor) => { view.zoom = Math.min(20, Math.max(0.2, view.zoom * factor)); changed(); };
  const front = () => { Object.assign(view, kFrontView); changed(); };
  /** The lamp stands where the pointer is: over the middle high, towards the rim grazing. */
  const lightAt = (event) => {
    const frame = canvas.getBoundingClientRect();
    const x = event.clientX - frame.left - frame.width / 2, y = frame.top + frame.height / 2 - event.clientY;
    moveLight(Math.atan2(y, x) * 180 / Math.PI, 90 * (1 - Math.hypot(x, y) / (Math.min(frame.width, frame.height) / 2)));
  };
  const movesLight = (event) => (document.querySelector('input[name=drag]:checked').value === 'light') !==
    (event.shiftKey || (event.buttons & 2) > 0);

  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    if (movesLight(event)) lightAt(event);
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!event.buttons) return;
    if (movesLight(event)) lightAt(event);
    else turn(event.movementX * 0.008, event.movementY * 0.008);
  });
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('wheel', (event) => { event.preventDefault(); zoom(Math.exp(-event.deltaY * 0.001)); },
    {passive: false});
  canvas.addEventListener('keydown', (event) => {
    const arrow = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
    if (arrow && event.shiftKey) moveLight(view.azimuth - 5 * arrow[0], view.elevation + 5 * arrow[1]);
    else if (arrow) turn(0.08 * arrow[0], -0.08 * arrow[1]);
    else if (event.key === '+' || event.key === '=') zoom(1.15);
    else if (event.key === '-') zoom(1 / 1.15);
    else if (event.key === 'Home') front();
    else return;
    event.preventDefault();
  });
  for (const lamp of Object.values(lamps)) {
    lamp.addEventListener('input', () => moveLight(Number(lamps.azimuth.value), Number(lamps.elevation.value)));
  }
  byId('surface-of').addEventListener('change', (event) => { view.surface = event.target.value; changed(); });
  byId('material').addEventListener('change', (event) => { view.material = Number(event.target.value); changed(); });
  byId('reset').addEventListener('click', front);
}

/** A word in the surface's place, where it cannot be drawn. */
function refuseSurface() {
  byId('viewer').hidden = true;
  byId('no-webgl').hidden = false;
}

async function showSurface() {
  const canvas = byId('canvas');
  const gl = canvas.getContext('webgl2');
  if (!gl) return refuseSurface();
  canvas.addEventListener('webglcontextlost', refuseSurface);
  const images = {normals: new Image(), albedo: byId('albedo'), delta: byId('delta')};
  images.normals.src = data.surface.normals;
  await Promise.all(Object.values(images).map((image) => image.decode()));
  const surface = new SurfaceView(gl, images);
  const view = {...kFrontView, surface: 'refined', material: 0, azimuth: 145, elevation: 25};
  let waiting = false;
  const changed = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; surface.draw(view); });
  };
  connectControls(canvas, view, changed);
  new ResizeObserver(changed).observe(canvas);
  changed();
}

showSurface().catch((error) => {
  refuseSurface();
  console.error(error);
});
