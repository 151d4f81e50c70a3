// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Diagrams as SVG: the histogram of the change in depth, and convergence.

/** A picture of size 440 x 280 with a description for those who do not see it. */
function diagram(description, ...children) {
  return svg('svg', {viewBox: '0 0 440 280', role: 'img', 'aria-label': description}, ...children);
}

const kPlot = {left: 58, right: 424, top: 30, bottom: 236};

/** Round numbers in [low, high], some `count` of them. */
function ticks(low, high, count) {
  const rough = (high - low) / count || 1;
  const decade = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((m) => m * decade).find((s) => s >= rough);
  const values = [];
  for (let value = Math.ceil(low / step) * step; value <= high + 1e-9 * step; value += step) values.push(value);
  return values;
}

const across = (value, low, high) => kPlot.left + (value - low) / (high - low || 1) * (kPlot.right - kPlot.left);
const upwards = (value, low, high) => kPlot.bottom - (value - low) / (high - low || 1) * (kPlot.bottom - kPlot.top);

function labelledAxes(title, xLabel, xTicks, yTicks) {
  const parts = [svg('text', {x: kPlot.left, y: 18}, title)];
  for (const [y, text] of yTicks) {
    parts.push(svg('line', {class: 'grid', x1: kPlot.left, x2: kPlot.right, y1: y, y2: y}));
    parts.push(svg('text', {class: 'quiet', x: kPlot.left - 6, y: y + 4, 'text-anchor': 'end'}, text));
  }
  for (const [x, text] of xTicks) {
    parts.push(svg('line', {class: 'axis', x1: x, x2: x, y1: kPlot.bottom, y2: kPlot.bottom + 4}));
    parts.push(svg('text', {class: 'quiet', x, y: kPlot.bottom + 18, 'text-anchor': 'middle'}, text));
  }
  parts.push(svg('path', {class: 'axis', d: `M${kPlot.left} ${kPlot.top}V${kPlot.bottom}H${kPlot.right}`}));
  parts.push(svg('text', {x: (kPlot.left + kPlot.right) / 2, y: 272, 'text-anchor': 'middle'}, xLabel));
  return parts;
}

function drawHistogram() {
  const {range_mm: range, counts, below, above, mean_mm: mean, rms_mm: rms} = data.delta;
  const all = Math.max(1, counts.reduce((sum, n) => sum + n, below + above));
  const highest = Math.max(1, ...counts) / all * 100;
  const width = (kPlot.right - kPlot.left) / counts.length;
  const bars = counts.map((n, k) => {
    const y = upwards(n / all * 100, 0, highest);
    return svg('rect', {class: 'bar', x: kPlot.left + k * width, y, width: width * 0.85, height: kPlot.bottom - y});
  });
  const words = `Mean change ${short(mean)} mm, root mean square ${short(rms)} mm; ` +
    `${short((below + above) / all * 100)} % of the surface changed by more than ${short(range)} mm.`;
  byId('histogram').append(diagram(`Histogram of the change in depth. ${words}`,
    ...labelledAxes('% of the surface', 'refined minus sensor depth, mm',
      ticks(-range, range, 6).map((v) => [across(v, -range, range), short(v)]),
      ticks(0, highest, 4).map((v) => [upwards(v, 0, highest), short(v)])),
    ...bars));
  byId('histogram-words').textContent = words;
  document.querySelectorAll('.scale span').forEach((span, k) => {
    span.textContent = `${k ? '+' : '\u2212'}${short(range)} mm`;
  });
}

/** A curve of positive values on a logarithmic axis. @param values an entry an iteration */
function logCurve(title, words, values, style) {
  const logs = values.map((v) => (v > 0 ? Math.log10(v) : null));
  const known = logs.filter((v) => v !== null);
  if (!known.length) return element('p', {}, `${title}: not recorded.`);
  let [low, high] = [Math.min(...known), Math.max(...known)];
  if (high - low < 0.3) [low, high] = [low - 0.15, high + 0.15];
  const last = Math.max(2, values.length);
  const points = logs.flatMap((v, k) => (v === null ? [] : [`${across(k + 1, 1, last)},${upwards(v, low, high)}`]));
  const yTicks = [1, 2, 5].flatMap((m) => ticks(Math.floor(low), Math.ceil(high), 1 + Math.ceil(high - low))
    .filter(Number.isInteger).map((d) => d + Math.log10(m))).filter((v) => v >= low && v <= high);
  const sparse = yTicks.length > 7 ? yTicks.filter(Number.isInteger) : yTicks;
  return diagram(`${title}. ${words}`,
    ...labelledAxes(title, 'iteration', ticks(1, last, 8).filter(Number.isInteger).map((v) => [across(v, 1, last), short(v)]),
      sparse.map((v) => [upwards(v, low, high), short(10 ** v)])),
    svg('polyline', {class: style, points: points.join(' ')}),
    ...points.map((at) => svg('circle', {class: style, cx: at.split(',')[0], cy: at.split(',')[1], r: 2})));
}

function drawConvergence() {
  const steps = result.iterations;
  if (!steps.length) {
    byId('convergence').append(element('p', {}, 'This method has no iterations.'));
    return;
  }
  const span = (key) => `From ${short(steps[0][key])} to ${short(steps.at(-1)[key])} in ${steps.length} iterations.`;
  byId('convergence').append(
    logCurve('Change of depth in an iteration (rms), mm', span('depth_change_mm'), steps.map((s) => s.depth_change_mm), 'first'),
    logCurve('Energy after the depth step', span('energy'), steps.map((s) => s.energy), 'second'));
  const table = element('table');
  fillTable(table, steps.map((s) => [String(s.index), s.depth_change_mm, s.energy, s.residual_scale, s.backtracks, s.seconds]),
    ['Iteration', 'Change, mm', 'Energy', 'Residual', 'Backtracks', 'Seconds']);
  byId('convergence').after(element('details', {}, element('summary', {}, 'The iterations in numbers'), table));
}

drawHistogram();
drawConvergence();
