// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The images the result was made from, each with what is known about its lamp.

/** Share of the object that may clip before it is said loudly. */
const kMuchClipped = 0.02;

function frameItem(frame) {
  const lamp = frame.lamp === null ? 'no lamp (dark image)' : frame.lamp;
  const words = [element('b', {}, lamp), element('small', {}, `image ${frame.index}${frame.color ? `, ${frame.color}` : ''}`)];
  if (frame.lit !== null) {
    words.push(frame.lit ? element('small', {}, 'Lit as this lamp should.')
      : element('small', {class: 'bad'}, 'Not lit as this lamp should: another lamp may have been on.'));
  }
  if (frame.clipped > 0) {
    words.push(element('small', frame.clipped > kMuchClipped ? {class: 'bad'} : {},
      `${short(100 * frame.clipped)} % of the object is overexposed.`));
  }
  const alt = `Image ${frame.index}, ${frame.lamp === null ? 'dark' : `lit by ${frame.lamp}`}`;
  return element('li', {}, element('img', {alt, src: frame.picture}), ...words);
}

function listFrames() {
  const shown = data.frames.length;
  const checked = data.frames.filter((frame) => frame.lit !== null);
  const wrong = checked.filter((frame) => !frame.lit).length;
  const sentences = shown ? [`${shown} of ${data.frames_in_stack} frames, cropped to the object, all in one brightness.`]
    : ['The images were not at hand when this page was written.'];
  if (shown && !checked.length) sentences.push('The stack does not record whether each lamp was seen to be lit.');
  if (checked.length) {
    sentences.push(wrong ? `${wrong} of ${checked.length} lit checks disagree.` : `All ${checked.length} lit checks agree.`);
  }
  byId('frames-words').textContent = sentences.join(' ');
  byId('frames').append(...data.frames.map(frameItem));
}

listFrames();
