// The body of a live session with its colour bar, its axes, the hands on it, and what it is told to show.

import {FIELDS, gradient} from './colours.js';
import {choice, element, onThemeChange, toggle} from './dom.js';
import {digits, prefixed, quantity} from './format.js';
import {Marks} from './live_marks.js';
import {LiveView} from './live_view.js';
import {axesFigure} from './stage.js';

const COLOURS = [['displacement', 'displacement'], ['plain', 'plain']];
const RANGES = [['session', 'session so far'], ['instant', 'this instant']];
const FACTORS = [1, 2, 5, 10, 20, 50, 100];

export class LiveStage {
  /** @param frames gives frames  @param shown is called with each frame that was drawn */
  constructor(surface, up, frames, shown) {
    this.surface = surface;
    const canvas = element('canvas', {tabindex: 0, role: 'img',
      'aria-label': 'The moving body. Drag on it to pull; arrow keys turn it, plus and minus zoom, 0 looks from the start again.'});
    const axes = axesFigure();
    this.marks = new Marks();
    this.pointed = element('div', {class: 'pointed', hidden: true});
    this.note = element('div', {});
    this.hint = element('div', {});
    this.cover = element('div', {class: 'cover', role: 'status', hidden: true});
    this.frame = element('div', {class: 'stage'}, canvas, this.marks.root, axes.figure, element('div', {class: 'scale-note', role: 'status'}, this.hint, this.note), this.pointed, this.cover);
    this.bar = element('div', {class: 'bar', style: `background: ${gradient(FIELDS.displacement.map)}`});
    this.title = element('div', {class: 'bar-title'});
    this.ends = element('div', {class: 'ends'});
    this.colourBar = element('div', {class: 'colour-bar'}, this.title, this.bar, this.ends);
    this.root = element('div', {class: 'body-view'}, this.frame, this.colourBar);

    document.body.append(this.root); // it needs a size to begin with
    const moved = (camera) => {
      axes.update(camera);
      this.drawMarks();
    };
    this.view = new LiveView(canvas, surface, up, moved, frames, (frame) => {
      this.showRange();
      shown(frame);
    });
    this.controls = this.makeControls();
    this.set({wires: surface.triangles < 40000, ghost: true});
    this.view.reset();
    onThemeChange(() => this.view.takeTheme());
  }

  makeControls() {
    this.wireButton = toggle('Mesh', 'Edges of the cells (w)', this.surface.triangles < 40000, (wires) => this.set({wires}));
    this.ghostButton = toggle('Undeformed', 'The body at rest (g)', true, (ghost) => this.set({ghost}));
    const reset = element('button', {type: 'button', title: 'Look from the start again (0 in the view)', onclick: () => this.view.reset()}, 'Reset view');
    return element('div', {class: 'controls'},
      choice('Color', COLOURS, 'displacement', (field) => this.set({field})),
      choice('Range', RANGES, 'session', (range) => this.set({ofInstant: range === 'instant'})),
      choice('Displacement', FACTORS.map((factor) => [factor, `× ${factor}`]), 1, (factor) => this.set({enlarged: Number(factor)})),
      element('span', {class: 'buttons'}, this.wireButton, this.ghostButton, reset));
  }

  set(what) {
    this.view.show(what);
    this.colourBar.hidden = this.view.field === 'plain';
    this.note.textContent = this.view.enlarged === 1 ? '' : `drawn with ${this.view.enlarged} times the displacement${this.surface.tools.length > 0 ? ', without tools' : ''}`;
    this.showRange();
  }

  showRange() {
    const [, high] = this.view.range ?? [0, 0];
    if (high === this.highest) return;
    this.highest = high;
    const [size, symbol] = prefixed(high, 'm'), nothing = high < 1e-11;
    this.title.textContent = nothing ? 'displacement' : `displacement in ${symbol}`;
    this.ends.replaceChildren(...(nothing ? [0] : [0, 0.25, 0.5, 0.75, 1]).map((x) => element('span', {}, digits(x * high / size, 3))));
  }

  /** The hand is made after the stage. */
  drawMarks() {
    if (this.hand) this.marks.show(this.hand.marks());
  }

  /** What is under the pointer: a tool or a vertex; null: nothing. */
  showPointed(found) {
    this.frame.classList.toggle('takes', Boolean(found) && !found.fixed);
    this.pointed.hidden = !found;
    this.marks.showRegion(null);
    if (!found) return;
    this.pointed.style.left = `${found.offsetX}px`;
    this.pointed.style.top = `${found.offsetY}px`;
    if (found.tool !== undefined) {
      this.pointed.textContent = this.surface.tools[found.tool].name;
      return;
    }
    const {u} = this.view, place = this.view.placeOf(found.vertex), at = 3 * found.vertex;
    const moved = quantity(Math.hypot(u[at], u[at + 1], u[at + 2]), 'm', 3);
    this.pointed.textContent = found.fixed ? 'held by the scene' : `vertex ${this.surface.numbers[found.vertex]} · ${moved}${found.mark ? ' · click to release' : ''}`;
    if (found.radius > 0 && !found.fixed) this.marks.showRegion(this.view.project(place), this.view.pixels(found.radius, place));
  }

  /** A text over the body, which does not move; nothing without a text. */
  showCover(text) {
    this.cover.hidden = !text;
    this.cover.textContent = text ?? '';
  }
}
