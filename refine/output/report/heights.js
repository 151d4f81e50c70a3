// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Height maps of the surface as depth and triangles.

/** A face this many times as deep as it is wide is a jump between two surfaces, as in mesh.ply. */
const kJumpSlope = 10;

/** Depth in metres a sample, 0 = none, of base64 codes: 1 to 65535 from near to far, little-endian. */
function decodedDepth(codes, {near_m: near, far_m: far}) {
  const bytes = Uint8Array.from(atob(codes), (c) => c.charCodeAt(0));
  const depth = new Float32Array(bytes.length / 2);
  for (let k = 0; k < depth.length; ++k) {
    const code = bytes[2 * k] | bytes[2 * k + 1] << 8;
    depth[k] = code ? near + (code - 1) / 65534 * (far - near) : 0;
  }
  return depth;
}

/** Indices of the triangles between neighbours that lie on one surface. @param focal pixels */
function trianglesOf(depth, {columns, rows, stride}, focal) {
  const joined = (p, q, pixels) => depth[p] && depth[q] &&
    Math.abs(depth[p] - depth[q]) <= kJumpSlope * pixels * stride * Math.min(depth[p], depth[q]) / focal;
  const indices = new Uint32Array(6 * columns * rows);
  let count = 0;
  const add = (corner, a, b) => {  // a and b are the ends of the square's diagonal
    if (!joined(corner, a, 1) || !joined(corner, b, 1) || !joined(a, b, Math.SQRT2)) return;
    indices.set([corner, a, b], count);
    count += 3;
  };
  for (let y = 0; y + 1 < rows; ++y) {
    for (let x = 0; x + 1 < columns; ++x) {
      const a = y * columns + x, b = a + 1, c = a + columns, d = c + 1;
      add(a, c, b);
      add(d, b, c);
    }
  }
  return indices.subarray(0, count);
}
