// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the light came from: directions on a hemisphere as the camera sees them, near lamps in plan.

/** A lamp farther than this many times the object's distance is drawn as a direction only. */
const kFarLamp = 10;

/** Angle between the direction to a lamp and that to the camera, radians. */
const offAxis = (direction) => Math.acos(Math.max(-1, Math.min(1, -direction[2])));

/** Direction (unit, from the object to the lamp), colour and position of each image's lamp; camera coordinates. */
function lampsOfResult() {
  return result.lights.map((light) => {
    const sum = [0, 1, 2].map((k) => light.sh_rgb[0][k] + light.sh_rgb[1][k] + light.sh_rgb[2][k]);
    const length = Math.hypot(...sum);
    const strengths = light.sh_rgb.map((row) => Math.hypot(row[0], row[1], row[2]));
    const strongest = Math.max(...strengths, 1e-12);
    return {
      id: light.id,
      frame: light.frame,
      direction: sum.map((v) => v / (length || 1)),
      color: `rgb(${strengths.map((s) => Math.round(255 * (s / strongest) ** 0.45)).join(',')})`,
      strength: strengths.reduce((a, b) => a + b) / 3,
      position: light.position_m ?? null,
    };
  });
}

function dot(lamp, x, y, radius = 6) {
  return svg('circle', {class: 'lamp', cx: x, cy: y, r: radius, fill: lamp.color},
    svg('title', {}, `${lamp.id} (image ${lamp.frame})`));
}

/** Angle from the optical axis as the radius: the middle is the camera's own direction, the rim is grazing light. */
function hemisphere(lamps) {
  const [cx, cy, radius] = [220, 152, 106];
  const angles = [30, 60, 90];
  const rings = angles.map((degrees) =>
    svg('circle', {class: degrees === 90 ? 'axis' : 'grid', cx, cy, r: radius * degrees / 90}));
  // Beside the diagram, where no lamp hides them.
  const scale = angles.flatMap((degrees) => [
    svg('path', {class: 'grid', d: `M${cx + radius * degrees / 90} ${cy}V${cy + radius + 6}`}),
    svg('text', {class: 'quiet', x: cx + radius * degrees / 90, y: cy + radius + 19, 'text-anchor': 'middle'},
      `${degrees}\u00b0`)]);
  const dots = lamps.map((lamp) => {
    const [x, y] = lamp.direction;
    const reach = Math.min(1.12, offAxis(lamp.direction) / (Math.PI / 2)) * radius;
    const side = Math.hypot(x, y) || 1;
    return dot(lamp, cx + reach * x / side, cy + reach * y / side);
  });
  return diagram(`Directions of ${lamps.length} lamps seen from the camera; the table below has the numbers.`,
    svg('text', {x: 12, y: 18}, 'Directions, as the camera sees them'), ...rings,
    svg('path', {class: 'grid', d: `M${cx - radius} ${cy}h${2 * radius}M${cx} ${cy - radius}v${2 * radius}`}), ...scale, ...dots);
}

/** Seen from above: x to the right, the camera below, the object above it. */
function plan(lamps) {
  const near = lamps.filter((lamp) => lamp.position &&
    Math.hypot(...lamp.position.map((v, k) => v - data.centre_m[k])) < kFarLamp * data.centre_m[2]);
  if (!near.length) return null;
  const places = [[0, 0], [data.centre_m[0], data.centre_m[2]], ...near.map((lamp) => [lamp.position[0], lamp.position[2]])];
  const xs = places.map((p) => p[0]), zs = places.map((p) => p[1]);
  const middle = (values) => (Math.min(...values) + Math.max(...values)) / 2;
  const scale = Math.min(360 / (Math.max(...xs) - Math.min(...xs) || 0.1), 190 / (Math.max(...zs) - Math.min(...zs) || 0.1));
  const at = (x, z) => [220 + (x - middle(xs)) * scale, 140 - (z - middle(zs)) * scale];
  const bar = ticks(0, 120 / scale, 4).at(-1);
  const [camX, camY] = at(0, 0), [objX, objY] = at(data.centre_m[0], data.centre_m[2]);
  return diagram(`Plan of ${near.length} near lamps with the camera and the object; the table below has the numbers.`,
    svg('text', {x: 12, y: 18}, 'Near lamps, seen from above'),
    svg('path', {class: 'axis', d: `M${camX} ${camY}l-9 14h18z`}),
    svg('text', {class: 'quiet', x: camX + 13, y: camY + 13}, 'camera'),
    svg('rect', {class: 'axis', x: objX - 7, y: objY - 7, width: 14, height: 14}),
    svg('text', {class: 'quiet', x: objX + 12, y: objY + 4}, 'object'),
    ...near.map((lamp) => dot(lamp, ...at(lamp.position[0], lamp.position[2]))),
    svg('path', {class: 'axis', d: `M20 262v4h${bar * scale}v-4`}),
    svg('text', {class: 'quiet', x: 26 + bar * scale, y: 268}, `${short(bar)} m`));
}

function drawLamps() {
  const lamps = lampsOfResult();
  const section = byId('lamps');
  if (!lamps.length) {
    section.append(element('p', {}, 'This method estimates no lamps.'));
    return;
  }
  section.append(...[hemisphere(lamps), plan(lamps)].filter(Boolean));
  const degrees = (radians) => radians * 180 / Math.PI;
  const table = element('table');
  fillTable(table, lamps.map((lamp) => [lamp.id, String(lamp.frame),
    `${degrees(Math.atan2(-lamp.direction[1], lamp.direction[0])).toFixed(0)}\u00b0`,
    `${degrees(offAxis(lamp.direction)).toFixed(0)}\u00b0`, lamp.strength,
    lamp.position ? lamp.position.map((v) => v.toFixed(2)).join(' ') : null]),
  ['Lamp', 'Image', 'Around (0\u00b0 right, 90\u00b0 up)', 'Off the axis', 'Strength', 'Position, m (right, down, forward)']);
  section.after(element('details', {}, element('summary', {}, 'The lamps in numbers'), table));
}

drawLamps();
