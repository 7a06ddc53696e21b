// The body with its colour bar, its controls and its axes.

import {Vector3} from 'three';

import {BodyView} from './body_view.js';
import {FIELDS, gradient} from './colours.js';
import {choice, drawing, element, onThemeChange, toggle} from './dom.js';
import {count, digits, prefixed, quantity} from './format.js';

/** A round factor that makes a motion visible; 1 if it is. */
function enlargement(surface) {
  if (!(surface.farthest > 0) || surface.farthest > 0.02 * surface.diameter) return 1;
  const wanted = 0.08 * surface.diameter / surface.farthest;
  const power = 10 ** Math.floor(Math.log10(wanted));
  return Math.max(1, power * [5, 2, 1].find((digit) => digit * power <= wanted));
}

/** x, y and z as they lie on the screen. */
export function axesFigure() {
  const names = ['x', 'y', 'z'];
  const figure = drawing({class: 'axes', viewBox: '-30 -30 60 60', width: 60, height: 60, 'aria-hidden': 'true'},
    ...names.map(() => ['line', {x1: 0, y1: 0, x2: 0, y2: 0}]), ...names.map(() => ['text', {'text-anchor': 'middle', dy: '0.35em'}]));
  const lines = [...figure.querySelectorAll('line')], texts = [...figure.querySelectorAll('text')];
  texts.forEach((text, d) => { text.textContent = names[d]; });
  const update = (camera) => {
    const inverse = camera.quaternion.clone().invert();
    lines.forEach((line, d) => {
      const axis = new Vector3(...[0, 1, 2].map((i) => (i === d ? 1 : 0))).applyQuaternion(inverse);
      line.setAttribute('x2', 18 * axis.x);
      line.setAttribute('y2', -18 * axis.y);
      texts[d].setAttribute('x', 25 * axis.x);
      texts[d].setAttribute('y', -25 * axis.y);
      texts[d].style.opacity = Math.hypot(axis.x, axis.y) < 0.25 ? 0 : 1;
    });
  };
  return {figure, update};
}

export class Stage {
  constructor(surface, up) {
    this.surface = surface;
    const canvas = element('canvas', {tabindex: 0, role: 'img',
      'aria-label': 'The moving body. Arrow keys turn it, plus and minus zoom, 0 looks from the start again.'});
    this.value = element('div', {class: 'pointed', hidden: true});
    this.note = element('div', {class: 'scale-note', hidden: true});
    const axes = axesFigure();
    const frame = element('div', {class: 'stage'}, canvas, axes.figure, this.note, this.value);
    this.bar = element('div', {class: 'bar'});
    this.ends = element('div', {class: 'ends'});
    this.title = element('div', {class: 'bar-title'});
    this.root = element('div', {class: 'body-view'}, frame, element('div', {class: 'colour-bar'}, this.title, this.bar, this.ends));

    document.body.append(this.root); // it needs a size to begin with
    this.view = new BodyView(canvas, surface, up, axes.update);
    this.enlarged = enlargement(surface);
    this.controls = this.makeControls();
    this.set({field: 'von_mises_stress', enlarged: this.enlarged, wires: true, ghost: true});
    this.view.reset();
    this.showPointed(canvas);
    onThemeChange(() => this.view.takeTheme());
  }

  makeControls() {
    const fields = Object.keys(FIELDS).filter((field) => (field === 'material' ? this.surface.materials.length > 1 : this.surface.range[field]));
    const factors = [...new Set([1, 2, 5, 10, 20, 50, 100, this.enlarged])].sort((a, b) => a - b);
    this.wireButton = toggle('Mesh', 'Edges of the cells (w)', true, (wires) => this.set({wires}));
    this.ghostButton = toggle('Undeformed', 'The body at rest (g)', true, (ghost) => this.set({ghost}));
    const reset = element('button', {type: 'button', title: 'Look from the start again (0 in the view)', onclick: () => this.view.reset()}, 'Reset view');
    return element('div', {class: 'controls'},
      choice('Color', fields.map((field) => [field, FIELDS[field].title]), 'von_mises_stress', (field) => this.set({field})),
      choice('Range', [['run', 'whole run'], ['instant', 'this instant']], 'run', (range) => this.set({ofInstant: range === 'instant'})),
      choice('Displacement', factors.map((factor) => [factor, `× ${digits(factor)}`]), this.enlarged,
        (factor) => { this.set({enlarged: Number(factor)}); this.view.reset(); }),
      element('span', {class: 'buttons'}, this.wireButton, this.ghostButton, reset));
  }

  set(what) {
    this.view.show(what);
    const {title, unit, map} = FIELDS[this.view.field];
    const [low, high] = this.view.range;
    const [size, symbol] = prefixed(Math.max(Math.abs(low), Math.abs(high)), unit);
    this.title.textContent = title + (symbol ? ` in ${symbol}` : '');
    this.bar.style.background = gradient(map);
    const ends = this.view.field === 'material' ? this.surface.materials : [0, 0.25, 0.5, 0.75, 1].map((x) => low + x * (high - low));
    const above = high < this.surface.range[this.view.field]?.[1] && !this.view.ofInstant ? '≥ ' : '';
    this.ends.replaceChildren(...ends.map((value, i) => element('span', {}, (i === ends.length - 1 ? above : '') + digits(value / size, 3))));
    this.note.hidden = this.view.enlarged === 1;
    this.note.textContent = `drawn with ${digits(this.view.enlarged)} times the displacement`;
  }

  /** What the surface has under the pointer. */
  showPointed(canvas) {
    const hide = () => { this.value.hidden = true; };
    canvas.addEventListener('pointerleave', hide);
    canvas.addEventListener('pointerdown', hide);
    canvas.addEventListener('pointermove', (event) => {
      if (event.buttons || this.pointing) return;
      this.pointing = true;
      requestAnimationFrame(() => {
        this.pointing = false;
        const found = this.view.valueAt(event.clientX, event.clientY);
        this.value.hidden = found === null;
        if (found === null) return;
        const {title, unit} = FIELDS[this.view.field];
        this.value.textContent = `${title} ${quantity(found, unit)}`;
        this.value.style.left = `${event.offsetX}px`;
        this.value.style.top = `${event.offsetY}px`;
      });
    });
  }

  /** How the page draws it, in sentences. */
  facts() {
    const {times, frames_written: written, vertices, triangles} = this.surface;
    const sentences = [`The surface has ${count(vertices, 'vertex').replace('vertexs', 'vertices')} and ${count(triangles, 'triangle')}.`];
    sentences.push(times.length < written
      ? `${count(times.length, 'frame')} of the ${digits(written)} that were written are in this page; all are in solution.pvd.`
      : `All ${count(written, 'frame')} that were written are in this page; between them the picture is interpolated.`);
    const {von_mises_stress: [, most]} = this.surface.range, {von_mises_stress: [, shown]} = this.surface.coloured;
    if (shown < most) sentences.push(`A hundredth of the surface has von Mises stresses of ${quantity(shown, 'Pa', 3)} to ${quantity(most, 'Pa', 3)}, all in the last colour, so that the rest is seen.`);
    sentences.push('Displacements, volume ratios and stresses have 16 bits here: 1/65000 of their range. The files have all digits.');
    return sentences;
  }
}
