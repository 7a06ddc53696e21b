// Rigid tools: where they are wanted, and a slider for each along its axis.

import {element} from './dom.js';
import {digits, prefixed, quantity} from './format.js';

const AXES = ['x', 'y', 'z'];

export class Tools {
  /** @param list of the page's data  @param up against gravity, or null */
  constructor(list, up, surface, connection) {
    this.list = list;
    this.connection = connection;
    this.wanted = list.map(({place}) => [...place]);
    this.axes = list.map(({axis}) => axis ?? up ?? [0, 0, 1]);
    this.reach = 0.5 * surface.diameter;
    this.sliders = list.map((tool, number) => this.makeSlider(tool, number));
    this.root = list.length === 0 ? null : element('section', {class: 'tools', 'aria-label': 'Tools'}, element('h2', {}, 'Tools'), this.sliders.map(({root}) => root));
  }

  /** How far a place is from the start, against the axis: into the body. */
  way(number, place = this.wanted[number]) {
    return this.axes[number].reduce((sum, axis, d) => sum - axis * (place[d] - this.list[number].place[d]), 0);
  }

  /** For the curves of its force. */
  describe(number) {
    const axis = this.axes[number];
    return {label: `way ${this.direction(number)}`, way: (place) => this.way(number, place), along: (force) => axis.reduce((sum, a, d) => sum - a * force[d], 0)};
  }

  direction(number) {
    const axis = this.axes[number], d = axis.findIndex((a) => Math.abs(a) > 0.999);
    return this.list[number].axis ? 'along its axis' : d < 0 ? 'down' : `against ${AXES[d]}`;
  }

  makeSlider({name}, number) {
    const slider = element('input', {type: 'range', min: -1, max: 1, step: 0.0005, value: 0, 'aria-label': `${name}, way ${this.direction(number)}`});
    const text = element('output', {});
    slider.addEventListener('input', () => {
      const change = Number(slider.value) * this.reach - this.way(number);
      this.move(number, this.wanted[number].map((x, d) => x - change * this.axes[number][d]));
    });
    const root = element('div', {class: 'tool'}, element('span', {}, name), slider, text,
      element('button', {type: 'button', title: `${name} to where it was at the start`, onclick: () => this.move(number, [...this.list[number].place])}, 'Back'));
    const shown = {root, slider, text};
    this.showSlider(number, shown);
    return shown;
  }

  showSlider(number, {slider, text} = this.sliders[number]) {
    const exact = this.way(number), way = Math.abs(exact) < 1e-9 * this.reach ? 0 : exact;
    if (document.activeElement !== slider || Math.abs(Number(slider.value) * this.reach - way) > 0.001 * this.reach) slider.value = way / this.reach;
    const [size, symbol] = prefixed(this.reach, 'm');
    text.textContent = `${digits(way / size, 3)}\u202f${symbol}${this.forces?.[number] === undefined ? '' : ` · ${quantity(this.forces[number], 'N', 3)}`}`;
    slider.setAttribute('aria-valuetext', text.textContent);
  }

  place(number) {
    return this.wanted[number];
  }

  move(number, place) {
    if (!this.connection.isOpen) return;
    this.wanted[number] = place;
    this.connection.sayLater(`tool ${number}`, `tool ${this.list[number].name} ${place.join(' ')}`);
    this.touched = true;
    this.showSlider(number);
  }

  /** Forces from the newest rows; where the tools are, if no hand moves them. */
  take(tables) {
    this.forces = this.list.map(({name}) => {
      const {columns, length} = tables[name];
      return length === 0 ? undefined : Math.hypot(...AXES.map((d) => columns[`f${d}`][length - 1]));
    });
    this.list.forEach((_, number) => this.showSlider(number));
  }

  /** After a reset, or when the page comes back: as the program has them. */
  settle(poses) {
    this.wanted = this.list.map(({place}, number) => {
      const told = [...poses.subarray(6 * number, 6 * number + 3)];
      return told.every((x, d) => Math.abs(x - place[d]) < 1e-6 * this.reach) ? [...place] : told; // frames have less digits
    });
    this.list.forEach((_, number) => this.showSlider(number));
  }
}
