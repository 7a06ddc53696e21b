// The mouse or a finger on the body: pulls, holds and pushes vertices, moves tools. Where it hits nothing, the view turns.

import {Vector3} from 'three';

const CLICK = 4; // pixels within which a press is a click and not a drag
const NEAR = 14; // pixels from a mark that still hit it

const length = (vector) => Math.hypot(...vector);

export class Hand {
  /** @param tools moves them: place(number), move(number, place)  @param told is called with what could not be done */
  constructor(stage, connection, tools, told) {
    Object.assign(this, {stage, connection, tools, told});
    this.view = stage.view;
    this.surface = stage.view.surface;
    this.mode = 'pull';
    this.radius = 0.1;
    this.stiffness = 0;
    this.stays = false;
    this.pulls = new Map();
    this.released = new Map(); // when
    this.drag = null;
    const {frame} = stage;
    frame.addEventListener('pointerdown', (event) => this.press(event), {capture: true});
    // A drag goes on beside the body, and ends wherever it is let go.
    window.addEventListener('pointermove', (event) => this.move(event), {capture: true});
    window.addEventListener('pointerup', (event) => this.letGo(event), {capture: true});
    window.addEventListener('pointercancel', (event) => this.letGo(event), {capture: true});
    frame.addEventListener('pointerleave', () => this.point(null));
  }

  setMode(mode) {
    this.mode = mode;
    this.point(null);
  }

  /** Marks that are under the pointer come before the body. */
  markAt({offsetX, offsetY}) {
    for (const pull of this.pulls.values())
      for (const place of [this.view.placeOf(pull.vertex), this.drawn(pull)]) {
        const point = this.view.project(place);
        if (point && Math.hypot(point.x - offsetX, point.y - offsetY) < NEAR) return pull;
      }
    return null;
  }

  /** Where the hand is drawn: its way from the vertex at rest is enlarged as all ways are. */
  drawn({vertex, target}) {
    const rest = this.rest(vertex);
    return target.clone().sub(rest).multiplyScalar(this.view.enlarged).add(rest);
  }

  rest(vertex) {
    return new Vector3().fromArray(this.surface.rest, 3 * vertex);
  }

  press(event) {
    if (event.button !== 0 || !event.isPrimary || this.drag || this.mode === 'view' || event.ctrlKey || event.metaKey || event.shiftKey || event.altKey) return;
    this.drag = this.mode === 'tool' ? this.takeTool(event) : this.takeVertex(event);
    if (!this.drag) return;
    Object.assign(this.drag, {pointer: event.pointerId, from: [event.clientX, event.clientY], moved: false});
    this.view.controls.enabled = false;
    this.view.canvas.focus({preventScroll: true});
    this.point(null);
  }

  takeTool(event) {
    const tool = this.view.toolAt(event.clientX, event.clientY);
    if (tool < 0) return null;
    const start = new Vector3(...this.tools.place(tool));
    return {tool, start, shown: start};
  }

  takeVertex(event) {
    const mark = this.markAt(event);
    if (mark) return {pull: mark, start: mark.target.clone(), shown: this.drawn(mark), again: true};
    const found = this.view.vertexAt(event.clientX, event.clientY);
    if (!found) return null;
    if (found.fixed) {
      this.told('The scene holds these vertices.');
      return null;
    }
    const target = this.rest(found.vertex).add(new Vector3().fromArray(this.view.u, 3 * found.vertex));
    const pull = {vertex: found.vertex, number: this.surface.numbers[found.vertex], target, held: this.mode === 'hold', force: null, begun: performance.now()};
    const words = this.mode === 'hold' ? ['hold', pull.number, ...target] :
      ['grab', pull.number, ...target, this.mode === 'region' ? this.radius * this.surface.diameter : 0, this.stiffness];
    if (!this.connection.say(words.join(' '), () => this.forget(pull))) return null;
    this.pulls.set(pull.number, pull);
    this.stage.drawMarks();
    return {pull, start: target.clone(), shown: this.view.placeOf(pull.vertex)};
  }

  move(event) {
    const {drag, view} = this;
    if (!drag) {
      if (event.buttons === 0 && event.pointerType === 'mouse' && event.target === view.canvas) this.point(event);
      return;
    }
    if (event.pointerId !== drag.pointer) return;
    event.stopPropagation();
    if (Math.hypot(event.clientX - drag.from[0], event.clientY - drag.from[1]) > CLICK) drag.moved = true;
    if (!drag.moved && drag.again) return;
    const way = view.inPlane(drag.shown, event.clientX, event.clientY).sub(view.inPlane(drag.shown, ...drag.from)).divideScalar(view.enlarged);
    const place = drag.start.clone().add(way);
    if (drag.pull) this.pull(drag.pull, place);
    else this.tools.move(drag.tool, [...place]);
  }

  pull(pull, place) {
    pull.target.copy(place);
    this.connection.sayLater(`move ${pull.number}`, `move ${pull.number} ${[...place].join(' ')}`);
    this.stage.drawMarks();
  }

  letGo(event) {
    const {drag} = this;
    if (!drag || event.pointerId !== drag.pointer) return;
    this.drag = null;
    this.view.controls.enabled = true;
    event.stopPropagation();
    if (!drag.pull) return;
    const stays = drag.again ? drag.moved && (drag.pull.held || this.stays) : drag.pull.held || this.stays;
    if (!stays) this.release(drag.pull);
  }

  release(pull) {
    this.connection.say(`release ${pull.number}`);
    this.released.set(pull.number, performance.now());
    this.forget(pull);
  }

  releaseAll() {
    if (this.drag) this.view.controls.enabled = true;
    this.drag = null;
    [...this.pulls.values()].forEach((pull) => this.release(pull));
  }

  forget(pull) {
    if (this.drag?.pull === pull) {
      this.drag = null;
      this.view.controls.enabled = true;
    }
    this.pulls.delete(pull.number);
    this.stage.drawMarks();
  }

  forgetAll() {
    [...this.pulls.values()].forEach((pull) => this.forget(pull));
  }

  /** What the program says of all hands: forces, and those that this page does not know. */
  hear(list) {
    const told = new Set(list.map(({vertex}) => vertex));
    for (const {vertex: number, target, force, mean, held, step} of list) {
      const known = this.pulls.get(number), vertex = this.surface.placeOfNumber.get(number);
      if (!known && (vertex === undefined || performance.now() - (this.released.get(number) ?? -Infinity) < 500)) continue;
      const pull = known ?? {vertex, number, target: new Vector3(...target), begun: 0};
      Object.assign(pull, {force, mean: mean ?? force, held, size: length(mean ?? force)});
      this.pulls.set(number, pull);
      this.last = {vertex: number, step, force, mean: mean ?? force, size: length(force)};
    }
    for (const pull of this.pulls.values())
      if (!told.has(pull.number) && this.drag?.pull !== pull && performance.now() - pull.begun > 1000) this.pulls.delete(pull.number);
    this.stage.drawMarks();
  }

  /** What would be taken at the pointer. */
  point(event) {
    if (!event || this.mode === 'view') return this.stage.showPointed(null);
    if (this.pointing) return undefined;
    this.pointing = true;
    const {clientX, clientY, offsetX, offsetY} = event;
    setTimeout(() => {
      this.pointing = false;
      if (this.drag) return;
      if (this.mode === 'tool') {
        const tool = this.view.toolAt(clientX, clientY);
        this.stage.showPointed(tool < 0 ? null : {tool, offsetX, offsetY});
        return;
      }
      const mark = this.markAt({offsetX, offsetY}), found = mark ? {vertex: mark.vertex, mark} : this.view.vertexAt(clientX, clientY);
      this.stage.showPointed(found && {...found, offsetX, offsetY, radius: this.mode === 'region' ? this.radius * this.surface.diameter : 0});
    }, 30);
    return undefined;
  }

  /** For the drawing of marks. */
  marks() {
    return [...this.pulls.values()].map((pull) => ({vertex: this.view.project(this.view.placeOf(pull.vertex)), hand: this.view.project(this.drawn(pull)),
      force: pull.size ?? null, held: pull.held}));
  }
}
