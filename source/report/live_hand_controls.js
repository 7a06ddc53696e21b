// What the mouse or a finger does on the body.

import {element} from './dom.js';

const MODES = [['pull', 'Pull', 'A spring pulls a vertex (1)'], ['hold', 'Hold', 'A vertex is held and moved; a click releases it (2)'],
  ['region', 'Region', 'A spring pulls all vertices around (3)'], ['tool', 'Tools', 'A rigid tool is moved along the screen (4)'],
  ['view', 'View', 'The view is turned, on the body too (5, or Alt while dragging)']];
const HINTS = {
  pull: 'Drag a vertex: a spring pulls it. Beside the body dragging turns the view.',
  hold: 'Click on a vertex to hold it, drag it to move it; a click on its mark releases it.',
  region: 'Drag a vertex: all that are near it at rest are pulled with it.',
  tool: 'Drag a tool along the screen; its slider moves it along its axis.',
  view: 'Dragging turns the view, two fingers or the wheel zoom, the right button moves it.',
};

export class HandControls {
  /** @param hint is called with a sentence */
  constructor(hand, hasTools, hint) {
    this.hand = hand;
    this.hint = hint;
    this.modes = MODES.filter(([mode]) => mode !== 'tool' || hasTools);
    this.buttons = this.modes.map(([mode, text, title]) => element('button', {type: 'button', class: 'toggle', title, 'aria-pressed': 'false', onclick: () => this.choose(mode)}, text));
    const slider = element('input', {type: 'range', min: 0.01, max: 0.5, step: 0.01, value: hand.radius});
    const radius = element('output', {});
    const showRadius = () => {
      hand.radius = Number(slider.value);
      radius.textContent = `${Math.round(100 * hand.radius)} % of the body's size`;
      slider.setAttribute('aria-valuetext', radius.textContent);
    };
    slider.addEventListener('input', showRadius);
    showRadius();
    this.region = element('label', {class: 'choice'}, element('span', {}, 'Radius'), slider, radius);
    this.spring = this.makeSpring();
    this.release = element('button', {type: 'button', title: 'Lets go of all vertices (Esc)', onclick: () => hand.releaseAll()}, 'Release all');
    this.root = element('div', {class: 'hand-controls', role: 'group', 'aria-label': 'The hand'},
      element('span', {class: 'buttons'}, this.buttons), this.release, this.region, this.spring);
    this.choose('pull');
  }

  makeSpring() {
    const {hand} = this;
    const stiffness = element('input', {type: 'text', class: 'number', inputmode: 'decimal', placeholder: 'chosen', autocomplete: 'off', title: 'Of the spring; empty: the program chooses it by the stiffness of the body'});
    stiffness.addEventListener('input', () => {
      const number = Number(stiffness.value), right = Number.isFinite(number) && number >= 0;
      stiffness.setAttribute('aria-invalid', String(!right));
      hand.stiffness = right ? number : 0;
    });
    const stays = element('input', {type: 'checkbox'});
    stays.addEventListener('change', () => { hand.stays = stays.checked; });
    return element('span', {class: 'buttons spring'}, element('label', {class: 'choice'}, element('span', {}, 'Stiffness'), stiffness, element('span', {}, 'N/m')),
      element('label', {class: 'choice', title: 'The spring goes on pulling when you let go; a click on its mark releases it'}, stays, element('span', {}, 'goes on pulling')));
  }

  choose(mode) {
    this.hand.setMode(mode);
    this.modes.forEach(([name], i) => this.buttons[i].setAttribute('aria-pressed', String(name === mode)));
    this.region.hidden = mode !== 'region';
    this.spring.hidden = mode !== 'pull' && mode !== 'region';
    this.hint(HINTS[mode]);
  }

  /** By the keys 1 to 5. */
  key(number) {
    const mode = MODES[number - 1];
    if (this.modes.includes(mode)) this.choose(mode[0]);
  }
}
