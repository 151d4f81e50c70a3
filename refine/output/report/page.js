// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the page says in words and tables.

/** {a: {b: 1}} as [['a.b', 1]]. */
function flattened(object, prefix = '') {
  return Object.entries(object).flatMap(([key, value]) =>
    value !== null && typeof value === 'object' && !Array.isArray(value)
      ? flattened(value, `${prefix}${key}.`)
      : [[prefix + key, Array.isArray(value) ? value.map(short).join(' ') : value]]);
}

const kEndings = {
  converged: 'The refinement settled',
  max_iterations: 'The refinement was stopped at its limit of iterations: usable, but not settled',
  diverged: 'The refinement did not converge; the best state is shown',
};

const kMeasures = {
  coverage: ['Share of the surface where the sensor saw depth', 100, '%'],
  depth_noise_m: ['Noise of the sensor\u2019s depth', 1e3, 'mm'],
  image_noise: ['Noise of the images, of full brightness', 100, '%'],
  too_few_lit: ['Share of the surface lit in fewer than three images', 100, '%'],
  far_over_near_residual: ['Misfit with far lamps / with near lamps', 1, ''],
  depth_noise_log: ['Noise of the sensor\u2019s depth, of the distance', 100, '%'],
  lamp_spread: ['Spread of the lamps\u2019 directions (0 = all alike)', 1, ''],
  sensor_weight: ['Weight of the sensor\u2019s depth', 1, ''],
  worst_image_misfit: ['Misfit of the worst image / of the typical one', 1, ''],
};

function describeOutcome() {
  if (data.name) byId('name').textContent = `: ${data.name}`;
  document.title = `Rakelight report${data.name ? `: ${data.name}` : ''}`;
  byId('outcome').textContent = `${kEndings[result.termination]} (${result.message}).`;
  byId('warnings').hidden = result.warnings.length === 0;
  byId('warnings').querySelector('ul').append(...result.warnings.map((text) => element('li', {}, text)));
}

function fillNumbers() {
  const seconds = result.iterations.reduce((sum, each) => sum + each.seconds, 0);
  const measures = Object.entries(result.quality).map(([name, value]) => {
    const [words, factor, unit] = kMeasures[name] ?? [name.replaceAll('_', ' '), 1, ''];
    return [words, `${short(value === null ? null : value * factor)} ${unit}`];
  });
  fillTable(byId('quality'), [
    ['Method', `${result.options.method}, preset ${result.options.preset}`],
    ['Grid', `${result.camera.width} \u00d7 ${result.camera.height} pixels, ${result.scale} times the depth grid`],
    ['Surface', `${data.pixels.toLocaleString('en')} pixels`],
    ['Iterations', `${result.iterations.length} in ${short(seconds)} s`],
    ...measures,
  ]);
  fillTable(byId('options'), flattened(result.options));
  fillTable(byId('versions'), [...flattened(result.camera, 'camera.'), ...flattened(result.versions)]);
}

function connectCompare() {
  const figure = document.querySelector('.compare');
  const slider = byId('compare');
  const move = () => {
    figure.querySelector('.stage').style.setProperty('--at', `${slider.value}%`);
    slider.setAttribute('aria-valuetext', `${slider.value} % sensor, ${100 - slider.value} % refined`);
  };
  slider.addEventListener('input', move);
  byId('compare-what').addEventListener('change', (event) => { figure.dataset.what = event.target.value; });
  move();
}

describeOutcome();
fillNumbers();
connectCompare();
