// Hands drawn over the body: the line from a vertex to the hand that pulls it, its force, and held vertices.

import {drawing, element} from './dom.js';
import {quantity} from './format.js';

function makeMark() {
  const figure = drawing({class: 'mark'}, ['line', {}], ['circle', {class: 'hand', r: 5}], ['circle', {class: 'vertex', r: 6}]);
  return {figure, parts: [...figure.children], label: element('div', {class: 'force'})};
}

export class Marks {
  constructor() {
    this.region = drawing({class: 'mark'}, ['circle', {class: 'region'}]);
    this.root = element('div', {class: 'marks', 'aria-hidden': 'true'}, this.region);
    this.all = [];
    this.showRegion(null);
  }

  /** The size of a region around a point of the screen, in pixels; null: none. */
  showRegion(point, radius) {
    this.region.style.display = point ? '' : 'none';
    if (!point) return;
    const [circle] = this.region.children;
    circle.setAttribute('cx', point.x);
    circle.setAttribute('cy', point.y);
    circle.setAttribute('r', radius);
  }

  /** @param hands [{vertex, hand: points of the screen or null, force, held}] */
  show(hands) {
    while (this.all.length < hands.length) {
      const mark = makeMark();
      this.all.push(mark);
      this.root.append(mark.figure, mark.label);
    }
    this.all.forEach((mark, i) => this.draw(mark, hands[i]));
  }

  draw({figure, parts: [line, hand, vertex], label}, what) {
    const seen = what && what.vertex && what.hand;
    figure.style.display = seen ? '' : 'none';
    label.hidden = !seen || what.force === null;
    if (!seen) return;
    figure.classList.toggle('held', what.held);
    const put = (circle, {x, y}) => {
      circle.setAttribute('cx', x);
      circle.setAttribute('cy', y);
    };
    put(vertex, what.vertex);
    put(hand, what.hand);
    [['x1', what.vertex.x], ['y1', what.vertex.y], ['x2', what.hand.x], ['y2', what.hand.y]].forEach(([name, value]) => line.setAttribute(name, value));
    if (label.hidden) return;
    label.textContent = quantity(what.force, 'N', 3);
    const beyond = what.hand.x + 90 > this.root.clientWidth; // the label stands on the other side
    label.style.transform = `translate(${what.hand.x + (beyond ? -12 : 12)}px, ${Math.max(2, what.hand.y - 26)}px) translateX(${beyond ? '-100%' : '0'})`;
  }
}
